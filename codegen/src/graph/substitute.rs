//! Substitutes nodes for symbols, or values: that is for checks, not for speed.

use abbe_spec::expr::{Binary, Symbol};

use super::{Graph, Node, Op};

impl Graph {
    /// Returns `nodes` with each symbol replaced by the node that `other` gives for it, if any.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
    /// # let mut g = Graph::new();
    /// let (x, two) = (g.symbol(Symbol::Variable(0)), g.constant(2.0));
    /// let (sine, twice) = (g.sin(x), g.mul(two, x));
    /// assert_eq!(g.substitute(&[sine], |_| Some(twice)), [g.sin(twice)]);
    /// ```
    pub fn substitute(&mut self, nodes: &[Node], other: impl Fn(Symbol) -> Option<Node>) -> Vec<Node> {
        // Indexed by node. Operands have smaller indices, so that ascending order evaluates them
        // first.
        let mut made: Vec<Node> = self.nodes().collect();
        for node in self.reached_from(nodes) {
            let of = |operand: Node| made[operand.index()];
            made[node.index()] = match self.op(node) {
                Op::Symbol(symbol) => other(symbol).unwrap_or(node),
                op if op.operands().all(|operand| of(operand) == operand) => node,
                op => self.with_operands(op, of),
            };
        }
        nodes.iter().map(|node| made[node.index()]).collect()
    }

    /// Adds nodes of another graph with the same tables.
    pub(crate) fn adopt(&mut self, other: &Self, nodes: &[Node]) -> Vec<Node> {
        let mut made: Vec<Node> = other.nodes().collect();
        for node in other.reached_from(nodes) {
            let of = |operand: Node| made[operand.index()];
            made[node.index()] = self.with_operands(other.op(node), of);
        }
        nodes.iter().map(|node| made[node.index()]).collect()
    }

    /// Returns an operation with other operands.
    fn with_operands(&mut self, op: Op, of: impl Fn(Node) -> Node) -> Node {
        match op {
            Op::Constant(bits) => self.constant(f64::from_bits(bits)),
            Op::Symbol(symbol) => self.symbol(symbol),
            Op::Neg(a) => self.neg(of(a)),
            Op::Add(a, b) => self.add(of(a), of(b)),
            Op::Sub(a, b) => self.sub(of(a), of(b)),
            Op::Mul(a, b) => self.mul(of(a), of(b)),
            Op::Div(a, b) => self.div(of(a), of(b)),
            // Exponents are constants.
            Op::Pow(a, b) => {
                let exponent = self.value(of(b)).unwrap_or(f64::NAN);
                self.power(of(a), exponent)
            }
            Op::Atan2(a, b) => self.atan2(of(a), of(b)),
            Op::Min(a, b) => self.min(of(a), of(b)),
            Op::Max(a, b) => self.max(of(a), of(b)),
            Op::Call(function, a) => self.call(function, of(a)),
            Op::Lookup(lookup, a) => self.look_up(lookup, of(a)),
        }
    }

    /// Returns the values of `nodes`.
    pub fn evaluate(&self, nodes: &[Node], symbol: impl Fn(Symbol) -> f64) -> Vec<f64> {
        let count = nodes.iter().map(|node| node.index() + 1).max().unwrap_or(0);
        let mut values: Vec<f64> = Vec::with_capacity(count);
        self.extend_values(&mut values, count, symbol);
        nodes.iter().map(|node| values[node.index()]).collect()
    }

    /// Appends the values of further nodes to those of the first ones, up to `count` of them.
    pub(crate) fn extend_values(&self, values: &mut Vec<f64>, count: usize, symbol: impl Fn(Symbol) -> f64) {
        for index in values.len()..count {
            let of = |node: Node| values[node.index()];
            values.push(match self.op(Node(index as u32)) {
                Op::Constant(bits) => f64::from_bits(bits),
                Op::Symbol(s) => symbol(s),
                Op::Neg(a) => -of(a),
                Op::Add(a, b) => of(a) + of(b),
                Op::Sub(a, b) => of(a) - of(b),
                Op::Mul(a, b) => of(a) * of(b),
                Op::Div(a, b) => of(a) / of(b),
                Op::Pow(a, b) => of(a).powf(of(b)),
                Op::Atan2(a, b) => of(a).atan2(of(b)),
                Op::Min(a, b) => Binary::Min.evaluate(of(a), of(b)),
                Op::Max(a, b) => Binary::Max.evaluate(of(a), of(b)),
                Op::Call(function, a) => function.evaluate(of(a)),
                Op::Lookup(lookup, a) => {
                    self.tables()[usize::from(lookup.table)].derivative(u32::from(lookup.order), of(a))
                }
            });
        }
    }
}
