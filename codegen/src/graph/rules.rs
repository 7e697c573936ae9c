//! The constructors of nodes, and with them every simplification there is: exact ones only.
//!
//! Signs move outwards until a sum takes them in, so that a term and its negative share one node.

use std::f64::consts::FRAC_PI_2;

use super::{Graph, Node, Op};
use crate::expr::{Function, Lookup, Symbol};

/// The largest whole exponent that is written out as multiplications.
const LARGEST_WRITTEN_POWER: f64 = 16.0;

impl Graph {
    /// A number; there is one zero.
    ///
    /// ```
    /// # use abbe_codegen::graph::Graph;
    /// let mut g = Graph::new();
    /// let two = g.constant(2.0);
    /// assert_eq!(g.constant(-2.0), g.neg(two));
    /// assert_eq!(g.constant(-0.0), g.constant(0.0));
    /// ```
    pub fn constant(&mut self, value: f64) -> Node {
        self.intern(Op::Constant((value + 0.0).to_bits()))
    }

    /// The number 0.
    pub fn zero(&mut self) -> Node {
        self.constant(0.0)
    }

    /// A variable, parameter, input or generalized error.
    pub fn symbol(&mut self, symbol: Symbol) -> Node {
        self.intern(Op::Symbol(symbol))
    }

    /// `-a`: a double sign vanishes, and so does a difference the other way round.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let (a, b) = (g.symbol(Symbol::Variable(0)), g.symbol(Symbol::Variable(1)));
    /// let difference = g.sub(a, b);
    /// let turned = g.neg(difference);
    /// assert_eq!(turned, g.sub(b, a));
    /// assert_eq!(g.neg(turned), difference);
    /// ```
    pub fn neg(&mut self, a: Node) -> Node {
        match self.op(a) {
            Op::Constant(bits) => self.constant(-f64::from_bits(bits)),
            Op::Neg(inner) => inner,
            _ => self.intern(Op::Neg(a)),
        }
    }

    /// `a + b`: zero vanishes, operands are ordered, signs make differences, and `sin² + cos² = 1`.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let (a, b, zero) = (g.symbol(Symbol::Variable(0)), g.symbol(Symbol::Variable(1)), g.zero());
    /// assert_eq!(g.add(a, zero), a);
    /// assert_eq!(g.add(a, b), g.add(b, a));
    /// let (s, c) = (g.sin(a), g.cos(a));
    /// let (ss, cc) = (g.mul(s, s), g.mul(c, c));
    /// assert_eq!(g.add(ss, cc), g.constant(1.0));
    /// ```
    pub fn add(&mut self, a: Node, b: Node) -> Node {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => return self.folded(x + y, Op::Add(a, b)),
            (Some(0.0), _) => return b,
            (_, Some(0.0)) => return a,
            _ => {}
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => {
                let sum = self.add(x, y);
                return self.neg(sum);
            }
            (Some(x), None) => return self.sub(b, x),
            (None, Some(y)) => return self.sub(a, y),
            (None, None) => {}
        }
        if self.squares_of_sine_and_cosine(a, b) {
            return self.constant(1.0);
        }
        self.intern(Op::Add(a.min(b), a.max(b)))
    }

    /// `a - b`: zero and equal operands vanish; a difference known the other way round is its negative.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let (a, b, zero) = (g.symbol(Symbol::Variable(0)), g.symbol(Symbol::Variable(1)), g.zero());
    /// assert_eq!(g.sub(a, a), zero);
    /// assert_eq!(g.sub(a, zero), a);
    /// let minus_b = g.neg(b);
    /// assert_eq!(g.sub(a, minus_b), g.add(a, b));
    /// ```
    pub fn sub(&mut self, a: Node, b: Node) -> Node {
        if a == b {
            return self.zero();
        }
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => return self.folded(x - y, Op::Sub(a, b)),
            (Some(0.0), _) => return self.neg(b),
            (_, Some(0.0)) => return a,
            _ => {}
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => return self.sub(y, x),
            (Some(x), None) => {
                let sum = self.add(x, b);
                return self.neg(sum);
            }
            (None, Some(y)) => return self.add(a, y),
            (None, None) => {}
        }
        match self.find(Op::Sub(b, a)) {
            Some(turned) if self.find(Op::Sub(a, b)).is_none() => self.intern(Op::Neg(turned)),
            _ => self.intern(Op::Sub(a, b)),
        }
    }

    /// `a · b`: 0, 1 and −1 vanish, operands are ordered, signs move out.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let (a, b, zero) = (g.symbol(Symbol::Variable(0)), g.symbol(Symbol::Variable(1)), g.zero());
    /// let one = g.constant(1.0);
    /// assert_eq!(g.mul(a, one), a);
    /// assert_eq!(g.mul(a, zero), zero);
    /// let (minus_a, product) = (g.neg(a), g.mul(a, b));
    /// assert_eq!(g.mul(b, minus_a), g.neg(product));
    /// ```
    pub fn mul(&mut self, a: Node, b: Node) -> Node {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => return self.folded(x * y, Op::Mul(a, b)),
            (Some(0.0), _) | (_, Some(0.0)) => return self.zero(),
            (Some(1.0), _) => return b,
            (_, Some(1.0)) => return a,
            _ => {}
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => self.mul(x, y),
            (Some(x), None) => {
                let product = self.mul(x, b);
                self.neg(product)
            }
            (None, Some(y)) => {
                let product = self.mul(a, y);
                self.neg(product)
            }
            (None, None) => self.intern(Op::Mul(a.min(b), a.max(b))),
        }
    }

    /// `a / b`: `0/b` and `a/1` vanish, signs move out. A constant zero below stays: its value is no number.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let (a, b, zero) = (g.symbol(Symbol::Variable(0)), g.symbol(Symbol::Variable(1)), g.zero());
    /// let one = g.constant(1.0);
    /// assert_eq!(g.div(a, one), a);
    /// assert_eq!(g.div(zero, b), zero);
    /// ```
    pub fn div(&mut self, a: Node, b: Node) -> Node {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => return self.folded(x / y, Op::Div(a, b)),
            (_, Some(1.0)) => return a,
            (Some(0.0), None) => return a,
            _ => {}
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => self.div(x, y),
            (Some(x), None) => {
                let quotient = self.div(x, b);
                self.neg(quotient)
            }
            (None, Some(y)) => {
                let quotient = self.div(a, y);
                self.neg(quotient)
            }
            (None, None) => self.intern(Op::Div(a, b)),
        }
    }

    /// `base ^ exponent`: whole exponents become products, halves square roots.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let a = g.symbol(Symbol::Variable(0));
    /// assert_eq!(g.power(a, 2.0), g.mul(a, a));
    /// assert_eq!(g.power(a, 0.5), g.sqrt(a));
    /// assert_eq!(g.power(a, 0.0), g.constant(1.0));
    /// ```
    pub fn power(&mut self, base: Node, exponent: f64) -> Node {
        if exponent < 0.0 {
            let (one, below) = (self.constant(1.0), self.power(base, -exponent));
            return self.div(one, below);
        }
        let whole = exponent.trunc();
        if whole > LARGEST_WRITTEN_POWER || (exponent - whole != 0.0 && exponent - whole != 0.5) {
            let exponent = self.constant(exponent);
            let folded = self.value(base).zip(self.value(exponent)).map(|(b, e)| b.powf(e));
            let op = Op::Pow(base, exponent);
            return match folded {
                Some(value) => self.folded(value, op),
                None => self.intern(op),
            };
        }
        let mut result = if exponent == whole { self.constant(1.0) } else { self.sqrt(base) };
        let (mut remaining, mut square) = (whole as u32, base);
        while remaining > 0 {
            if remaining % 2 == 1 {
                result = self.mul(result, square);
            }
            remaining /= 2;
            if remaining > 0 {
                square = self.mul(square, square);
            }
        }
        result
    }

    /// Sine: odd, and exact at (and shifted by) multiples of π/2.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let a = g.symbol(Symbol::Variable(0));
    /// let right = g.constant(std::f64::consts::FRAC_PI_2);
    /// assert_eq!(g.sin(right), g.constant(1.0));
    /// assert_eq!(g.cos(right), g.zero());
    /// let shifted = g.add(a, right);
    /// assert_eq!(g.sin(shifted), g.cos(a));
    /// let (minus_a, sine) = (g.neg(a), g.sin(a));
    /// assert_eq!(g.sin(minus_a), g.neg(sine));
    /// ```
    pub fn sin(&mut self, a: Node) -> Node {
        if let Some(angle) = self.negated(a) {
            let sine = self.sin(angle);
            return self.neg(sine);
        }
        let (angle, quarters) = self.quarter_turns(a);
        match quarters {
            0 if angle == a => self.called(Function::Sin, a),
            0 => self.sin(angle),
            1 => self.cos(angle),
            2 => {
                let sine = self.sin(angle);
                self.neg(sine)
            }
            _ => {
                let cosine = self.cos(angle);
                self.neg(cosine)
            }
        }
    }

    /// Cosine: even, and exact at (and shifted by) multiples of π/2.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let a = g.symbol(Symbol::Variable(0));
    /// let half = g.constant(std::f64::consts::PI);
    /// let (shifted, cosine) = (g.sub(a, half), g.cos(a));
    /// assert_eq!(g.cos(shifted), g.neg(cosine));
    /// let minus_a = g.neg(a);
    /// assert_eq!(g.cos(minus_a), cosine);
    /// ```
    pub fn cos(&mut self, a: Node) -> Node {
        if let Some(angle) = self.negated(a) {
            return self.cos(angle);
        }
        let (angle, quarters) = self.quarter_turns(a);
        match quarters {
            0 if angle == a => self.called(Function::Cos, a),
            0 => self.cos(angle),
            1 => {
                let sine = self.sin(angle);
                self.neg(sine)
            }
            2 => {
                let cosine = self.cos(angle);
                self.neg(cosine)
            }
            _ => self.sin(angle),
        }
    }

    /// Square root.
    ///
    /// ```
    /// # use abbe_codegen::graph::Graph;
    /// # let mut g = Graph::new();
    /// let four = g.constant(4.0);
    /// assert_eq!(g.sqrt(four), g.constant(2.0));
    /// ```
    pub fn sqrt(&mut self, a: Node) -> Node {
        self.called(Function::Sqrt, a)
    }

    /// The angle of the point `(x, y)`.
    pub fn atan2(&mut self, y: Node, x: Node) -> Node {
        match (self.value(y), self.value(x)) {
            (Some(a), Some(b)) => self.folded(a.atan2(b), Op::Atan2(y, x)),
            _ => self.intern(Op::Atan2(y, x)),
        }
    }

    /// The smaller of two: of equals one, operands are ordered, and of two negatives it is the negative of the larger.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let (a, b) = (g.symbol(Symbol::Variable(0)), g.symbol(Symbol::Variable(1)));
    /// assert_eq!(g.min(a, a), a);
    /// assert_eq!(g.min(a, b), g.min(b, a));
    /// let (minus_a, minus_b, larger) = (g.neg(a), g.neg(b), g.max(a, b));
    /// assert_eq!(g.min(minus_a, minus_b), g.neg(larger));
    /// let (two, three) = (g.constant(2.0), g.constant(3.0));
    /// assert_eq!(g.min(three, two), two);
    /// ```
    pub fn min(&mut self, a: Node, b: Node) -> Node {
        match self.both_negated(a, b) {
            _ if a == b => a,
            Some([x, y]) => {
                let larger = self.max(x, y);
                self.neg(larger)
            }
            None => match self.value(a).zip(self.value(b)) {
                Some((x, y)) => self.constant(x.min(y)),
                None => self.intern(Op::Min(a.min(b), a.max(b))),
            },
        }
    }

    /// The larger of two, by the same rules.
    ///
    /// ```
    /// # use abbe_codegen::{expr::Symbol, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let (a, b) = (g.symbol(Symbol::Variable(0)), g.symbol(Symbol::Variable(1)));
    /// assert_eq!(g.max(a, a), a);
    /// assert_eq!(g.max(a, b), g.max(b, a));
    /// let (minus_a, minus_b, smaller) = (g.neg(a), g.neg(b), g.min(a, b));
    /// assert_eq!(g.max(minus_a, minus_b), g.neg(smaller));
    /// ```
    pub fn max(&mut self, a: Node, b: Node) -> Node {
        match self.both_negated(a, b) {
            _ if a == b => a,
            Some([x, y]) => {
                let smaller = self.min(x, y);
                self.neg(smaller)
            }
            None => match self.value(a).zip(self.value(b)) {
                Some((x, y)) => self.constant(x.max(y)),
                None => self.intern(Op::Max(a.min(b), a.max(b))),
            },
        }
    }

    /// `x` and `y` of two nodes that are `-x` and `-y` and no numbers.
    fn both_negated(&self, a: Node, b: Node) -> Option<[Node; 2]> {
        match (self.op(a), self.op(b)) {
            (Op::Neg(x), Op::Neg(y)) => Some([x, y]),
            _ => None,
        }
    }

    /// Absolute value: of a negative that of the positive, of itself itself.
    ///
    /// ```
    /// # use abbe_codegen::{expr::{Function, Symbol}, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let a = g.symbol(Symbol::Variable(0));
    /// let (minus_a, size) = (g.neg(a), g.call(Function::Abs, a));
    /// assert_eq!(g.call(Function::Abs, minus_a), size);
    /// assert_eq!(g.call(Function::Abs, size), size);
    /// ```
    fn abs(&mut self, a: Node) -> Node {
        match self.op(a) {
            Op::Neg(inner) => self.abs(inner),
            Op::Call(Function::Abs | Function::Exp | Function::Sqrt, _) => a,
            _ => self.called(Function::Abs, a),
        }
    }

    /// Sign: odd, and its own sign.
    ///
    /// ```
    /// # use abbe_codegen::{expr::{Function, Symbol}, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let a = g.symbol(Symbol::Variable(0));
    /// let (minus_a, sign) = (g.neg(a), g.call(Function::Sign, a));
    /// assert_eq!(g.call(Function::Sign, minus_a), g.neg(sign));
    /// assert_eq!(g.call(Function::Sign, sign), sign);
    /// ```
    fn sign(&mut self, a: Node) -> Node {
        match self.op(a) {
            Op::Neg(inner) => {
                let sign = self.sign(inner);
                self.neg(sign)
            }
            Op::Call(Function::Sign, _) => a,
            _ => self.called(Function::Sign, a),
        }
    }

    /// Logarithm: that of an exponential function is its argument.
    ///
    /// ```
    /// # use abbe_codegen::{expr::{Function, Symbol}, graph::Graph};
    /// # let mut g = Graph::new();
    /// # let a = g.symbol(Symbol::Variable(0));
    /// let power = g.call(Function::Exp, a);
    /// assert_eq!(g.call(Function::Log, power), a);
    /// let logarithm = g.call(Function::Log, a);
    /// assert_ne!(g.call(Function::Exp, logarithm), a); // a may be negative
    /// ```
    fn log(&mut self, a: Node) -> Node {
        match self.op(a) {
            Op::Call(Function::Exp, inner) => inner,
            _ => self.called(Function::Log, a),
        }
    }

    /// A table or a derivative of it: of a number a number, and 0 beyond the degree of its pieces.
    pub fn look_up(&mut self, lookup: Lookup, a: Node) -> Node {
        let table = self.tables()[usize::from(lookup.table)].clone();
        let (order, op) = (u32::from(lookup.order), Op::Lookup(lookup, a));
        match self.value(a) {
            _ if order > table.degree() => self.zero(),
            Some(x) => self.folded(table.derivative(order, x), op),
            None => self.intern(op),
        }
    }

    /// Any function of one operand, by its own rules.
    pub fn call(&mut self, function: Function, a: Node) -> Node {
        match function {
            Function::Sin => self.sin(a),
            Function::Cos => self.cos(a),
            Function::Abs => self.abs(a),
            Function::Sign => self.sign(a),
            Function::Log => self.log(a),
            _ => self.called(function, a),
        }
    }

    fn called(&mut self, function: Function, a: Node) -> Node {
        let op = Op::Call(function, a);
        match self.value(a) {
            Some(x) => self.folded(function.of(x), op),
            None => self.intern(op),
        }
    }

    /// A constant, unless the operation gave none that can be computed with.
    fn folded(&mut self, value: f64, op: Op) -> Node {
        if value.is_finite() { self.constant(value) } else { self.intern(op) }
    }

    /// `x` if a node is `-x`, counting negative numbers.
    fn negated(&mut self, a: Node) -> Option<Node> {
        match self.op(a) {
            Op::Neg(inner) => Some(inner),
            Op::Constant(bits) if f64::from_bits(bits) < 0.0 => Some(self.constant(-f64::from_bits(bits))),
            _ => None,
        }
    }

    /// An angle without its constant summand if that is a whole number of quarter turns, and that number mod 4.
    fn quarter_turns(&mut self, a: Node) -> (Node, u8) {
        let (rest, shift, sign) = match self.op(a) {
            Op::Constant(_) => (self.zero(), a, 1.0),
            Op::Add(x, y) if self.value(x).is_some() => (y, x, 1.0),
            Op::Add(x, y) => (x, y, 1.0),
            Op::Sub(x, y) if self.value(y).is_some() => (x, y, -1.0),
            Op::Sub(x, y) => (self.neg(y), x, 1.0),
            _ => return (a, 0),
        };
        let quarters = self.value(shift).and_then(|shift| {
            let quarters = (shift / FRAC_PI_2).round();
            let exact = quarters * FRAC_PI_2 == shift && quarters.abs() <= 64.0;
            exact.then_some((sign * quarters).rem_euclid(4.0) as u8)
        });
        quarters.map_or((a, 0), |quarters| (rest, quarters))
    }

    fn squares_of_sine_and_cosine(&self, a: Node, b: Node) -> bool {
        let square = |node| match self.op(node) {
            Op::Mul(x, y) if x == y => match self.op(x) {
                Op::Call(function, angle) => Some((function, angle)),
                _ => None,
            },
            _ => None,
        };
        matches!(
            (square(a), square(b)),
            (Some((Function::Sin, x)), Some((Function::Cos, y)))
            | (Some((Function::Cos, x)), Some((Function::Sin, y))) if x == y
        )
    }
}
