//! Solutions in part.

use super::Root;
use crate::graph::Node;

/// Joint of a solution.
#[derive(Clone, Copy, Debug)]
pub(super) enum Joint {
    Turn(Root),
    Slide(Node),
}

/// Some joints of a solution, which exists if nothing in `exists` is negative.
#[derive(Clone, Debug)]
pub(super) struct Partial {
    pub(super) joints: Vec<Joint>,
    pub(super) exists: Vec<Node>,
}

impl Partial {
    pub(super) fn new(roots: Vec<Root>) -> Self {
        Self { joints: roots.into_iter().map(Joint::Turn).collect(), exists: Vec::new() }
    }

    pub(super) fn with(mut self, roots: impl IntoIterator<Item = Root>) -> Self {
        self.joints.extend(roots.into_iter().map(Joint::Turn));
        self
    }
}
