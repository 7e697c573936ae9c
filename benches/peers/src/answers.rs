//! Inputs of the benchmark, and reference results.

use std::f64::consts::FRAC_PI_2;

use abbe::analysis::sampling::halton;
use abbe::{Manipulator, Orientation, Pose, Variable, VariableKind, deviation, real_pose};
use abbe_tests::frame_loop::{self, Frame};

use crate::row::{Inputs, Kind, Output, Row};

/// Number of configurations.
pub const COUNT: usize = 1024;

/// Step of central differences.
const STEP: f64 = 1e-4;

/// Range of the configurations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Angles {
    /// Within ±90°, where the system's sine and cosine, and so the peers, are fastest.
    Quarter,
    /// Within the limits of the variables.
    Limits,
}

impl Angles {
    fn range(self, variable: &Variable) -> [f64; 2] {
        match (self, variable.kind) {
            (Self::Quarter, VariableKind::Revolute) => [-FRAC_PI_2, FRAC_PI_2],
            _ => variable.limits,
        }
    }
}

/// Configurations of a robot, with its poses and error Jacobians from the loop over frames.
pub struct Answers {
    pub inputs: Inputs,
    /// Largest difference of the loop from central differences of the exact chain, whose own error
    /// is about 1e-8.
    pub differences: f64,
    poses: Vec<[[f64; 3]; 4]>,
    columns: Vec<Vec<[f64; 6]>>,
}

impl Answers {
    pub fn new(robot: &dyn Manipulator, angles: Angles) -> Self {
        let description = robot.description();
        let (variables, frames) = (description.variables.len(), description.frames.len());
        let mut answers = Self {
            inputs: Inputs { variables, frames, q: Vec::new(), errors: Vec::new(), variances: Vec::new() },
            differences: 0.0,
            poses: Vec::new(),
            columns: Vec::new(),
        };
        for index in 0..COUNT {
            let ranges = description.variables.iter().map(|variable| angles.range(variable));
            let q: Vec<f64> =
                ranges.enumerate().map(|(k, [from, to])| from + (to - from) * halton(index + 1, k)).collect();
            let mut transforms = vec![Pose::IDENTITY; frames + 1];
            robot.transforms(&q, &[], &mut transforms).expect("finite");
            let plain: Vec<_> = transforms.iter().map(|transform| transform.0).collect();
            let mut columns = vec![[0.0; 6]; 6 * frames];
            let pose =
                frame_loop::error_jacobian(&plain, &mut vec![Frame::default(); frames + 1], &mut columns);
            for (column, values) in columns.iter().enumerate() {
                for (value, difference) in values.iter().zip(central_difference(&transforms, column)) {
                    answers.differences = answers.differences.max((value - difference).abs());
                }
            }
            answers.poses.push(pose);
            answers.columns.push(columns);
            answers.inputs.q.extend(q);
            answers.inputs.errors.extend((0..6 * frames).map(|k| 2e-3 * (halton(index + 1, k) - 0.5)));
            answers.inputs.variances.extend((0..6 * frames).map(|k| halton(index + 1, k)));
        }
        answers
    }

    /// Returns the largest deviation of a row's results, in m and rad; for a batch also at every
    /// lane.
    pub fn deviation(&self, row: &mut Row) -> f64 {
        let mut largest = 0.0f64;
        for index in 0..COUNT {
            let mut output = Output::new();
            row.run.run(&self.inputs, index - index % 16..index + 1, &mut output);
            row.run.show(index, &mut output);
            let result = self.result(row.kind, index);
            let pose = self.poses[index].as_flattened();
            let pose = if row.kind.has_pose() { pose } else { &[] };
            let given = output.pose.iter().take(pose.len()).chain(&output.result);
            for (right, given) in pose.iter().chain(&result).zip(given) {
                // NaN marks values that were never written.
                let off = (right - given).abs();
                largest = if off.is_nan() { f64::INFINITY } else { largest.max(off) };
            }
        }
        largest
    }

    fn result(&self, kind: Kind, index: usize) -> Vec<f64> {
        let columns = &self.columns[index];
        match kind {
            Kind::Dense => columns.concat(),
            // The upper halves of all columns.
            Kind::Distinct => columns.iter().flat_map(|column| &column[..3]).copied().collect(),
            Kind::Displacement => (0..6)
                .map(|row| {
                    columns.iter().zip(self.inputs.errors(index)).map(|(column, e)| column[row] * e).sum()
                })
                .collect(),
            Kind::Covariance => (0..36)
                .map(|place| {
                    let (i, j) = (place % 6, place / 6);
                    let variances = self.inputs.variances(index);
                    columns.iter().zip(variances).map(|(column, v)| column[i] * v * column[j]).sum()
                })
                .collect(),
        }
    }
}

fn central_difference(transforms: &[Pose], column: usize) -> [f64; 6] {
    let moved = |step: f64| {
        let mut errors = vec![[0.0; 6]; transforms.len() - 1];
        errors[column / 6][column % 6] = step;
        real_pose(transforms, &errors)
    };
    deviation(Orientation::RotationVector, &moved(-STEP), &moved(STEP)).map(|change| change / (2.0 * STEP))
}
