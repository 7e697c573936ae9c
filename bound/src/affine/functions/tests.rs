//! Tests of `functions.rs`.

use super::*;

/// Checks at sample points that a function lies within the form, for each t.
fn encloses(low: f64, high: f64, f: impl Fn(f64) -> f64, form: impl Fn(&Affine<1>) -> Affine<1>) {
    let centre = 0.5 * low + 0.5 * high;
    let half = (high - centre).max(centre - low).next_up();
    let result = form(&Affine::new(centre, [half], 0.0));
    for k in 0..=200 {
        let t = f64::from(k) / 100.0 - 1.0;
        let x = (centre + t * half).clamp(low, high);
        let (value, there) = (f(x), result.centre + result.slopes[0] * (x - centre) / half);
        // Rounding errors of the test itself.
        let slack = 4.0 * UNIT * (value.abs() + result.centre.abs() + result.slopes[0].abs());
        assert!(
            (value - there).abs() <= result.rest + slack,
            "{low} {high}: f({x}) = {value}, not {result:?}"
        );
    }
}

const RANGES: [[f64; 2]; 9] = [
    [0.3, 0.3],
    [0.2, 0.2000001],
    [-0.5, 0.7],
    [0.1, 0.99999999],
    [-0.999_999_999_9, -0.3],
    [-1.4, 1.3],
    [1e-9, 1e-3],
    [2.0, 9.0],
    [-400.0, -399.0],
];

#[test]
fn functions_lie_where_their_forms_have_them() {
    use Function::{Abs, Acos, Asin, Atan, Cos, Exp, Log, Side, Sign, Sin, Sqrt, Tan};
    for [low, high] in RANGES {
        for function in [Sin, Cos, Tan, Asin, Acos, Atan, Sqrt, Abs, Exp, Log, Sign, Side] {
            let is_defined = match function {
                Asin | Acos => low >= -1.0 && high <= 1.0,
                Sqrt | Log => low > 0.0,
                _ => true,
            };
            if is_defined {
                encloses(low, high, |x| function.evaluate(x), |form| form.call(function).0);
            }
        }
        if low > 0.0 || high < 0.0 {
            encloses(low, high, |x| 1.0 / x, Affine::reciprocal);
        }
        if low > 0.0 {
            encloses(low, high, |x| x.powf(2.5), |form| form.power(2.5));
        }
        encloses(low, high, |x| x * x, |form| form.mul(form));
        encloses(
            low,
            high,
            |x| x.max(0.4 - x),
            |form| form.larger(&form.neg().shifted(&Affine::known(0.4, 0.0))),
        );
        encloses(
            low,
            high,
            |x| x.atan2(1.0 + x * x),
            |form| form.angle(&form.mul(form).shifted(&Affine::known(1.0, 0.0))).0,
        );
    }
}

/// Unbounded forms stay unbounded under further operations.
#[test]
fn what_is_not_known_stays_so() {
    let all = Affine::<1>::new(0.0, [2.0], 0.0);
    for form in [all.reciprocal(), all.call(Function::Log).0, all.call(Function::Tan).0, all.power(0.5)] {
        assert_eq!(form.range(), [f64::NEG_INFINITY, f64::INFINITY]);
        for further in [form.mul(&all), form.add(&form.neg()), form.mul(&Affine::known(0.0, 0.0))] {
            assert_eq!(further.range(), [f64::NEG_INFINITY, f64::INFINITY], "{further:?}");
        }
    }
}
