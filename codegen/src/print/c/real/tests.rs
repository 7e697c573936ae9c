//! Tests of `real.rs`.

use super::Real;

#[test]
fn numbers_have_the_fewest_digits_that_give_them_back() {
    assert_eq!(Real::Float.number(0.1), "0.1f");
    assert_eq!(Real::Float.number(std::f64::consts::PI), "3.1415927f");
    assert_eq!(Real::Float.number(1e-7), "1e-7f");
    assert_eq!(Real::Float.number(-2000.0), "-2000.0f");
    assert_eq!(Real::Double.number(0.1), "0.1");
    assert_eq!(Real::Float.number(f64::NEG_INFINITY), "-HUGE_VALF");
    assert_eq!([Real::Double.rounder(), Real::Float.rounder()], ["6755399441055744.0", "12582912.0f"]);
}

#[test]
fn a_text_is_told_in_single_precision() {
    let text = "/* sqrt(2.0) */ const double x1 = sqrt(y - 1e-3) + 2.0 * a[1U]; /* double */ int k = 10;";
    let converted =
        "/* sqrt(2.0) */ const float x1 = sqrtf(y - 0.001f) + 2.0f * a[1U]; /* double */ int k = 10;";
    assert_eq!(Real::Float.text(text), converted);
    assert_eq!(Real::Double.text("x = 6755399441055744.0;"), "x = 6755399441055744.0;");
}
