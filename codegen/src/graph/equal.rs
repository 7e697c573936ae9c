//! Equalities between nodes with different operations. A program computes the cheapest member of a
//! class.

use super::{Graph, Node, Op, Signed, Vector, arena::Classes};

impl Graph {
    /// States that two nodes are equal for all values of the symbols.
    ///
    /// ```
    /// # use abbe_spec::expr::Symbol;
    /// # use abbe_codegen::graph::Graph;
    /// # use abbe_codegen::program::Program;
    /// # let mut g = Graph::new();
    /// # let [a, b, c] = [0, 1, 2].map(|i| g.symbol(Symbol::Variable(i)));
    /// let (ab, ac, sum) = (g.mul(a, b), g.mul(a, c), g.add(b, c));
    /// let (long, short) = (g.add(ab, ac), g.mul(a, sum));
    /// assert_eq!(Program::new(&g, &[long]).operations().mul, 2);
    /// g.equate(long, short);
    /// assert_eq!(Program::new(&g, &[long]).operations().mul, 1);
    /// ```
    pub fn equate(&mut self, a: Node, b: Node) {
        let (a, b) = (self.class(a), self.class(b));
        // The oldest node represents the class, so that no node precedes the representatives of its
        // operands.
        let (a, b) = if a.node < b.node { (a, b) } else { (b, a) };
        if a.node == b.node {
            return;
        }
        let negative = a.negative != b.negative;
        self.classes.first.resize(self.len(), None);
        let members = self.classes.all.swap_remove(&b.node).unwrap_or_else(|| vec![Signed::plain(b.node)]);
        let all = self.classes.all.entry(a.node).or_insert_with(|| vec![Signed::plain(a.node)]);
        self.classes.first[a.node.index()] = Some(Signed::plain(a.node));
        for member in members {
            let member = member.times(negative);
            all.push(member);
            self.classes.first[member.node.index()] = Some(Signed { node: a.node, ..member });
        }
    }

    /// States that two vectors are equal.
    pub(crate) fn equate_vectors(&mut self, a: Vector, b: Vector) {
        for (a, b) in a.into_iter().zip(b) {
            self.equate(a, b);
        }
    }

    /// Proposes nodes, each equal to others, that may save operations together though none of them
    /// does alone. Operands come before their users.
    pub(crate) fn propose_together(&mut self, nodes: Vec<Node>) {
        self.classes.together.push(nodes);
    }

    /// Returns the proposed groups of nodes.
    pub(crate) fn together(&self) -> &[Vec<Node>] {
        &self.classes.together
    }

    /// Returns the representative of a node's class, with the node's sign.
    pub fn class(&self, node: Node) -> Signed {
        let node = match self.op(node) {
            Op::Neg(a) => Signed { node: a, negative: true },
            _ => Signed::plain(node),
        };
        self.first(node.node).map_or(node, |first| first.times(node.negative))
    }

    /// Returns all members of the class of a representative, itself first.
    pub fn equal(&self, first: Node) -> impl Iterator<Item = Signed> {
        let all = self.first(first).and_then(|first| self.classes.all.get(&first.node));
        let others = all.map_or(&[][..], |all| &all[1..]);
        std::iter::once(Signed::plain(first)).chain(others.iter().copied())
    }

    fn first(&self, node: Node) -> Option<Signed> {
        self.classes.first.get(node.index()).copied().flatten()
    }

    /// Removes all equalities, for comparison with a program without alternatives.
    pub fn forget_equal(&mut self) {
        self.classes = Classes::default();
    }

    /// Returns the representatives of all classes with more than one member.
    pub fn classes(&self) -> impl Iterator<Item = Node> {
        self.classes.all.keys().copied()
    }
}
