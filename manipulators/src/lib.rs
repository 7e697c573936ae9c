//! Manipulators shipped with abbe, each as a module generated from its file in `specs/`.
//!
//! ```
//! use abbe_manipulators::pps;
//!
//! let q = [1128.0, 280.0, 0.0, 0.0, 0.0, 0.0]; // home: mm and rad
//! let (pose, error_jacobian) = pps::error_jacobian(&q, &pps::Parameters::NOMINAL)?;
//! assert_eq!(pose.position(), [1128.0, 1626.0, 1568.0]);
//! // A rotation e_s of frame 1 moves the treatment point sideways by its distance from the rail.
//! assert_eq!(error_jacobian[3][0], 1568.0);
//! # Ok::<(), abbe::Error>(())
//! ```
//!
//! Batches of configurations, in the widest registers of the machine:
//!
//! ```
//! use abbe::Function;
//! use abbe::lanes::{self, InstructionSet, PredictedDisplacement, Tiles};
//! use abbe_manipulators::pps::{self, DESCRIPTION, Pps};
//!
//! let (set, count) = (InstructionSet::best(), 1000);
//! let signature = Function::PredictedDisplacement.signature(); // takes q, s, u
//! let mut arguments = Tiles::new(set, signature.arguments_len(&DESCRIPTION), count);
//! let home = DESCRIPTION.variables.iter().map(|variable| variable.home);
//! let given = home.chain(pps::Parameters::NOMINAL.to_array()).chain(pps::Inputs::NOMINAL.to_array());
//! for (row, value) in given.enumerate() {
//!     arguments.fill_row(row, value);
//! }
//! for i in 0..count {
//!     arguments.set_value(0, i, 2.256 * i as f64); // along the rail
//! }
//! let mut results = Tiles::new(set, signature.results_len(&DESCRIPTION), count);
//! lanes::run(&Pps, PredictedDisplacement, &arguments, &mut results)?;
//!
//! let q = [1128.0, 280.0, 0.0, 0.0, 0.0, 0.0];
//! let one = pps::predicted_displacement(&q, &pps::Parameters::NOMINAL, &pps::Inputs::NOMINAL)?;
//! assert!((results.get(2, 500) - one[2]).abs() < 1e-12);
//! # Ok::<(), abbe::Error>(())
//! ```

abbe::include_manipulators!();

mod shipped;

pub use shipped::{MAPS, MECHANISMS, PLANS, SHIPPED, STUDIES, STUDY_FILES, Shipped};
