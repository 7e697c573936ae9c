//! Nodes and their operations.

use abbe_spec::expr::{Function, Lookup, Symbol};

/// Handle to a node of a [`Graph`](super::Graph). Operands have smaller indices than the nodes that
/// use them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Node(pub(super) u32);

impl Node {
    /// Returns the index of the node in the graph, from 0.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Operation of a node. Constants are held as bits, so that equal constants are one node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A constant.
    Constant(u64),
    /// A variable, parameter, input or generalized error.
    Symbol(Symbol),
    /// A negation.
    Neg(Node),
    /// A sum.
    Add(Node, Node),
    /// A difference.
    Sub(Node, Node),
    /// A product.
    Mul(Node, Node),
    /// A quotient.
    Div(Node, Node),
    /// A power with a constant exponent that is not an integer.
    Pow(Node, Node),
    /// The angle of the point (x, y); the operands are y, x.
    Atan2(Node, Node),
    /// The smaller operand.
    Min(Node, Node),
    /// The larger operand.
    Max(Node, Node),
    /// A function of one operand.
    Call(Function, Node),
    /// A table lookup.
    Lookup(Lookup, Node),
}

impl Op {
    /// Returns the operands: none, one or two.
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
mod tests;
