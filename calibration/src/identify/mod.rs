//! Generalized errors from measurements: section 6 of the paper, and the algorithm that it leaves out.
//!
//! An [`Observation`] is what an instrument measured at one configuration. A [`Model`] says which numbers are unknown and
//! gives residuals and their exact derivatives on the real chain, equation (6). [`identifiable()`] finds which of
//! them the data determine and what the others are grouped with, [`groups()`] the same from the joint twists alone;
//! [`fit()`] solves, [`cross_validate`] tests on data left out, [`select()`] adds richer terms that earn their place.
//! [`optimal`] chooses where to measure, [`simulate()`] measures a machine whose errors are known.
//!
//! ```
//! # use abbe::*;
//! use abbe::identify::{Failure, Measurement, Model, Observation, Options, Uncertainty, Unknown, fit};
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
//! #             parameters: List::Constant(&[]), inputs: List::Constant(&[]), sources: List::Constant(&[]),
//! #             effects: List::Constant(&[]),
//! #         };
//! #         &DESCRIPTION
//! #     }
//! #     fn transforms(&self, q: &[f64], _: &[f64], transforms: &mut [Pose]) -> Result<(), Error> {
//! #         for (transform, (angle, length)) in transforms.iter_mut().zip(q.iter().zip([450.0, 400.0])) {
//! #             let (s, c) = angle.sin_cos();
//! #             *transform = Pose([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], [length * c, length * s, 0.0]]);
//! #         }
//! #         transforms[2] = Pose::IDENTITY;
//! #         Ok(())
//! #     }
//! #     fn pose(&self, _: &[f64], _: &[f64]) -> Result<Pose, Error> { unimplemented!() }
//! #     fn error_jacobian(&self, _: &[f64], _: &[f64], _: &mut [[f64; 6]]) -> Result<Pose, Error> { unimplemented!() }
//! #     fn joint_jacobian(&self, _: &[f64], _: &[f64], _: &mut [[f64; 6]]) -> Result<Pose, Error> { unimplemented!() }
//! #     fn parameter_jacobian(&self, _: &[f64], _: &[f64], _: &mut [[f64; 6]]) -> Result<Pose, Error> { unimplemented!() }
//! #     fn effects(&self, _: &[f64], _: &[f64], _: &[f64], _: &mut [f64]) -> Result<(), Error> { Ok(()) }
//! #     fn generalized_errors(&self, _: &[f64], _: &[f64], _: &[f64], _: &mut [[f64; 6]]) -> Result<(), Error> { Ok(()) }
//! # }
//! # fn main() -> Result<(), Failure> {
//! // A planar arm of 450 and 400 mm, whose tool point an instrument of 0.01 mm sees.
//! let arm = Model::ideal(&Arm, vec![[0.0; 3]], Uncertainty { length: 0.01, angle: 1.0 });
//! let arm = arm.with(vec![Unknown::Error(0, Component::X), Unknown::Error(0, Component::Roll)]);
//! // In truth its upper arm is 0.3 mm too long, and the zero of its elbow is 1 mrad off.
//! let truth = [0.3, 1e-3];
//! let measure = |line: u64| {
//!     let q = vec![0.1 * line as f64, 1.5 - 0.15 * line as f64];
//!     let nothing = Measurement::Points(vec![None].into());
//!     let planned = Observation::new(line, q, Vec::new(), nothing);
//!     let point = arm.pose(&mut arm.room(), &planned, &truth)?.position();
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

mod acceleration;
mod clustered;
mod columns;
mod configurations;
mod design;
mod drift;
mod failure;
mod figures;
mod fit;
mod folds;
mod gradient;
mod groups;
mod identifiable;
mod information;
mod left_out;
mod linearize;
mod model;
mod observation;
mod options;
mod outliers;
mod reading;
mod reflections;
mod registration;
mod residuals;
mod robust;
mod select;
mod simulate;
mod solver;
mod station;
mod statistics;
mod tool_points;
mod touch;
mod triangle;
mod unknown;
mod values;
mod variance;

#[cfg(test)]
mod coverage;
#[cfg(test)]
mod tests;

pub use clustered::Independent;
pub use configurations::Configurations;
pub use design::{Design, Objective, optimal, whole};
pub use drift::{Drift, Follows, drift};
pub use failure::Failure;
pub use figures::{Comparison, Distances, Figures};
pub use fit::{Fit, fit};
pub use folds::{Folds, cross_validate};
pub use groups::{Group, Reason, groups};
pub use identifiable::{Identifiable, THRESHOLD, Weak, identifiable, knowable};
pub use information::Criterion;
pub use model::Model;
pub use observation::{Approach, Measurement, Observation, Uncertainty};
pub use options::Options;
pub use reading::{Fixture, Gauge, Place, Reading, tangents};
pub use registration::{Registration, register, register_pairs};
pub use residuals::Room;
pub use robust::{Loss, robust_scale};
pub use select::{Factored, Offer, Selection, select};
pub use simulate::{Chance, Simulated, simulate};
pub use station::Station;
pub use statistics::{FTest, Observability, deviation_beyond, f_test, student_beyond, student_factor};
pub use tool_points::ToolPoints;
pub use touch::touched;
pub use unknown::{Role, Unknown};
pub use values::{Inputs, Points, Values};
pub use variance::{VarianceComponent, variance_components};
