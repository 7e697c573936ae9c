//! Equivalence classes of nodes that have been stated to be equal.

use indexmap::IndexMap;
use rustc_hash::FxBuildHasher;

use super::node::Node;

/// A node or its negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signed {
    /// The node; never a negation.
    pub node: Node,
    /// `true` for the negative of the node.
    pub negative: bool,
}

/// Equivalence classes of nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Classes {
    /// Representative of each node's class, by node index; `None` for a node without equals.
    pub(super) first: Vec<Option<Signed>>,
    /// Members of each class by its representative, which is the first member.
    pub(super) all: IndexMap<Node, Vec<Signed>, FxBuildHasher>,
    /// Groups of nodes that may save operations together though none of them does alone.
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
