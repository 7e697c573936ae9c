//! Batches of configurations, in lanes.

use std::hint::black_box;
use std::ops::Range;

use abbe::Function;
use abbe::lanes::{Batches, InstructionSet, Tiles};

use crate::row::{Inputs, Kind, Output, Row, Run, Side};

/// Block size with which arguments and results stay in the L1 cache.
pub const FEW: usize = 16;

/// Largest number of configurations that the interpreter evaluates together.
pub const MANY: usize = 64;

/// Returns a row for every kind and every instruction set of this machine, for calls with `block`
/// configurations.
pub fn rows(name: &str, side: Side, robot: &'static dyn Batches, block: usize, inputs: &Inputs) -> Vec<Row> {
    InstructionSet::all()
        .flat_map(|set| Kind::ALL.map(|kind| (set, kind)))
        .map(|(set, kind)| Row {
            name: format!("{name}, {block} at once, {}", set.name()),
            side,
            kind,
            block,
            run: Box::new(Batch::new(robot, set, kind, block, inputs)),
        })
        .collect()
}

/// Arguments of all blocks, prepared in advance, and the results of one block.
struct Batch {
    robot: &'static dyn Batches,
    function: Function,
    has_pose: bool,
    size: usize,
    blocks: Vec<Tiles>,
    results: Tiles,
}

impl Batch {
    fn new(
        robot: &'static dyn Batches,
        set: InstructionSet,
        kind: Kind,
        size: usize,
        inputs: &Inputs,
    ) -> Self {
        let function = match kind {
            Kind::Dense => Function::ErrorJacobian,
            Kind::Distinct => Function::ErrorJacobianDistinct,
            Kind::Displacement => Function::Displacement,
            Kind::Covariance => Function::Covariance,
        };
        let description = robot.description();
        assert!(description.parameters.is_empty() && description.inputs.is_empty(), "q and what is given");
        let indices: Vec<usize> = (0..inputs.q.len() / inputs.variables).collect();
        let block = |indices: &[usize]| {
            let mut tiles = Tiles::new(set, function.signature().arguments_len(description), indices.len());
            for (configuration, index) in indices.iter().enumerate() {
                let values = inputs.q(*index).iter().chain(inputs.given(kind, *index));
                values.enumerate().for_each(|(row, value)| tiles.set_value(row, configuration, *value));
            }
            tiles.pad();
            tiles
        };
        let blocks = indices.chunks(size).map(block).collect();
        let mut results = Tiles::new(set, function.signature().results_len(description), size);
        (0..results.rows()).for_each(|row| results.fill_row(row, f64::NAN));
        Self { robot, function, has_pose: kind.has_pose(), size, blocks, results }
    }
}

impl Run for Batch {
    /// Evaluates the first block of the range repeatedly, once per block in it. Branch prediction
    /// and caching cannot distort the time: there are no branches on data.
    fn run(&mut self, _: &Inputs, range: Range<usize>, _: &mut Output) {
        let arguments = &self.blocks[range.start / self.size];
        for _ in 0..range.len().div_ceil(self.size) {
            self.robot
                .batch(self.function, black_box(arguments), &mut self.results)
                .expect("the right counts");
            black_box(&mut self.results);
        }
    }

    fn show(&self, index: usize, output: &mut Output) {
        let (rows, configuration) = (self.results.rows(), index % self.size);
        let pose = if self.has_pose { 12 } else { 0 };
        self.results.copy_rows(0..pose, configuration, &mut output.pose);
        self.results.copy_rows(pose..rows, configuration, &mut output.result);
    }
}
