//! Lookup of a table: the algorithm of [`LookupTable`].
//!
//! Functions of numbers that languages lack, or define otherwise for NaN.

use abbe_core::LookupTable;

use super::{Body, Index, Procedure, Value, Whole};
use crate::procedure::build::Real;

/// Returns the procedure for a derivative of a table at x; order 0 is the table itself. `scale` is
/// the number of buckets per unit of x.
pub fn look_up(table: &LookupTable<'_>, scale: f64, documentation: String) -> Procedure {
    let is_even = table.starts.is_empty();
    let buckets = if is_even { table.pieces.len() } else { table.starts.len() } - 2;
    Procedure::new("look_up", documentation, |b| {
        let (order, x) = (b.argument_whole("order"), b.argument_real("x"));
        let value = b.result_real("value");
        let piece = b.whole("piece");
        let [u, t] = ["u", "t"].map(|name| b.real(name));
        let coefficients = ["c0", "c1", "c2", "c3"].map(|name| b.real(name));
        b.set(u, (x.get() - table.first) * scale);
        b.set_whole(piece, Whole::Nearest((u.get() - 0.5).clamped(-1.0, buckets as f64)));
        b.set(t, u.get() - Value::Whole(piece.into()));
        b.set_whole(piece, Whole::Index(piece + 1));
        if !is_even {
            let starts: Vec<f64> = table.starts.iter().map(|start| f64::from(*start)).collect();
            let starts = b.constant("starts", &starts);
            // No x is beyond the knots behind the last one.
            let behind = vec![f64::INFINITY; (1 << table.steps) - 1];
            let knots = b.constant("knots", &[table.knots, &behind].concat());
            b.set_whole(piece, Whole::Nearest(starts.at(piece)));
            for step in (0..table.steps).rev() {
                let next: Index = piece + (1_usize << step);
                b.when(x.get().exceeds(knots.at(next.clone())), |b| b.set_whole(piece, Whole::Index(next)));
            }
            b.set(t, x.get() - knots.at(piece));
        }
        let pieces = b.constant("pieces", table.pieces.as_flattened());
        for (k, coefficient) in coefficients.into_iter().enumerate() {
            b.set(coefficient, pieces.at(4 * piece + k));
        }
        let [c0, c1, c2, c3] = coefficients.map(|coefficient| coefficient.get());
        let t = t.get();
        let times = |factor: f64, value: &Value| Value::from(factor) * value.clone();
        let plus = |value: Value, other: &Value| t.clone() * value + other.clone();
        let derivatives = [
            plus(plus(plus(c3.clone(), &c2), &c1), &c0),
            plus(plus(times(3.0, &c3), &times(2.0, &c2)), &c1),
            plus(times(6.0, &c3), &times(2.0, &c2)),
            times(6.0, &c3),
        ];
        for (k, derivative) in derivatives.into_iter().enumerate() {
            let units = if is_even { k } else { 0 };
            let scaled = (0..units).fold(derivative, |value, _| times(scale, &value));
            match k {
                0 => b.set(value, scaled),
                k => b.when(order.is(k), |b| b.set(value, scaled)),
            }
        }
    })
}

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
