//! The arena of nodes and their operations, and equivalence classes of nodes that have been stated
//! to be equal.

#[cfg(test)]
mod tests;

use std::sync::Arc;

use abbe_spec::{Function, Lookup, Symbol, Table};
use indexmap::{IndexMap, IndexSet};
use rustc_hash::FxBuildHasher;

/// An arena of nodes in which equal operations on equal operands are one node.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    ops: IndexSet<Op, FxBuildHasher>,
    names: IndexMap<Node, String, FxBuildHasher>,
    numbers: IndexMap<u64, String, FxBuildHasher>,
    tables: Vec<Arc<Table>>,
    pub(super) classes: Classes,
    /// `true` if the nodes are evaluated in single precision, which has other rounding errors.
    pub(crate) is_single: bool,
}

impl Graph {
    /// Creates an empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// Creates an empty graph whose lookup nodes refer to these tables.
    pub fn with_tables(tables: &[Arc<Table>]) -> Self {
        Self { tables: tables.to_vec(), ..Self::default() }
    }

    /// Returns the tables that lookup nodes refer to.
    pub fn tables(&self) -> &[Arc<Table>] {
        &self.tables
    }

    /// Returns the operation of a node.
    pub fn op(&self, node: Node) -> Op {
        self.ops[node.index()]
    }

    /// Returns the number of nodes.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Returns `true` if the graph has no nodes.
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }

    /// Iterates over all operations, each after its operands.
    pub fn ops(&self) -> impl Iterator<Item = Op> {
        self.ops.iter().copied()
    }

    /// Iterates over all nodes, each after its operands.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = Node> + use<> {
        (0..self.ops.len() as u32).map(Node)
    }

    /// Returns the name proposed for the node with this index.
    pub fn name_at(&self, index: usize) -> Option<&str> {
        self.names.get(&Node(index as u32)).map(String::as_str)
    }

    /// Proposes a name for a node. The first proposal wins; constants and symbols keep their own
    /// names.
    pub fn propose(&mut self, node: Node, name: impl FnOnce() -> String) {
        if !matches!(self.op(node), Op::Constant(_) | Op::Symbol(_)) {
            self.names.entry(node).or_insert_with(name);
        }
    }

    /// Proposes a name for a recurring number. A number with several names gets all of them, as in
    /// `a2_z4`; 0, 1 and −1 get none.
    pub fn propose_number(&mut self, value: f64, name: &str) {
        if value != 0.0 && value.abs() != 1.0 {
            let names = self.numbers.entry(value.to_bits()).or_default();
            if names.is_empty() {
                names.push_str(name);
            } else if names.split('_').all(|known| known != name) {
                *names += &format!("_{name}");
            }
        }
    }

    /// Returns the name proposed for a number.
    pub fn name_of_number(&self, value: f64) -> Option<&str> {
        self.numbers.get(&value.to_bits()).map(String::as_str)
    }

    /// Returns the value of a constant node.
    pub fn value(&self, node: Node) -> Option<f64> {
        match self.op(node) {
            Op::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// Returns the node of an operation, without simplifying it.
    pub(super) fn intern(&mut self, op: Op) -> Node {
        Node(u32::try_from(self.ops.insert_full(op).0).expect("a graph holds fewer than 2³² nodes"))
    }

    /// Returns the node of an operation if it exists already.
    pub(crate) fn find(&self, op: Op) -> Option<Node> {
        self.ops.get_index_of(&op).map(|index| Node(index as u32))
    }

    /// Returns, for every node up to `last`, whether it depends on a symbol that `chosen` accepts.
    pub fn depends(&self, last: Node, chosen: impl Fn(Symbol) -> bool) -> Vec<bool> {
        let mut depends: Vec<bool> = Vec::with_capacity(last.index() + 1);
        for op in self.ops.iter().take(last.index() + 1) {
            depends.push(match *op {
                Op::Symbol(symbol) => chosen(symbol),
                op => op.operands().any(|operand| depends[operand.index()]),
            });
        }
        depends
    }
}

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
