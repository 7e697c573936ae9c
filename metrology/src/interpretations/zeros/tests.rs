//! Tests of `zeros.rs`.

use super::{ZeroForm, minimum};

/// The minimum of sums with known form is found.
#[test]
fn the_minimum_of_a_known_form_is_found() {
    let one = |x: f64| 3.0 + 2.0 * (x - 0.7).cos();
    let values = ZeroForm::Circle.nodes().map(one);
    let (found, sum) = minimum(&[ZeroForm::Circle], &values, 1);
    assert!((one(found[0]) - 1.0).abs() < 1e-12 && (sum - 1.0).abs() < 1e-12, "{found:?} {sum}");

    let two = |x: f64, y: f64| (1.5 - (x - 0.7).cos()) * (2.0 + (y - 30.0) * (y - 30.0));
    let line = ZeroForm::Line(100.0);
    let mut values = Vec::new();
    for x in ZeroForm::Circle.nodes() {
        values.extend(line.nodes().map(|y| two(x, y)));
    }
    let (found, sum) = minimum(&[ZeroForm::Circle, line], &values, 100);
    assert!((sum - 1.0).abs() < 1e-6, "{found:?} {sum}");
    assert!((found[0] - 0.7).abs() < 1e-6 && (found[1] - 30.0).abs() < 1e-6, "{found:?}");
}
