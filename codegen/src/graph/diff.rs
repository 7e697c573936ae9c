//! Derivatives of nodes by a symbol, by forward accumulation.

use abbe_spec::{Function, Lookup, Symbol};

use super::{Graph, Node, Op};

impl Graph {
    /// Returns `∂f/∂x`.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
    /// # let mut g = Graph::new();
    /// let x = g.symbol(Symbol::Variable(0));
    /// let sine = g.sin(x);
    /// assert_eq!(g.diff(sine, Symbol::Variable(0)), g.cos(x));
    /// ```
    pub fn diff(&mut self, f: Node, x: Symbol) -> Node {
        self.diff_all(&[f], x)[0]
    }

    /// Returns the derivatives of several nodes by one symbol, in one pass over their operands.
    pub fn diff_all(&mut self, nodes: &[Node], x: Symbol) -> Vec<Node> {
        let zero = self.zero();
        // Indexed by node. Operands have smaller indices, so that ascending order evaluates them
        // first.
        let mut derivatives: Vec<Option<Node>> =
            vec![None; nodes.iter().max().map_or(0, |last| last.index() + 1)];
        for node in self.reached_from(nodes) {
            let op = self.op(node);
            if op == Op::Symbol(x) || op.operands().any(|operand| derivatives[operand.index()].is_some()) {
                let of = |operand: Node| derivatives[operand.index()].unwrap_or(zero);
                derivatives[node.index()] = Some(self.derivative(node, of));
            }
        }
        nodes.iter().map(|node| derivatives[node.index()].unwrap_or(zero)).collect()
    }

    /// Returns the symbols that the nodes depend on.
    pub fn symbols(&self, nodes: &[Node]) -> Vec<Symbol> {
        let symbol = |node| match self.op(node) {
            Op::Symbol(symbol) => Some(symbol),
            _ => None,
        };
        self.reached_from(nodes).into_iter().filter_map(symbol).collect()
    }

    /// Returns `true` if a node may jump or have a kink along one of the chosen symbols. Its
    /// integrated derivative then differs from the node.
    pub(crate) fn may_have_kinks(&self, node: Node, chosen: impl Fn(Symbol) -> bool) -> bool {
        let depends = self.depends(node, chosen);
        self.reached_from(&[node]).into_iter().filter(|node| depends[node.index()]).any(|node| {
            let function = match self.op(node) {
                Op::Call(function, _) => function,
                op => return matches!(op, Op::Min(..) | Op::Max(..) | Op::Atan2(..) | Op::Lookup(..)),
            };
            matches!(function, Function::Abs | Function::Sign | Function::Side)
        })
    }

    /// Returns the number of nodes that `nodes` depend on, including themselves.
    pub(crate) fn size(&self, nodes: &[Node]) -> usize {
        self.reached_from(nodes).len()
    }

    /// Returns the nodes that `nodes` depend on, including themselves, in ascending order.
    pub(super) fn reached_from(&self, nodes: &[Node]) -> Vec<Node> {
        let mut reached = vec![false; nodes.iter().max().map_or(0, |last| last.index() + 1)];
        nodes.iter().for_each(|node| reached[node.index()] = true);
        // Operands have smaller indices, so that all users of a node have been visited before it.
        for index in (0..reached.len()).rev() {
            if reached[index] {
                self.op(Node(index as u32)).operands().for_each(|operand| reached[operand.index()] = true);
            }
        }
        self.nodes().zip(reached).filter_map(|(node, reached)| reached.then_some(node)).collect()
    }

    /// Returns the derivative of one node, given the derivatives of its operands.
    fn derivative(&mut self, node: Node, of: impl Fn(Node) -> Node) -> Node {
        match self.op(node) {
            Op::Constant(_) => self.zero(),
            // Only nodes that depend on x get here, so the symbol is x itself.
            Op::Symbol(_) => self.constant(1.0),
            // (-a)' = -a'
            Op::Neg(a) => self.neg(of(a)),
            // (a ± b)' = a' ± b'
            Op::Add(a, b) => self.add(of(a), of(b)),
            Op::Sub(a, b) => self.sub(of(a), of(b)),
            // (ab)' = a'b + ab'
            Op::Mul(a, b) => {
                let (left, right) = (self.mul(of(a), b), self.mul(a, of(b)));
                self.add(left, right)
            }
            // (a/b)' = (a' - (a/b) b') / b
            Op::Div(a, b) => {
                let above = self.sub_product(of(a), node, of(b));
                self.div(above, b)
            }
            // (aⁿ)' = n aⁿ⁻¹ a'; exponents are constants
            Op::Pow(a, n) => {
                let exponent = self.value(n).unwrap_or(f64::NAN);
                let lower = self.power(a, exponent - 1.0);
                let slope = self.mul(n, lower);
                self.mul(slope, of(a))
            }
            // atan2(y, x)' = (x y' - y x') / (x² + y²)
            Op::Atan2(y, x) => {
                let (first, second) = (self.mul(x, of(y)), self.mul(y, of(x)));
                let (xx, yy) = (self.mul(x, x), self.mul(y, y));
                let (above, below) = (self.sub(first, second), self.add(xx, yy));
                self.div(above, below)
            }
            // min(a, b)' = a' where a < b, else b'; max(a, b)' with a and b exchanged
            Op::Min(a, b) => self.derivative_of_smaller([a, b], of(a), of(b)),
            Op::Max(a, b) => self.derivative_of_smaller([b, a], of(a), of(b)),
            Op::Call(function, a) => {
                let slope = self.slope(function, a, node);
                self.mul(slope, of(a))
            }
            Op::Lookup(Lookup { table, order }, a) => {
                let slope = self.look_up(Lookup { table, order: order + 1 }, a);
                self.mul(slope, of(a))
            }
        }
    }

    /// Returns `x'` where `a < b`, else `y'`: `(x' + y' − side(a − b) (x' − y')) / 2`. Where a and
    /// b are equal, this is the one-sided derivative of one side.
    fn derivative_of_smaller(&mut self, [a, b]: [Node; 2], x: Node, y: Node) -> Node {
        let (sum, difference, distance) = (self.add(x, y), self.sub(x, y), self.sub(a, b));
        let side = self.call(Function::Side, distance);
        let twice = self.sub_product(sum, side, difference);
        let half = self.constant(0.5);
        self.mul(half, twice)
    }

    /// Returns `f'(a)`, where `value` is `f(a)`.
    fn slope(&mut self, function: Function, a: Node, value: Node) -> Node {
        let one = self.constant(1.0);
        match function {
            // sin' = cos
            Function::Sin => self.cos(a),
            // cos' = -sin
            Function::Cos => {
                let sine = self.sin(a);
                self.neg(sine)
            }
            // tan' = 1 + tan²
            Function::Tan => self.add_product(one, value, value),
            // asin' = 1/√(1 - a²), acos' = -asin'
            Function::Asin | Function::Acos => {
                let difference = self.sub_product(one, a, a);
                let root = self.sqrt(difference);
                let slope = self.div(one, root);
                if function == Function::Asin { slope } else { self.neg(slope) }
            }
            // atan' = 1/(1 + a²)
            Function::Atan => {
                let below = self.add_product(one, a, a);
                self.div(one, below)
            }
            // √' = 1/(2√)
            Function::Sqrt => {
                let two = self.constant(2.0);
                let below = self.mul(two, value);
                self.div(one, below)
            }
            // exp' = exp
            Function::Exp => value,
            // log' = 1/a
            Function::Log => self.div(one, a),
            // |a|' = sign a; at 0 the right-hand derivative, 1
            Function::Abs => self.call(Function::Side, a),
            // 0 on both sides of the jump
            Function::Sign | Function::Side => self.zero(),
        }
    }
}
