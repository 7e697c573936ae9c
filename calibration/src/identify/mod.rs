//! Identification of generalized errors from measurements: section 6 of the paper, with the
//! algorithm that it omits.
//!
//! An [`Observation`] is a measurement at one configuration. A [`Model`] has the unknowns, the
//! residuals and their exact derivatives on the real chain, equation (6). [`identifiable()`] finds
//! the unknowns that the data determine and the equivalents of the others; [`groups()`] finds these
//! from the joint twists alone. [`fit()`] solves for the unknowns, [`cross_validate`] estimates the
//! error on unseen data, [`select()`] adds terms that reduce it, and [`fit_profiles()`] errors of
//! joints with up to 64 periods per turn. [`optimal`] chooses configurations to measure, and
//! [`simulate()`] measures a machine with known errors. [`INSTRUMENTS`] lists the instruments that
//! are read one number at a time; a [`Camera`] reads two for each corner of a board.
//!
//! ```
//! # use abbe::*;
//! use abbe::identify::{Failure, Measurement, Model, Observation, Options, Uncertainty, Unknown,
//! fit};
//! # struct Arm;
//! # impl Manipulator for Arm {
//! #     fn description(&self) -> &Description {
//! #         const LIMITS: [f64; 2] = [-3.0, 3.0];
//! #         static DESCRIPTION: Description = Description {
//! #             name: Text::Constant("arm"), title: Text::Constant(""), length: LengthUnit::Millimetre,
//! #             orientation: Orientation::RotationVector,
//! #             frames: List::Constant(&[Frame::new("upper arm", Some(0)), Frame::new("forearm", Some(1))]),
//! #             variables: List::Constant(&[
//! #                 Variable::new("q1", VariableKind::Revolute, LIMITS, 0.0),
//! #                 Variable::new("q2", VariableKind::Revolute, LIMITS, 0.0),
//! #             ]),
//! #             sum_limits: List::Constant(&[]),
//! #             parameters: List::Constant(&[]), inputs: List::Constant(&[]), sources: List::Constant(&[]),
//! #             effects: List::Constant(&[]), solutions: 0,
//! #         };
//! #         &DESCRIPTION
//! #     }
//! #     fn evaluate(&self, function: Function, arguments: &[&[f64]], results: &mut [&mut [f64]]) -> Result<(), Error> {
//! #         if function != Function::Transforms { return Ok(()) }
//! #         for (transform, (angle, length)) in results[0].chunks_mut(12).zip(arguments[0].iter().zip([450.0, 400.0])) {
//! #             let (s, c) = angle.sin_cos();
//! #             transform.copy_from_slice(&[c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0, length * c, length * s, 0.0]);
//! #         }
//! #         results[0][24..].copy_from_slice(Pose::IDENTITY.0.as_flattened());
//! #         Ok(())
//! #     }
//! # }
//! # fn main() -> Result<(), Failure> {
//! // A planar arm of 450 and 400 mm, and an instrument with 0.01 mm that measures its tool point.
//! let arm = Model::ideal(&Arm, vec![[0.0; 3]], Uncertainty { length: 0.01, angle: 1.0 });
//! let arm = arm.with(vec![Unknown::Error(0, Component::X), Unknown::Error(0, Component::Roll)]);
//! // The real upper arm is 0.3 mm too long, and the zero of the elbow is 1 mrad off.
//! let truth = [0.3, 1e-3];
//! let measure = |line: u64| {
//!     let q = vec![0.1 * line as f64, 1.5 - 0.15 * line as f64];
//!     let nothing = Measurement::Points(vec![None].into());
//!     let planned = Observation::new(line, q, Vec::new(), nothing);
//!     let point = arm.at(&truth).pose(&planned)?.position();
//!     Ok(Observation { measured: Measurement::Points(vec![Some(point)].into()), ..planned })
//! };
//! let data = (1..=20).map(measure).collect::<Result<Vec<_>, Failure>>()?;
//!
//! let found = fit(&arm, &data, &Options::default())?;
//! assert_eq!(found.identifiable.rank, 2);
//! assert!((found.x[0] - 0.3).abs() < 1e-6 && (found.x[1] - 1e-3).abs() < 1e-9);
//! # Ok(())
//! # }
//! ```

mod between_blocks;
mod between_stations;
mod board_pose;
mod clustered;
mod columns;
mod configurations;
mod derivatives;
mod design;
mod deviations;
mod drift;
mod evaluated_model;
mod failure;
mod figures;
mod fit;
mod folds;
mod groups;
mod hand_eye;
mod identifiable;
mod information;
mod instrument;
mod linearize;
mod model;
mod moved_place;
mod observation;
mod outliers;
mod prior;
mod profile;
mod registration;
mod residuals;
mod robust;
mod select;
mod simulate;
mod solver;
mod statistics;
mod tool_points;
mod triangle;
mod variance;

#[cfg(test)]
mod tests;

use failure::Result;
use fit::REJECTED;
use linearize::{by_blocks, linearize, push_distances, with_priors};
use solver::{Residuals, Solver};
use triangle::{Problem, Triangle};

pub use between_blocks::{BetweenBlocks, between_blocks};
pub use between_stations::{BetweenStations, between_stations};
pub use board_pose::BoardView;
pub use clustered::Independent;
pub use configurations::Configurations;
pub use design::{Design, Objective, optimal, whole};
pub use drift::{Drift, drift};
pub use evaluated_model::EvaluatedModel;
pub use failure::Failure;
pub use figures::{Comparison, Distances, Figures};
pub use fit::{Fit, Options, fit};
pub use folds::{Folds, cross_validate};
pub use groups::{Group, Reason, groups};
pub use identifiable::{Identifiable, THRESHOLD, Weak, identifiable, knowable};
pub use information::Criterion;
pub use instrument::{
    CAMERA, CONTACT, Camera, Fixture, FixtureGeometry, INSTRUMENTS, INTRINSICS, InstrumentKind,
    KnownDistance, Observable, Reference, SizeInformation,
};
pub use model::{Model, ReferenceLength, Role, Station, Unknown};
pub use moved_place::{MovedPlace, moved_places};
pub use observation::{Approach, Inputs, Measurement, Observation, Points, Uncertainty, Values};
pub use profile::{Profile, ProfileBasis, ProfileJoint, Profiles, fit_profiles};
pub use registration::{Registration, register, register_pairs};
pub use robust::{Loss, robust_scale};
pub use select::{CandidateTerms, ModelTerm, Selection, select};
pub use simulate::{Chance, Simulated, joints_at_values, simulate};
pub use statistics::{FTest, deviation_beyond, f_beyond, f_test, student_beyond};
pub use tool_points::ToolPoints;
pub use variance::{VarianceComponent, variance_components};
