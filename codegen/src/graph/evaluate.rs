//! Evaluates nodes at given values of the symbols: for checks, not for speed.

use abbe_spec::expr::{Binary, Symbol};

use super::{Graph, Node, Op};

impl Graph {
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
