//! Proof by interval arithmetic that results of a program are finite, which saves checks of them at
//! run time.
//!
//! The symbols are within a box around 0. Products and sums of bounded numbers are bounded; a
//! quotient is bounded if its divisor cannot be near 0; what is not known to be bounded is not.

use abbe_spec::{Function, Symbol};

use super::{Action, Operand, Program};

/// Bounds of a number: its least and its largest value.
type Interval = [f64; 2];

/// Interval of a number that may be infinite or NaN.
const UNKNOWN: Interval = [f64::NEG_INFINITY, f64::INFINITY];

/// Factor by which rounding errors may exceed an interval, many times over.
const SLACK: f64 = 1e-6;

impl Program {
    /// Returns which outputs are finite if the absolute value of every symbol is at most `limit`
    /// and `margin`, an output, at least `least`. `largest` is the largest number of the
    /// floating-point type.
    pub fn finite_outputs(&self, limit: f64, margin: Option<(Operand, f64)>, largest: f64) -> Vec<bool> {
        let mut registers = vec![UNKNOWN; self.registers];
        for step in &self.steps {
            let value = |operand: Operand| match operand {
                Operand::Constant(value) => [value; 2],
                Operand::Symbol(Symbol::Local(_)) => UNKNOWN,
                Operand::Symbol(_) => [-limit, limit],
                Operand::Register(register) => registers[register],
            };
            let divisor = |operand: Operand| match (value(operand), margin) {
                ([_, upper], Some((margin, least))) if margin == operand => [least, upper],
                (interval, _) => interval,
            };
            let product = |a: Operand, b: Operand| times(value(a), value(b), a == b);
            let result = match step.action {
                Action::Neg(a) => negative(value(a)),
                Action::Add(a, b) => sum(value(a), value(b)),
                Action::Sub(a, b) => sum(value(a), negative(value(b))),
                Action::Mul(a, b) => product(a, b),
                Action::MulAdd(a, b, c) => sum(product(a, b), value(c)),
                Action::MulSub(a, b, c) => sum(product(a, b), negative(value(c))),
                Action::NegMulAdd(a, b, c) => sum(negative(product(a, b)), value(c)),
                Action::Div(a, b) => times(value(a), reciprocal(divisor(b)), false),
                Action::Call(function, a) => call(function, value(a)),
                Action::SinCos(a) => call(Function::Sin, value(a)),
                Action::Atan2(a, b) if is_bounded(value(a)) && is_bounded(value(b)) => [-4.0, 4.0],
                Action::Min(a, b) | Action::Max(a, b) => {
                    let ([a, b], [c, d]) = (value(a), value(b));
                    [a.min(c), b.max(d)]
                }
                Action::Atan2(..) | Action::Pow(..) | Action::Lookup(..) => UNKNOWN,
            };
            // Far below the largest number, so that rounding errors cannot exceed it.
            let is_representable = result.iter().all(|end| end.abs() < largest * SLACK);
            let result = if is_representable { result } else { UNKNOWN };
            let is_pair = matches!(step.action, Action::SinCos(_));
            registers[step.register..=step.register + usize::from(is_pair)].fill(result);
        }
        let is_finite = |output: &Operand| match *output {
            Operand::Constant(value) => value.is_finite(),
            Operand::Symbol(Symbol::Local(_)) => false,
            Operand::Symbol(_) => true,
            Operand::Register(register) => is_bounded(registers[register]),
        };
        self.outputs.iter().map(is_finite).collect()
    }
}

fn is_bounded(interval: Interval) -> bool {
    interval.iter().all(|end| end.is_finite())
}

fn negative([lower, upper]: Interval) -> Interval {
    [-upper, -lower]
}

fn sum(a: Interval, b: Interval) -> Interval {
    [a[0] + b[0], a[1] + b[1]]
}

fn times(a: Interval, b: Interval, is_square: bool) -> Interval {
    if !(is_bounded(a) && is_bounded(b)) {
        return UNKNOWN;
    }
    let corners = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    let lower = corners.into_iter().fold(f64::INFINITY, f64::min);
    let upper = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
    [if is_square { lower.max(0.0) } else { lower }, upper]
}

/// Returns the interval of 1/x, unless x may be near 0.
fn reciprocal([lower, upper]: Interval) -> Interval {
    let least = SLACK * lower.abs().max(upper.abs()).min(1.0);
    let excludes_0 = lower > least || upper < -least;
    if is_bounded([lower, upper]) && excludes_0 { [1.0 / upper, 1.0 / lower] } else { UNKNOWN }
}

fn call(function: Function, [lower, upper]: Interval) -> Interval {
    match function {
        _ if !is_bounded([lower, upper]) => UNKNOWN,
        Function::Sin | Function::Cos | Function::Sign | Function::Side => [-1.0 - SLACK, 1.0 + SLACK],
        Function::Atan => [-2.0, 2.0],
        Function::Sqrt if lower >= 0.0 => [0.0, upper.sqrt()],
        Function::Abs if lower >= 0.0 => [lower, upper],
        Function::Abs => [0.0, lower.abs().max(upper)],
        Function::Exp if upper < 50.0 => [0.0, upper.exp() * (1.0 + SLACK)],
        Function::Sqrt | Function::Exp | Function::Tan | Function::Asin | Function::Acos | Function::Log => {
            UNKNOWN
        }
    }
}

#[cfg(test)]
mod tests;
