//! Which nodes are stated to be equal.

use indexmap::IndexMap;

use super::hash::Build;
use super::node::Node;

/// A node or its negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signed {
    /// The node, which is no change of sign.
    pub node: Node,
    /// Whether its negative is meant.
    pub negative: bool,
}

/// What is known to be equal.
#[derive(Clone, Debug, Default)]
pub(super) struct Classes {
    /// What stands for all that are equal to a node, by its place; of a node that is equal to no other one none.
    pub(super) first: Vec<Option<Signed>>,
    /// All that are equal to one that stands for them, itself the first.
    pub(super) all: IndexMap<Node, Vec<Signed>, Build>,
    /// Nodes that may pay together where none of them does alone.
    pub(super) together: Vec<Vec<Node>>,
}

impl Signed {
    pub(super) fn plain(node: Node) -> Self {
        Self { node, negative: false }
    }

    pub(super) fn times(self, negative: bool) -> Self {
        Self { negative: self.negative != negative, ..self }
    }
}
