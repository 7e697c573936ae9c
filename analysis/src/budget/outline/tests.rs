//! Tests of `outline.rs`.

use std::collections::BTreeMap;

use super::*;
use abbe_kinematics::sampling::{halton, norm};

fn cloud(count: usize) -> Vec<[f64; 3]> {
    let point = |i| core::array::from_fn(|k| (k + 1) as f64 * (halton(i, k) - 0.5) + 10.0);
    (1..=count).map(point).collect()
}

fn outline(points: &[[f64; 3]], view: &View) -> Outline {
    let square =
        |point: &[f64; 3]| vectors(&[*point]).map(|p| (p - Vector3::from(view.centre)).norm_squared()).sum();
    let points: Vec<_> = points.iter().map(|point| Point { point: *point, square: square(point) }).collect();
    Outline::new(view, &points, None)
}

/// Checks that an outline with more directions than are kept does not depend on order and
/// partition.
#[test]
fn outlines_of_parts_merge_into_that_of_all() {
    let points = cloud(40_000);
    let view = View::around(&points[..100], points.len());
    let all = outline(&points, &view);
    assert!(all.doubled > 0 && all.cells.len() > MOST / 8);
    let backwards = points.iter().rev().copied().collect::<Vec<_>>();
    assert_eq!(all, outline(&backwards, &view));
    for cut in [1, 300, 39_000] {
        let [mut first, second] = [&points[..cut], &points[cut..]].map(|part| outline(part, &view));
        let mut other = second.clone();
        other.merge(&first);
        first.merge(&second);
        assert_eq!(all, first);
        assert_eq!(all, other);
    }
    // Repeated points change nothing.
    let few = &points[..100];
    assert_eq!(outline(&[few, few].concat(), &view), outline(few, &view));
}

#[test]
fn the_sphere_is_the_smallest_or_says_by_how_much_it_may_be_larger() {
    let points = cloud(40_000);
    let smallest = Ball::around(&vectors(&points).collect::<Vec<_>>()).radius;
    // The excess decreases with a better view.
    for (known, excess) in [(3, 0.02), (30, 0.01), (512, 0.005)] {
        let view = View::around(&points[..known], points.len());
        let sphere = outline(&points, &view).sphere(&view, &points[..known]);
        let reach = |point: &[f64; 3]| norm(core::array::from_fn(|k| point[k] - sphere.centre[k]));
        let farthest = points.iter().map(reach).fold(0.0, f64::max);
        assert!(farthest <= sphere.radius * (1.0 + 1e-9), "{known}");
        assert!(sphere.radius - sphere.excess <= smallest * (1.0 + 1e-9), "{known}");
        assert!(sphere.excess < excess * smallest, "{known}: {}", sphere.excess);
    }
    // Without dropped points there is no excess.
    let few = &points[..4000];
    let view = View::around(&few[..30], few.len());
    let sphere = outline(few, &view).sphere(&view, &few[..30]);
    assert_eq!(sphere.excess, 0.0);
    let smallest = Ball::around(&vectors(few).collect::<Vec<_>>()).radius;
    assert!((sphere.radius / smallest - 1.0).abs() < 1e-9);
}

/// Checks that two points in a cell are no farther apart, in unit vectors, than its width.
#[test]
fn cells_are_as_wide_as_they_say() {
    for doubled in [20, 25, 28] {
        let mut first = BTreeMap::<u64, Vector3<f64>>::new();
        for point in cloud(20_000) {
            let from: [f64; 3] = core::array::from_fn(|k| (point[k] - 10.0) / (k + 1) as f64);
            let unit = Vector3::from(from).normalize();
            let known = first.entry(cell(from, doubled)).or_insert(unit);
            assert!((*known - unit).norm() <= width(doubled));
        }
    }
}
