//! Tests of `histogram.rs`.

use super::FigureRange;

#[test]
fn gross_values_are_left_out_and_counted() {
    let mut values: Vec<f64> = (0..100).map(f64::from).collect();
    assert_eq!(FigureRange::new(values.clone()), FigureRange { ends: [0.0, 99.0], beyond: 0 });
    values.extend([-700.0, 1000.0, 2000.0]);
    let reach = FigureRange::new(values);
    assert_eq!(reach, FigureRange { ends: [0.0, 99.0], beyond: 3 });
    assert_eq!(reach.title("x"), "x; 3 beyond");
}
