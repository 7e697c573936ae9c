//! Norms whose parts are polynomials of low degree in the sine and cosine of each angle and in each
//! linear name.
//!
//! Suppose no product contains more than one factor that depends on the sine or cosine of the same
//! name. Each part of the norm is then affine in the pair (cos q, sin q), and the norm is convex in
//! it. With two such factors a part is quadratic in the pair: so is the deflection of an elastic
//! joint, a product of its moment and its lever arm. The sine and cosine of a sum of angles are
//! affine in the pair of each angle:
//!
//! ```text
//! sin(a + b) = sin a cos b + cos a sin b        cos(a + b) = cos a cos b − sin a sin b
//! ```

use abbe_spec::expr::Function;

use crate::affine::Affine;
use crate::tape::{Register, Step, Tape};

/// A set of names as a bit mask.
pub(crate) type Names = u32;

/// Index of an operation.
pub(crate) type At = usize;

/// An operation on the results of earlier operations.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Operation {
    /// Sine (0) or cosine (1) of a name that is an angle, or a linear name (0).
    Name(usize, usize),
    Known(Affine<0>),
    Neg(At),
    Add(At, At),
    Mul(At, At),
    Sqrt(At),
    Abs(At),
    Larger(At, At),
}

impl Operation {
    pub(crate) fn operands(&self) -> impl Iterator<Item = At> {
        let (first, second) = match *self {
            Self::Name(..) | Self::Known(_) => (None, None),
            Self::Neg(a) | Self::Sqrt(a) | Self::Abs(a) => (Some(a), None),
            Self::Add(a, b) | Self::Mul(a, b) | Self::Larger(a, b) => (Some(a), Some(b)),
        };
        first.into_iter().chain(second)
    }
}

/// A norm of numbers that are affine or quadratic in each name.
#[derive(Clone, Debug)]
pub(crate) struct Convex {
    /// Operations; the last one computes the norm.
    pub(crate) operations: Vec<Operation>,
    /// `true` for a name that is an angle, `false` for a linear name.
    pub(crate) angles: Vec<bool>,
    /// Operations that compute the parts of the norm.
    pub(crate) parts: Vec<At>,
    /// Operations that compute the norm from its parts, the last one included.
    pub(crate) outer: Vec<At>,
    /// Names in which a part is quadratic.
    pub(crate) quadratic: Names,
}

/// Names that a number depends on, and those of them in which it is quadratic.
#[derive(Clone, Copy, Default)]
struct Degrees {
    names: Names,
    quadratic: Names,
}

impl Convex {
    /// Converts a tape whose first output is a norm of the other outputs. Returns `None` if one of
    /// these has a higher degree than two.
    pub(crate) fn new(tape: &Tape, names: usize) -> Option<Self> {
        let mut draft = Draft::new(names);
        for step in &tape.steps {
            draft.translate(step);
        }
        let mut numbers = tape.outputs.iter().map(|register| draft.number(*register));
        let norm = numbers.next()??;
        let mut parts = numbers.collect::<Option<Vec<At>>>()?;
        // A norm may use a part or its negative: take the one that the other is computed from.
        for part in &mut parts {
            if let Operation::Neg(a) = draft.operations[*part] {
                *part = a;
            }
        }
        parts.retain(|part| *part <= norm);
        let degrees = draft.degrees();
        let degrees = parts.iter().map(|part| degrees[*part]).collect::<Option<Vec<Degrees>>>()?;
        let quadratic = degrees.iter().fold(0, |names, own| names | own.quadratic);
        let is_clear = draft.turned.iter().zip(&draft.alone).all(|(turned, alone)| !(*turned && *alone));
        if parts.is_empty() || !is_clear {
            return None;
        }
        let outer = draft.outer(norm, &parts)?;
        draft.operations.truncate(norm + 1);
        Some(Self { operations: draft.operations, angles: draft.turned, parts, outer, quadratic })
    }
}

/// Value of a register of the tape.
#[derive(Clone, Debug)]
enum Value {
    Number(At),
    /// Sum of names or their negatives, each once, and a constant; not yet used as a number.
    Angle(Vec<(usize, bool)>, Affine<0>),
    /// Any other value.
    Other,
}

/// Operations under construction.
struct Draft {
    operations: Vec<Operation>,
    values: Vec<Value>,
    /// Names that occur in sines and cosines, and names that occur linearly.
    turned: Vec<bool>,
    alone: Vec<bool>,
}

impl Draft {
    fn new(names: usize) -> Self {
        let nothing = Affine::known(0.0, 0.0);
        let values = (0..names).map(|name| Value::Angle(vec![(name, false)], nothing)).collect();
        let operations = (0..2 * names).map(|i| Operation::Name(i / 2, i % 2)).collect();
        Self { operations, values, turned: vec![false; names], alone: vec![false; names] }
    }

    fn push(&mut self, operation: Operation) -> At {
        self.operations.push(operation);
        self.operations.len() - 1
    }

    fn known(&mut self, number: Affine<0>) -> At {
        self.push(Operation::Known(number))
    }

    /// Returns the value of a register as a number.
    fn number(&mut self, register: Register) -> Option<At> {
        let (names, offset) = match &self.values[register] {
            Value::Number(at) => return Some(*at),
            Value::Other => return None,
            Value::Angle(names, offset) => (names.clone(), *offset),
        };
        let mut sum = None;
        for (name, is_negative) in names {
            self.alone[name] = true;
            let own = if is_negative { self.push(Operation::Neg(2 * name)) } else { 2 * name };
            sum = Some(sum.map_or(own, |sum| self.push(Operation::Add(sum, own))));
        }
        let mut sum = sum?;
        if offset != Affine::known(0.0, 0.0) {
            let offset = self.known(offset);
            sum = self.push(Operation::Add(sum, offset));
        }
        self.values[register] = Value::Number(sum);
        Some(sum)
    }

    fn translate(&mut self, step: &Step) {
        if let Step::SinCos(a) = *step {
            let [sine, cosine] =
                self.sin_cos(a).map_or([Value::Other, Value::Other], |pair| pair.map(Value::Number));
            self.values.extend([sine, cosine]);
            return;
        }
        let value = self.angle(step).or_else(|| self.operation(step).map(Value::Number));
        self.values.push(value.unwrap_or(Value::Other));
    }

    /// Returns the result of a step on angles if it is an angle.
    fn angle(&self, step: &Step) -> Option<Value> {
        let of = |register: Register| match &self.values[register] {
            Value::Angle(names, offset) => Some((names.clone(), *offset)),
            _ => None,
        };
        let negative = |(names, offset): (Vec<(usize, bool)>, Affine<0>)| {
            (
                names.into_iter().map(|(name, is_negative)| (name, !is_negative)).collect::<Vec<_>>(),
                offset.neg(),
            )
        };
        let sum = |first: (Vec<(usize, bool)>, Affine<0>), second: (Vec<(usize, bool)>, Affine<0>)| {
            let is_new = second.0.iter().all(|(name, _)| first.0.iter().all(|(other, _)| other != name));
            is_new.then(|| ([first.0, second.0].concat(), first.1.add(&second.1)))
        };
        let (names, offset) = match *step {
            Step::Neg(a) => negative(of(a)?),
            Step::Shift(a, number) => {
                let (names, offset) = of(a)?;
                (names, offset.add(&number))
            }
            Step::Add(a, b) => sum(of(a)?, of(b)?)?,
            Step::Sub(a, b) => sum(of(a)?, negative(of(b)?))?,
            _ => return None,
        };
        Some(Value::Angle(names, offset))
    }

    /// Expands the sine and cosine of an angle, name by name.
    fn sin_cos(&mut self, register: Register) -> Option<[At; 2]> {
        let Value::Angle(names, offset) = self.values[register].clone() else { return None };
        let mut pair = match offset == Affine::known(0.0, 0.0) {
            true => None,
            false => Some(offset.sin_cos().map(|part| self.known(part))),
        };
        for (name, is_negative) in names {
            self.turned[name] = true;
            let sine = if is_negative { self.push(Operation::Neg(2 * name)) } else { 2 * name };
            let own = [sine, 2 * name + 1];
            pair = Some(match pair {
                None => own,
                Some(pair) => self.turned_by(pair, own),
            });
        }
        pair
    }

    fn turned_by(&mut self, [sine, cosine]: [At; 2], [other_sine, other_cosine]: [At; 2]) -> [At; 2] {
        let mut product = |a, b| self.push(Operation::Mul(a, b));
        let (first, second) = (product(sine, other_cosine), product(cosine, other_sine));
        let (third, fourth) = (product(cosine, other_cosine), product(sine, other_sine));
        let fourth = self.push(Operation::Neg(fourth));
        [self.push(Operation::Add(first, second)), self.push(Operation::Add(third, fourth))]
    }

    fn operation(&mut self, step: &Step) -> Option<At> {
        let operation = match *step {
            Step::Known(number) => Operation::Known(number),
            Step::Neg(a) => Operation::Neg(self.number(a)?),
            Step::Add(a, b) => Operation::Add(self.number(a)?, self.number(b)?),
            Step::Sub(a, b) => {
                let (a, b) = (self.number(a)?, self.number(b)?);
                Operation::Add(a, self.push(Operation::Neg(b)))
            }
            Step::Shift(a, number) => Operation::Add(self.number(a)?, self.known(number)),
            Step::Scale(a, number) => Operation::Mul(self.number(a)?, self.known(number)),
            Step::Mul(a, b) => Operation::Mul(self.number(a)?, self.number(b)?),
            Step::Power(a, 2.0) => {
                let a = self.number(a)?;
                Operation::Mul(a, a)
            }
            Step::Call(Function::Sqrt, a) => Operation::Sqrt(self.number(a)?),
            Step::Call(Function::Abs, a) => Operation::Abs(self.number(a)?),
            Step::Larger(a, b) => Operation::Larger(self.number(a)?, self.number(b)?),
            _ => return None,
        };
        Some(self.push(operation))
    }

    /// Returns the degrees of each operation; `None` above two, or if it is no polynomial.
    fn degrees(&self) -> Vec<Option<Degrees>> {
        let mut degrees: Vec<Option<Degrees>> = Vec::with_capacity(self.operations.len());
        for operation in &self.operations {
            let pair = |a: At, b: At| degrees[a].zip(degrees[b]);
            let own = match *operation {
                Operation::Name(name, _) => Some(Degrees { names: 1 << name, quadratic: 0 }),
                Operation::Known(_) => Some(Degrees::default()),
                Operation::Neg(a) => degrees[a],
                Operation::Add(a, b) => pair(a, b).map(|(a, b)| a.joined(b)),
                Operation::Mul(a, b) => pair(a, b).and_then(|(a, b)| a.times(b)),
                Operation::Sqrt(_) | Operation::Abs(_) | Operation::Larger(..) => None,
            };
            degrees.push(own);
        }
        degrees
    }

    /// Returns the operations that compute the norm from its parts; `None` if it depends on names
    /// in another way.
    fn outer(&self, norm: At, parts: &[At]) -> Option<Vec<At>> {
        let mut is_needed = vec![false; self.operations.len()];
        is_needed[norm] = true;
        let mut outer = Vec::new();
        for (at, operation) in self.operations.iter().enumerate().rev() {
            if !is_needed[at] || parts.contains(&at) {
                continue;
            }
            if matches!(operation, Operation::Name(..)) {
                return None;
            }
            outer.push(at);
            operation.operands().for_each(|operand| is_needed[operand] = true);
        }
        outer.reverse();
        Some(outer)
    }
}

impl Degrees {
    fn joined(self, other: Self) -> Self {
        Self { names: self.names | other.names, quadratic: self.quadratic | other.quadratic }
    }

    /// Returns the degrees of a product; `None` above two.
    fn times(self, other: Self) -> Option<Self> {
        let both = self.names & other.names;
        let sum = self.joined(other);
        (both & sum.quadratic == 0).then_some(Self { quadratic: sum.quadratic | both, ..sum })
    }
}
