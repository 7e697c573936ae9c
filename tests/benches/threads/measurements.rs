//! 100,000 configurations of a UR5 with three targets on its tool.

use abbe::analysis::sampling::{arm_length, joint_sample, nominal_parameters};
use abbe::identify::{Measurement, Model, Observation, Uncertainty};
use abbe_manipulators::ur5::Ur5;

/// Number of rows.
pub(crate) const ROWS: usize = 100_000;

/// Positions of the targets, in mm.
const TARGETS: [[f64; 3]; 3] = [[40.0, 0.0, 20.0], [-30.0, 35.0, 25.0], [-20.0, -45.0, 60.0]];

/// Returns the ideal machine, measured by an instrument with an uncertainty of 0.02 mm.
pub(crate) fn ideal() -> Model<'static> {
    Model::ideal(&Ur5, TARGETS.to_vec(), Uncertainty { length: 0.02, angle: 1.0 })
}

/// Returns rows over the ranges of the joints, without measured values.
pub(crate) fn asked(model: &Model) -> Vec<Observation> {
    let description = model.manipulator.description();
    let arm = arm_length(model.manipulator, &nominal_parameters(description)).expect("an arm");
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    let row = |i: usize| {
        let q = joint_sample(description, arm, &moved, i);
        let seen = Measurement::Points(vec![Some([0.0; 3]); TARGETS.len()].into());
        Observation::new(i as u64 + 1, q, Vec::new(), seen)
    };
    (0..ROWS).map(row).collect()
}
