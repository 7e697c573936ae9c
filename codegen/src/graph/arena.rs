//! The arena of nodes.

use std::sync::Arc;

use abbe_spec::expr::{Symbol, Table};
use indexmap::{IndexMap, IndexSet};

use super::classes::Classes;
use super::hash::Build;
use super::node::{Node, Op};

/// An arena of nodes in which equal operations on equal operands are one node.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    ops: IndexSet<Op, Build>,
    names: IndexMap<Node, String, Build>,
    numbers: IndexMap<u64, String, Build>,
    tables: Vec<Arc<Table>>,
    pub(super) classes: Classes,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// An empty graph whose nodes may be values of these tables.
    pub fn with_tables(tables: &[Arc<Table>]) -> Self {
        Self { tables: tables.to_vec(), ..Self::default() }
    }

    /// The tables that nodes are values of.
    pub fn tables(&self) -> &[Arc<Table>] {
        &self.tables
    }

    /// What a node does.
    pub fn op(&self, node: Node) -> Op {
        self.ops[node.index()]
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }

    /// All operations, each after its operands.
    pub fn ops(&self) -> impl Iterator<Item = Op> {
        self.ops.iter().copied()
    }

    /// All nodes, each after its operands.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = Node> + use<> {
        (0..self.ops.len() as u32).map(Node)
    }

    /// The name that generated code should give the node at a place in the graph.
    pub fn name_at(&self, index: usize) -> Option<&str> {
        self.names.get(&Node(index as u32)).map(String::as_str)
    }

    /// Proposes a name for a node; the first proposal stays, and numbers and symbols keep their own.
    pub fn propose(&mut self, node: Node, name: impl FnOnce() -> String) {
        if !matches!(self.op(node), Op::Constant(_) | Op::Symbol(_)) {
            self.names.entry(node).or_insert_with(name);
        }
    }

    /// Proposes a name for a number where it recurs; one that is several lengths has the names of all, as in `a2_z4`, and
    /// 0, 1 and −1 need none.
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

    /// The name that generated code should give a number.
    pub fn name_of_number(&self, value: f64) -> Option<&str> {
        self.numbers.get(&value.to_bits()).map(String::as_str)
    }

    /// The value of a constant node.
    pub fn value(&self, node: Node) -> Option<f64> {
        match self.op(node) {
            Op::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// The node of an operation as it is, without simplification.
    pub(super) fn intern(&mut self, op: Op) -> Node {
        Node(u32::try_from(self.ops.insert_full(op).0).expect("a graph holds fewer than 2³² nodes"))
    }

    /// The node of an operation if there is one already.
    pub(crate) fn find(&self, op: Op) -> Option<Node> {
        self.ops.get_index_of(&op).map(|index| Node(index as u32))
    }

    /// For every node up to `last`, whether it depends on one of the symbols that `chosen` picks.
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
