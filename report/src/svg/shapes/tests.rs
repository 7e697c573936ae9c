//! Tests of `shapes.rs`.

use super::{Area, Canvas, words};

#[test]
fn labels_do_not_overlap() {
    // Heights between which a shift by one line is rounded.
    let label = |i: u32| ([0.1 * f64::from(i % 3), 1e3 / f64::from(3 + i % 7)], format!("leg {i}"));
    let texts: Vec<_> = (0..200).map(label).collect();
    let mut canvas = Canvas::default();
    let area = Area { left: 0.0, top: 0.0, width: 500.0, height: 500.0 };
    words(&mut canvas, &texts, &area);
    let svg = canvas.finish();
    let heights = svg.split(" y=\"").skip(1).map(|rest| rest.split('"').next().unwrap().parse().unwrap());
    let mut heights: Vec<f64> = heights.collect();
    heights.sort_by(f64::total_cmp);
    // Heights are written with one decimal.
    assert_eq!(heights.len(), 200);
    assert!(heights.windows(2).all(|pair| pair[1] - pair[0] > 14.8), "{heights:?}");
}
