//! Converts checked expressions to nodes.

use abbe_spec::expr::{Binary, Expression, Kind, Symbol};

use super::{Graph, Node};

/// Returns the symbol by which nodes read a symbol of a spec: programs read passive variables from
/// an array.
pub(crate) fn in_programs(symbol: Symbol) -> Symbol {
    match symbol {
        Symbol::Passive(i) => Symbol::Local(i),
        symbol => symbol,
    }
}

impl Graph {
    /// Returns the node of an expression.
    pub fn lower(&mut self, expression: &Expression) -> Node {
        self.lower_with(expression, &|graph, symbol| graph.symbol(in_programs(symbol)))
    }

    /// Returns the node of an expression in which `value` gives the node of each symbol.
    pub(crate) fn lower_with(
        &mut self,
        expression: &Expression,
        value: &dyn Fn(&mut Self, Symbol) -> Node,
    ) -> Node {
        let mut nodes: Vec<Node> = Vec::with_capacity(expression.terms().len());
        for term in expression.terms() {
            let node = match term.kind {
                Kind::Number(value) => self.constant(value),
                Kind::Symbol(symbol) => value(self, symbol),
                Kind::Neg(a) => self.neg(nodes[a]),
                Kind::Call(function, a) => self.call(function, nodes[a]),
                Kind::Lookup(lookup, a) => self.look_up(lookup, nodes[a]),
                Kind::Binary(operator, a, b) => {
                    let (a, b, exponent) = (nodes[a], nodes[b], expression.terms()[b].value);
                    match (operator, exponent) {
                        (Binary::Add, _) => self.add(a, b),
                        (Binary::Sub, _) => self.sub(a, b),
                        (Binary::Mul, _) => self.mul(a, b),
                        (Binary::Div, _) => self.div(a, b),
                        (Binary::Atan2, _) => self.atan2(a, b),
                        (Binary::Min, _) => self.min(a, b),
                        (Binary::Max, _) => self.max(a, b),
                        // The reader has checked that every exponent is constant.
                        (Binary::Pow, exponent) => self.power(a, exponent.unwrap_or(1.0)),
                    }
                }
            };
            nodes.push(node);
        }
        nodes[nodes.len() - 1]
    }
}
