//! Builder of a loop body. The rows that it reads become symbols of its own graph.

use abbe_spec::expr::Symbol;

use crate::graph::{Frame, Graph, Node, Vector};
use crate::program::{ArrayRows, Block, Program, Repeated, Row, Stage};

#[derive(Default)]
pub(super) struct Body {
    pub(super) graph: Graph,
    reads: Vec<ArrayRows>,
    numbers: usize,
    writes: Vec<ArrayRows>,
    outputs: Vec<Node>,
}

impl Body {
    pub(super) fn new() -> Self {
        Self::default()
    }

    /// Reads `count` numbers of a row.
    pub(super) fn read(&mut self, array: usize, row: Row, count: usize) -> Vec<Node> {
        self.reads.push(ArrayRows { array, row });
        let first = self.numbers;
        self.numbers += count;
        (first..self.numbers).map(|number| self.graph.symbol(Symbol::Local(number))).collect()
    }

    pub(super) fn vector(&mut self, array: usize, row: Row) -> Vector {
        let numbers = self.read(array, row, 3);
        [0, 1, 2].map(|i| numbers[i])
    }

    pub(super) fn six(&mut self, array: usize, row: Row) -> [Node; 6] {
        let numbers = self.read(array, row, 6);
        [0, 1, 2, 3, 4, 5].map(|i| numbers[i])
    }

    /// Reads velocity and rotation.
    pub(super) fn twist(&mut self, array: usize, row: Row) -> [Vector; 2] {
        let [a, b, c, d, e, f] = self.six(array, row);
        [[a, b, c], [d, e, f]]
    }

    pub(super) fn frame(&mut self, array: usize, row: Row) -> Frame {
        Frame::from_entries(&self.read(array, row, 12))
    }

    /// Writes nodes to a row.
    pub(super) fn write(&mut self, array: usize, row: Row, nodes: &[Node]) {
        self.writes.push(ArrayRows { array, row });
        self.outputs.extend(nodes);
    }

    pub(super) fn stage(self, repeated: Option<Repeated>) -> Stage {
        let Self { graph, reads, writes, outputs, .. } = self;
        Stage::Block(Block { reads, program: Program::new(&graph, &outputs), writes, repeated })
    }
}
