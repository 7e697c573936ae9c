//! Laws that every correct [`Manipulator`](crate::Manipulator) obeys, as functions and as a test
//! macro.
//!
//! ```
//! struct Slide;
//! # use abbe::*;
//! # impl Manipulator for Slide {
//! #     fn description(&self) -> &Description {
//! #         static DESCRIPTION: Description = Description {
//! #             name: Text::Constant("slide"), title: Text::Constant(""), length: LengthUnit::Metre,
//! #             orientation: Orientation::RotationVector, frames: List::Constant(&[Frame::new("slide", Some(0))]),
//! #             variables: List::Constant(&[Variable::new("d", VariableKind::Prismatic, [0.0, 1.0], 0.5)]),
//! #             sum_limits: List::Constant(&[]),
//! #             parameters: List::Constant(&[]), inputs: List::Constant(&[]), sources: List::Constant(&[]),
//! #             effects: List::Constant(&[]), solutions: 0,
//! #         };
//! #         &DESCRIPTION
//! #     }
//! #     fn evaluate(&self, function: Function, arguments: &[&[f64]], results: &mut [&mut [f64]]) -> Result<(), Error> {
//! #         let [d] = *arguments[0] else { return Err(Error::Count { quantity: Quantity::Variables, expected: 1, found: arguments[0].len() }) };
//! #         if !d.is_finite() { return Err(Error::NotFinite { quantity: Quantity::Variables, index: 0 }) }
//! #         results[0].iter_mut().zip([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, d, 0.0, 0.0]).for_each(|(x, v)| *x = v);
//! #         if let (2, [_, columns]) = (arguments.len(), &mut *results) { columns.fill(0.0) }
//! #         match function {
//! #             Function::Transforms => results[0][12..].copy_from_slice(Pose::IDENTITY.0.as_flattened()),
//! #             Function::ErrorJacobian => for (column, row) in [0, 1, 2, 4, 5, 3].into_iter().enumerate() { results[1][6 * column + row] = 1.0 },
//! #             Function::JointJacobian => results[1][0] = 1.0,
//! #             Function::Pose | Function::ParameterJacobian | Function::Effects => {}
//! #             Function::GeneralizedErrors => results[0].fill(0.0),
//! #             other => return Err(Error::NoFunction(other)),
//! #         }
//! #         Ok(())
//! #     }
//! # }
//! // One line in your tests:
//! abbe::test_manipulator!(abbe::lanes::OneByOne(Slide));
//! # use abbe::laws;
//! # fn main() -> Result<(), laws::Failure> {
//! // Or ask for the figures:
//! assert!(laws::error_jacobian(&Slide, laws::SAMPLES)?.relative < laws::DERIVATIVE_TOLERANCE);
//! assert!((laws::remainder_slope(&Slide, laws::SAMPLES)?.slope - 2.0).abs() < laws::SLOPE_TOLERANCE);
//! laws::all(&abbe::lanes::OneByOne(Slide), laws::SAMPLES)
//! # }
//! ```

mod batches;
mod contract;
mod derivatives;
mod failure;
mod remainder;
mod samples;
#[cfg(test)]
mod tests;

pub use batches::{Batch, batches, evaluations, sweeps};
pub use contract::{contract, inverse, pose};
pub use derivatives::{error_jacobian, joint_jacobian, parameter_jacobian, source_displacements};
pub use failure::{Configuration, Discrepancy, Failure};
pub use remainder::{Slope, remainder_slope};

use crate::lanes::Sweepable;

use samples::{Sample, Subject};

/// Number of configurations that [`test_manipulator!`](crate::test_manipulator) samples.
pub const SAMPLES: usize = 200;
/// Largest accepted relative discrepancy between a Jacobian and central differences.
pub const DERIVATIVE_TOLERANCE: f64 = 1e-8;
/// Largest accepted relative discrepancy between two ways to compute the same values.
pub const ROUNDING_TOLERANCE: f64 = 1e-11;
/// Largest accepted distance of the slope of the first-order remainder from 2.
pub const SLOPE_TOLERANCE: f64 = 0.05;

/// Checks all laws, each to its tolerance. Batches are checked for the functions that sweeps need.
pub fn all(manipulator: &dyn Sweepable, samples: usize) -> Result<(), Failure> {
    contract(manipulator, samples)?.within("outputs", ROUNDING_TOLERANCE)?;
    sweeps(manipulator, samples)?.within("batches", ROUNDING_TOLERANCE)?;
    pose(manipulator, samples)?.within("pose", ROUNDING_TOLERANCE)?;
    error_jacobian(manipulator, samples)?.within("error Jacobian", DERIVATIVE_TOLERANCE)?;
    joint_jacobian(manipulator, samples)?.within("joint Jacobian", DERIVATIVE_TOLERANCE)?;
    parameter_jacobian(manipulator, samples)?.within("parameter Jacobian", DERIVATIVE_TOLERANCE)?;
    source_displacements(manipulator, samples)?.within("sources", DERIVATIVE_TOLERANCE)?;
    inverse(manipulator, samples)?.within("inverse", ROUNDING_TOLERANCE)?;
    remainder_slope(manipulator, samples)?.within(SLOPE_TOLERANCE)
}

/// Generates tests of all [`laws`](crate::laws) for one manipulator, at 200 configurations: joints
/// within their limits, inputs within their ranges, parameters within 5 % of their nominal values.
///
/// The tests compile all functions for lanes and compare them with single configurations. Wrap a
/// manipulator without code for lanes in [`OneByOne`](crate::lanes::OneByOne).
///
/// `test_manipulator!(EXPR)` generates a module `manipulator_laws` of tests.
/// `test_manipulator!(name: EXPR)` names the module, so that a crate can have several. The
/// expression may use everything in scope at the macro call.
#[macro_export]
macro_rules! test_manipulator {
    (@ $manipulator:expr; $($test:ident = $law:ident, $name:literal, $tolerance:ident;)+) => {$(
        #[test]
        fn $test() {
            let found = laws::$law(&$manipulator, laws::SAMPLES);
            let held = found.and_then(|found| found.within($name, laws::$tolerance));
            held.unwrap_or_else(|failure| panic!("{failure}"));
        }
    )+};
    ($name:ident: $manipulator:expr) => {
        #[cfg(test)]
        mod $name {
            #[allow(unused_imports)]
            use super::*;
            use $crate::laws;

            $crate::test_manipulator! { @ $manipulator;
                outputs_are_finite_and_bad_inputs_are_refused = contract, "outputs", ROUNDING_TOLERANCE;
                batches_say_what_single_configurations_say = batches, "batches", ROUNDING_TOLERANCE;
                pose_is_the_product_of_the_transforms = pose, "pose", ROUNDING_TOLERANCE;
                error_jacobian_is_the_derivative_of_the_exact_chain = error_jacobian, "error Jacobian", DERIVATIVE_TOLERANCE;
                joint_jacobian_is_the_derivative_of_the_pose = joint_jacobian, "joint Jacobian", DERIVATIVE_TOLERANCE;
                parameter_jacobian_is_the_derivative_of_the_pose = parameter_jacobian, "parameter Jacobian", DERIVATIVE_TOLERANCE;
                solutions_of_the_inverse_reach_their_poses = inverse, "inverse", ROUNDING_TOLERANCE;
                sources_are_the_derivatives_of_the_exact_chain = source_displacements, "sources", DERIVATIVE_TOLERANCE;
            }

            #[test]
            fn first_order_remainder_is_of_second_order() {
                let found = laws::remainder_slope(&$manipulator, laws::SAMPLES);
                let held = found.and_then(|found| found.within(laws::SLOPE_TOLERANCE));
                held.unwrap_or_else(|failure| panic!("{failure}"));
            }
        }
    };
    ($manipulator:expr) => {
        $crate::test_manipulator!(manipulator_laws: $manipulator);
    };
}
