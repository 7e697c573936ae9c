//! Functions of numbers that languages lack, or define otherwise for NaN.

use super::{Body, Procedure, Value};
use crate::procedure::build::Real;

/// Describes a function of numbers with these arguments.
fn scalar<const N: usize>(
    name: &'static str,
    documentation: &str,
    arguments: [&'static str; N],
    write: impl FnOnce(&mut Body<'_>, [Value; N], Real),
) -> Procedure {
    Procedure::new(name, documentation, |b| {
        let arguments = arguments.map(|name| b.argument_real(name).get());
        let result = b.result_real("y");
        write(b, arguments, result);
    })
}

/// Nearest number of an interval.
pub fn clamped() -> Procedure {
    let documentation = "Returns the nearest value of an interval, and its lower end for NaN.";
    scalar("clamped", documentation, ["value", "lower", "upper"], |b, [value, lower, upper], y| {
        b.set(y, lower.clone());
        b.when(value.clone().exceeds(lower), |b| b.set(y, value));
        b.when(y.get().exceeds(upper.clone()), |b| b.set(y, upper));
    })
}

/// Sign of a number.
pub fn sign() -> Procedure {
    scalar("sign", "Returns -1, 0 or 1, and NaN for NaN.", ["x"], |b, [x], y| {
        b.set(y, x.clone() * 0.0);
        b.when(x.clone().exceeds(0.0), |b| b.set(y, 1.0));
        b.when(Value::from(0.0).exceeds(x), |b| b.set(y, -1.0));
    })
}

/// Derivative of the absolute value.
pub fn side() -> Procedure {
    let documentation = "Returns -1 for negative numbers, else 1: the derivative of the absolute value, at 0 the right-hand one.";
    scalar("side", documentation, ["x"], |b, [x], y| {
        b.set(y, x.clone());
        b.when(x.clone().is_at_least(0.0), |b| b.set(y, 1.0));
        b.when(Value::from(0.0).exceeds(x), |b| b.set(y, -1.0));
    })
}

/// Smaller and larger of two numbers.
pub fn least_and_greatest() -> [Procedure; 2] {
    let one = |name, documentation, is_least: bool| {
        scalar(name, documentation, ["a", "b"], |body, [a, b], y| {
            let [small, large] = if is_least { [&a, &b] } else { [&b, &a] };
            // NaN is not comparable with itself.
            body.set(y, a.clone());
            body.when(a.clone().is_at_least(a.clone()), |body| body.set(y, b.clone()));
            body.when(large.clone().exceeds(small.clone()), |body| body.set(y, a.clone()));
        })
    };
    [
        one("least", "Returns the smaller of two numbers, or NaN if one of them is NaN.", true),
        one("greatest", "Returns the larger of two numbers, or NaN if one of them is NaN.", false),
    ]
}
