//! Builder of a routine: its arrays and its stages so far, and of a loop body, where the rows that
//! it reads become symbols of its own graph.

use abbe_core::function::Count;
use abbe_spec::Symbol;

use super::FrameLoops;
use crate::chain::Rows;
use crate::graph::{Frame, Graph, Node, Six, Vector};
use crate::program::{Array, ArrayRows, Block, Program, Repeated, Role, Row, Stage};

/// Dimensions of a pose.
pub(super) const POSE: [Count; 2] = [Count::Exactly(4), Count::Exactly(3)];

pub(super) struct RoutineBuilder<'d, 'm> {
    pub(super) loops: &'d FrameLoops<'m>,
    arrays: &'d mut Vec<Array>,
    pub(super) stages: Vec<Stage>,
}

impl<'d, 'm> RoutineBuilder<'d, 'm> {
    /// Creates a draft without stages of a routine with these arguments and results.
    pub(super) fn new(loops: &'d FrameLoops<'m>, arrays: &'d mut Vec<Array>) -> Self {
        Self { loops, arrays, stages: Vec::new() }
    }

    /// Returns the index of the argument or result with this name.
    pub(super) fn array(&self, name: &str) -> usize {
        self.arrays.iter().position(|array| array.name == name).expect("the signature has it")
    }

    /// Returns the index of the margin, if there is one.
    pub(super) fn margin(&self) -> Option<usize> {
        self.arrays.iter().position(|array| array.role == Role::Margin)
    }

    /// Adds a local array, initialized with zeros.
    pub(super) fn zeros(&mut self, name: &'static str, shape: &[Count]) -> usize {
        self.arrays.push(Array { name, shape: shape.to_vec(), role: Role::Zeros });
        self.arrays.len() - 1
    }

    pub(super) fn call(&mut self, routine: &'static str, arrays: &[usize]) {
        self.stages.push(Stage::Call { routine, arrays: arrays.to_vec() });
    }

    /// Copies rows of an array to another one.
    pub(super) fn copy(&mut self, from: usize, row: Row, to: usize) {
        self.stages.push(Stage::Copy { from: ArrayRows { array: from, row }, to });
    }

    pub(super) fn once(&mut self, body: Body) {
        self.stages.push(body.stage(None));
    }

    pub(super) fn each(&mut self, count: Count, body: Body) {
        self.stages.push(body.stage(Some(Repeated { count, backwards: false, while_positive: None })));
    }

    pub(super) fn backwards(&mut self, body: Body) {
        let repeated = Repeated { count: Count::Frames, backwards: true, while_positive: None };
        self.stages.push(body.stage(Some(repeated)));
    }

    /// Returns the axis of the tool about which the last of the Euler angles turns.
    pub(super) fn last_axis(&self) -> usize {
        self.loops.orientation.last_axis().unwrap_or(0)
    }

    /// Computes the margin, if there is one, from the [last axis](Self::last_axis) of the tool, for
    /// functions that compute no rows 4–6.
    pub(super) fn margin_alone(&mut self, axis: impl FnOnce(&mut Body) -> Vector) {
        let Some(margin) = self.margin() else { return };
        let mut body = Body::default();
        let axis = axis(&mut body);
        let rows = Rows::new(&mut body.graph, self.loops.orientation, axis);
        body.write(margin, Row::All, &rows.margin().into_iter().collect::<Vec<_>>());
        self.once(body);
    }

    /// Computes the coefficients of rows 4–6 and the margin from the [last axis](Self::last_axis)
    /// of the tool.
    pub(super) fn rows(&mut self, axis: impl FnOnce(&mut Body) -> Vector) -> RowsArray {
        let Some(last) = self.loops.orientation.last_axis() else { return RowsArray::ROTATION_VECTOR };
        let euler = self.zeros("euler", &[Count::Exactly(Rows::PARTS)]);
        let mut body = Body::default();
        let axis = axis(&mut body);
        let rows = Rows::new(&mut body.graph, self.loops.orientation, axis);
        body.write(euler, Row::All, &rows.parts());
        if let (Some(margin), Some(node)) = (self.margin(), rows.margin()) {
            body.write(margin, Row::All, &[node]);
        }
        self.once(body);
        RowsArray(Some((last, euler)))
    }
}

/// Last axis, and the array that holds the coefficients of rows 4–6; a rotation vector needs none.
pub(super) struct RowsArray(Option<(usize, usize)>);

impl RowsArray {
    /// Coefficients of a rotation vector.
    pub(super) const ROTATION_VECTOR: Self = Self(None);

    pub(super) fn read(&self, body: &mut Body) -> Rows {
        match self.0 {
            None => Rows::RotationVector,
            Some((last, array)) => Rows::from_parts(last, &body.read(array, Row::All, Rows::PARTS)),
        }
    }
}

#[derive(Default)]
pub(super) struct Body {
    pub(super) graph: Graph,
    reads: Vec<ArrayRows>,
    numbers: usize,
    writes: Vec<ArrayRows>,
    outputs: Vec<Node>,
}

impl Body {
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

    pub(super) fn six(&mut self, array: usize, row: Row) -> Six {
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
