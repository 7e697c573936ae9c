//! Constructors of functions and tables, with their simplifications. All of them are exact.

use std::f64::consts::FRAC_PI_2;

use abbe_spec::{Function, Lookup};

use super::{Graph, Node, Op};

impl Graph {
    /// Returns the sine: odd, and exact at (and shifted by) multiples of π/2.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
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
        self.sine_of_sum(a, 0)
    }

    /// Returns the cosine: even, and exact at (and shifted by) multiples of π/2.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
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
        self.sine_of_sum(a, 1)
    }

    /// Returns the sine of an angle that is no negative, plus quarter turns.
    fn sine_of_sum(&mut self, a: Node, quarters: u8) -> Node {
        let (angle, own) = self.quarter_turns(a);
        let quarters = (quarters + own) % 4;
        let value = match quarters % 2 {
            0 if angle == a => self.called(Function::Sin, a),
            0 => self.sin(angle),
            _ if angle == a => self.called(Function::Cos, a),
            _ => self.cos(angle),
        };
        if quarters < 2 { value } else { self.neg(value) }
    }

    /// Returns the square root.
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

    /// Returns the angle of the point `(x, y)`.
    pub fn atan2(&mut self, y: Node, x: Node) -> Node {
        match (self.value(y), self.value(x)) {
            (Some(a), Some(b)) => self.folded(a.atan2(b), Op::Atan2(y, x)),
            _ => self.intern(Op::Atan2(y, x)),
        }
    }

    /// Returns the smaller of two nodes. Equal operands give one of them, operands are sorted, and
    /// `min(-x, -y)` becomes `-max(x, y)`.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
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
        self.extreme(Op::Min(a.min(b), a.max(b)), Self::max)
    }

    /// Returns the larger of two nodes, simplified by the same rules as `min`.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
    /// # let mut g = Graph::new();
    /// # let (a, b) = (g.symbol(Symbol::Variable(0)), g.symbol(Symbol::Variable(1)));
    /// assert_eq!(g.max(a, a), a);
    /// assert_eq!(g.max(a, b), g.max(b, a));
    /// let (minus_a, minus_b, smaller) = (g.neg(a), g.neg(b), g.min(a, b));
    /// assert_eq!(g.max(minus_a, minus_b), g.neg(smaller));
    /// ```
    pub fn max(&mut self, a: Node, b: Node) -> Node {
        self.extreme(Op::Max(a.min(b), a.max(b)), Self::min)
    }

    /// Returns the smaller or larger of the operands; `opposite` is the other operation.
    fn extreme(&mut self, op: Op, opposite: fn(&mut Self, Node, Node) -> Node) -> Node {
        let (Op::Min(a, b) | Op::Max(a, b)) = op else { unreachable!("it is one of these") };
        match (self.op(a), self.op(b)) {
            _ if a == b => a,
            (Op::Neg(x), Op::Neg(y)) => {
                let value = opposite(self, x, y);
                self.neg(value)
            }
            (Op::Constant(x), Op::Constant(y)) => {
                let [x, y] = [x, y].map(f64::from_bits);
                self.constant(if matches!(op, Op::Min(..)) { x.min(y) } else { x.max(y) })
            }
            _ => self.intern(op),
        }
    }

    /// Returns the absolute value: signs of the operand vanish, and it is idempotent.
    ///
    /// ```
    /// # use abbe_spec::expr::{Function, Symbol};
    /// # use abbe_codegen::graph::Graph;
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

    /// Returns the sign: odd and idempotent.
    ///
    /// ```
    /// # use abbe_spec::expr::{Function, Symbol};
    /// # use abbe_codegen::graph::Graph;
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

    /// Returns the logarithm, the inverse of an exponential function.
    ///
    /// ```
    /// # use abbe_spec::expr::{Function, Symbol};
    /// # use abbe_codegen::graph::Graph;
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

    /// Returns a table lookup or one of its derivatives. A constant operand gives a constant;
    /// derivatives beyond the table's degree are 0.
    pub fn look_up(&mut self, lookup: Lookup, a: Node) -> Node {
        let table = self.tables()[usize::from(lookup.table)].clone();
        let (order, op) = (u32::from(lookup.order), Op::Lookup(lookup, a));
        match self.value(a) {
            _ if order > table.degree() => self.zero(),
            Some(x) => self.folded(table.derivative(order, x), op),
            None => self.intern(op),
        }
    }

    /// Returns any function of one operand, simplified by its own rules.
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
            Some(x) => self.folded(function.evaluate(x), op),
            None => self.intern(op),
        }
    }

    /// Returns a constant if the value is finite, and the unevaluated operation otherwise.
    pub(super) fn folded(&mut self, value: f64, op: Op) -> Node {
        if value.is_finite() { self.constant(value) } else { self.intern(op) }
    }

    /// Splits a constant summand that is an integer number of quarter turns off an angle. Returns
    /// the rest and that number mod 4.
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
}
