//! Nodes, and what each does.

use abbe_spec::expr::{Function, Lookup, Symbol};

/// A handle to a node of a [`Graph`](super::Graph). Operands have smaller handles than the node that uses them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Node(pub(super) u32);

impl Node {
    /// Its place in the graph, from 0.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What a node does. Numbers are held as bits, so that equal ones are one node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A number.
    Constant(u64),
    /// A variable, parameter, input or generalized error.
    Symbol(Symbol),
    /// A change of sign.
    Neg(Node),
    /// A sum.
    Add(Node, Node),
    /// A difference.
    Sub(Node, Node),
    /// A product.
    Mul(Node, Node),
    /// A quotient.
    Div(Node, Node),
    /// A power whose exponent is a constant that is no whole number.
    Pow(Node, Node),
    /// The angle of the point (second, first).
    Atan2(Node, Node),
    /// The smaller.
    Min(Node, Node),
    /// The larger.
    Max(Node, Node),
    /// A function of one operand.
    Call(Function, Node),
    /// A table.
    Lookup(Lookup, Node),
}

impl Op {
    /// The operands, none, one or two.
    pub fn operands(self) -> impl Iterator<Item = Node> + Clone {
        let (first, second) = match self {
            Self::Constant(_) | Self::Symbol(_) => (None, None),
            Self::Neg(a) | Self::Call(_, a) | Self::Lookup(_, a) => (Some(a), None),
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Pow(a, b)
            | Self::Atan2(a, b)
            | Self::Min(a, b)
            | Self::Max(a, b) => (Some(a), Some(b)),
        };
        first.into_iter().chain(second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_operation_is_small() {
        assert_eq!(size_of::<Op>(), 16);
    }
}
