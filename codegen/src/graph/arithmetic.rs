//! Constructors of constants, sums, products and powers, with their simplifications. All of them
//! are exact.
//!
//! Signs move outwards until a sum absorbs them, so that a term and its negative share one node.

use abbe_spec::{Function, Symbol};

use super::{Graph, Node, Op};

/// Largest integer exponent that is expanded to multiplications.
const LARGEST_WRITTEN_POWER: f64 = 16.0;

impl Graph {
    /// Returns a constant; −0 becomes 0.
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

    /// Returns the constant 0.
    pub fn zero(&mut self) -> Node {
        self.constant(0.0)
    }

    /// Returns a variable, parameter, input or generalized error.
    pub fn symbol(&mut self, symbol: Symbol) -> Node {
        self.intern(Op::Symbol(symbol))
    }

    /// Returns `-a`. A double negation cancels, and `-(a - b)` becomes `b - a` if that node exists.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
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

    /// Returns `a + b`. Zeros vanish, operands are sorted, signs become differences, and `sin² +
    /// cos² = 1`.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
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

    /// Returns `a - b`. Zeros vanish, equal operands cancel, and if `b - a` exists the result is
    /// its negative.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
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

    /// Returns `a · b`. Factors 0, 1 and −1 vanish, operands are sorted, signs move outwards.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
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
        self.with_signs_outside(a, b, Self::mul).unwrap_or_else(|| self.intern(Op::Mul(a.min(b), a.max(b))))
    }

    /// Returns `sum + a · b`.
    pub(crate) fn add_product(&mut self, sum: Node, a: Node, b: Node) -> Node {
        let product = self.mul(a, b);
        self.add(sum, product)
    }

    /// Returns `difference - a · b`.
    pub(crate) fn sub_product(&mut self, difference: Node, a: Node, b: Node) -> Node {
        let product = self.mul(a, b);
        self.sub(difference, product)
    }

    /// Returns `a / b`. `0/b` and `a/1` simplify, signs move outwards. A division by a constant 0
    /// is kept, because it has no value.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
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
        self.with_signs_outside(a, b, Self::div).unwrap_or_else(|| self.intern(Op::Div(a, b)))
    }

    /// Returns a product or quotient with the signs of its operands moved outwards; `None` without
    /// signs.
    fn with_signs_outside(
        &mut self,
        a: Node,
        b: Node,
        operation: fn(&mut Self, Node, Node) -> Node,
    ) -> Option<Node> {
        let (x, y) = (self.negated(a), self.negated(b));
        if x.is_none() && y.is_none() {
            return None;
        }
        let value = operation(self, x.unwrap_or(a), y.unwrap_or(b));
        Some(if x.is_some() && y.is_some() { value } else { self.neg(value) })
    }

    /// Returns `base ^ exponent`. Integer exponents become products, half-integers square roots.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
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

    /// Returns `x` if the node is `-x` or a negative constant.
    pub(super) fn negated(&mut self, a: Node) -> Option<Node> {
        match self.op(a) {
            Op::Neg(inner) => Some(inner),
            Op::Constant(bits) if f64::from_bits(bits) < 0.0 => Some(self.constant(-f64::from_bits(bits))),
            _ => None,
        }
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
