//! How far rounding can take what a program computes from what it should be: its operations, one by one (a running
//! error analysis: Higham, *Accuracy and Stability of Numerical Algorithms*, 3.3).
//!
//! An operation on `a ± α` and `b ± β` gives `f(a, b)`, but for how far `f` goes where the operands are that far off, and for
//! the rounding of its result.

use std::ops::{Add, Mul};
use std::sync::Arc;

use abbe_spec::expr::{Binary, Function, Symbol, Table};

use super::{Action, Operand, Program};

/// The units of roundoff by which functions of a library, and look-ups in tables, may be off.
const LIBRARY: f64 = 8.0;
/// … and our own sine and cosine.
const SINE: f64 = 5.0;

/// A number, and by how much what is computed may differ from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounded {
    /// What it should be.
    pub value: f64,
    /// At most so far from that; infinite or not a number if nothing is known.
    pub bound: f64,
    /// The share by which rounding changes a number at most.
    unit: f64,
}

impl Rounded {
    /// A number of which the nearest is taken.
    pub fn new(value: f64, unit: f64) -> Self {
        Self { value, bound: unit * value.abs(), unit }
    }

    /// A number that is held as it is.
    pub fn exact(value: f64, unit: f64) -> Self {
        Self { value, bound: 0.0, unit }
    }

    /// What a function makes of operands, if its result is off by so many units at most.
    fn of<const N: usize>(operands: [Self; N], units: f64, f: impl Fn([f64; N]) -> f64) -> Self {
        let value = f(operands.map(|operand| operand.value));
        let corner = |corner: usize| {
            let at = |k: usize| match corner >> k & 1 {
                0 => operands[k].value - operands[k].bound,
                _ => operands[k].value + operands[k].bound,
            };
            (f(std::array::from_fn(at)) - value).abs()
        };
        // Unlike `max`, this keeps what is not a number.
        let larger = |a: f64, b: f64| if a >= b || a.is_nan() { a } else { b };
        let moved = (0..1 << N).map(corner).fold(0.0, larger);
        let unit = operands[0].unit;
        Self { value, bound: moved + units * unit * (value.abs() + moved), unit }
    }

    /// Sine and cosine, which no angle moves by more than itself.
    fn turned(self, f: impl Fn(f64) -> f64) -> Self {
        let value = f(self.value);
        Self { value, bound: self.bound + SINE * self.unit * (value.abs() + self.bound), ..self }
    }
}

impl Add for Rounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::of([self, other], 1.0, |[a, b]| a + b)
    }
}

impl Mul for Rounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::of([self, other], 1.0, |[a, b]| a * b)
    }
}

impl Program {
    /// What it gives at values of the symbols that are held as they are, computed in numbers of that unit of roundoff.
    pub fn rounded(&self, tables: &[Arc<Table>], symbol: impl Fn(Symbol) -> f64, unit: f64) -> Vec<Rounded> {
        let mut registers = vec![Rounded::exact(f64::NAN, unit); self.registers];
        let of = |registers: &[Rounded], operand: Operand| match operand {
            Operand::Constant(value) => Rounded::new(value, unit),
            Operand::Symbol(symbol_) => Rounded::exact(symbol(symbol_), unit),
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
                Action::Div(a, b) => Rounded::of([v(a), v(b)], 1.0, |[a, b]| a / b),
                Action::Pow(a, b) => Rounded::of([v(a), v(b)], LIBRARY, |[a, b]| a.powf(b)),
                Action::Atan2(a, b) => Rounded::of([v(a), v(b)], LIBRARY, |[a, b]| a.atan2(b)),
                Action::Min(a, b) => Rounded::of([v(a), v(b)], 0.0, |[a, b]| Binary::Min.of(a, b)),
                Action::Max(a, b) => Rounded::of([v(a), v(b)], 0.0, |[a, b]| Binary::Max.of(a, b)),
                Action::Call(Function::Sin, a) => v(a).turned(f64::sin),
                Action::Call(Function::Cos, a) => v(a).turned(f64::cos),
                Action::Call(Function::Sqrt, a) => Rounded::of([v(a)], 1.0, |[a]| a.sqrt()),
                Action::Call(Function::Abs, a) => Rounded::of([v(a)], 0.0, |[a]| a.abs()),
                Action::Call(function, a) => Rounded::of([v(a)], LIBRARY, |[a]| function.of(a)),
                Action::Lookup(lookup, a) => {
                    let table = &tables[usize::from(lookup.table)];
                    let x = v(a);
                    // Where a piece begins is rounded, too.
                    let far = x.value.abs() + table.ends()[0].abs();
                    let x = Rounded { bound: x.bound + LIBRARY * unit * far, ..x };
                    Rounded::of([x], LIBRARY, |[x]| table.derivative(u32::from(lookup.order), x))
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
