//! Bounds of rounding errors by a running error analysis of the program's operations (Higham,
//! *Accuracy and Stability of Numerical Algorithms*, 3.3).
//!
//! The error of an operation on `a ± α` and `b ± β` is the change of `f(a, b)` over these intervals
//! plus the rounding of its result.

use std::ops::{Add, Mul};
use std::sync::Arc;

use abbe_spec::expr::{Binary, Function, Symbol, Table};

use super::{Action, Operand, Program};

/// Maximum error of library functions and table lookups, in units of roundoff.
const LIBRARY: f64 = 8.0;
/// Maximum error of our own sine and cosine, in units of roundoff.
const SINE: f64 = 5.0;

/// A number and a bound of the error of its computed value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounded {
    /// Exact value.
    pub value: f64,
    /// Maximum absolute error of the computed value; infinite or NaN if unknown.
    pub bound: f64,
    /// Unit of roundoff: maximum relative error of rounding.
    unit: f64,
}

impl Rounded {
    /// Creates a number that is rounded to the nearest representable one.
    pub fn new(value: f64, unit: f64) -> Self {
        Self { value, bound: unit * value.abs(), unit }
    }

    /// Creates a number that is represented exactly.
    pub fn exact(value: f64, unit: f64) -> Self {
        Self { value, bound: 0.0, unit }
    }

    /// Applies a function whose own error is at most `units` units of roundoff.
    fn apply<const N: usize>(operands: [Self; N], units: f64, f: impl Fn([f64; N]) -> f64) -> Self {
        let value = f(operands.map(|operand| operand.value));
        let corner = |corner: usize| {
            let at = |k: usize| match corner >> k & 1 {
                0 => operands[k].value - operands[k].bound,
                _ => operands[k].value + operands[k].bound,
            };
            (f(std::array::from_fn(at)) - value).abs()
        };
        // Unlike `max`, this keeps NaN.
        let larger = |a: f64, b: f64| if a >= b || a.is_nan() { a } else { b };
        let moved = (0..1 << N).map(corner).fold(0.0, larger);
        let unit = operands[0].unit;
        Self { value, bound: moved + units * unit * (value.abs() + moved), unit }
    }

    /// Applies the sine or cosine, whose change is at most that of the angle.
    fn turned(self, f: impl Fn(f64) -> f64) -> Self {
        let value = f(self.value);
        Self { value, bound: self.bound + SINE * self.unit * (value.abs() + self.bound), ..self }
    }
}

impl Add for Rounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::apply([self, other], 1.0, |[a, b]| a + b)
    }
}

impl Mul for Rounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::apply([self, other], 1.0, |[a, b]| a * b)
    }
}

impl Program {
    /// Returns the outputs at values of the symbols, computed with the given unit of roundoff.
    pub fn rounded(
        &self,
        tables: &[Arc<Table>],
        symbol: impl Fn(Symbol) -> Rounded,
        unit: f64,
    ) -> Vec<Rounded> {
        let mut registers = vec![Rounded::exact(f64::NAN, unit); self.registers];
        let of = |registers: &[Rounded], operand: Operand| match operand {
            Operand::Constant(value) => Rounded::new(value, unit),
            Operand::Symbol(given) => symbol(given),
            Operand::Register(register) => registers[register],
        };
        for step in &self.steps {
            let v = |operand: Operand| of(&registers, operand);
            let negative = |a: Rounded| Rounded { value: -a.value, ..a };
            let value = match step.action {
                Action::Neg(a) => negative(v(a)),
                Action::Add(a, b) => v(a) + v(b),
                Action::Sub(a, b) => v(a) + negative(v(b)),
                Action::Mul(a, b) => v(a) * v(b),
                Action::MulAdd(a, b, c) => v(a) * v(b) + v(c),
                Action::MulSub(a, b, c) => v(a) * v(b) + negative(v(c)),
                Action::NegMulAdd(a, b, c) => v(c) + negative(v(a) * v(b)),
                Action::Div(a, b) => Rounded::apply([v(a), v(b)], 1.0, |[a, b]| a / b),
                Action::Pow(a, b) => Rounded::apply([v(a), v(b)], LIBRARY, |[a, b]| a.powf(b)),
                Action::Atan2(a, b) => Rounded::apply([v(a), v(b)], LIBRARY, |[a, b]| a.atan2(b)),
                Action::Min(a, b) => Rounded::apply([v(a), v(b)], 0.0, |[a, b]| Binary::Min.evaluate(a, b)),
                Action::Max(a, b) => Rounded::apply([v(a), v(b)], 0.0, |[a, b]| Binary::Max.evaluate(a, b)),
                Action::Call(Function::Sin, a) => v(a).turned(f64::sin),
                Action::Call(Function::Cos, a) => v(a).turned(f64::cos),
                Action::Call(Function::Sqrt, a) => Rounded::apply([v(a)], 1.0, |[a]| a.sqrt()),
                Action::Call(Function::Abs, a) => Rounded::apply([v(a)], 0.0, |[a]| a.abs()),
                Action::Call(function, a) => Rounded::apply([v(a)], LIBRARY, |[a]| function.evaluate(a)),
                Action::Lookup(lookup, a) => {
                    let table = &tables[usize::from(lookup.table)];
                    let x = v(a);
                    // The start of a piece is rounded as well.
                    let far = x.value.abs() + table.ends()[0].abs();
                    let x = Rounded { bound: x.bound + LIBRARY * unit * far, ..x };
                    Rounded::apply([x], LIBRARY, |[x]| table.derivative(u32::from(lookup.order), x))
                }
                Action::SinCos(a) => {
                    registers[step.register + 1] = v(a).turned(f64::cos);
                    of(&registers, a).turned(f64::sin)
                }
            };
            registers[step.register] = value;
        }
        self.outputs.iter().map(|output| of(&registers, *output)).collect()
    }
}
