//! Batches: many configurations at once, in the lanes of the machine's widest registers.
//!
//! [`run`] evaluates a function of a manipulator at every configuration. It is compiled where it is
//! called:
//!
//! ```
//! # include!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/pps.rs"));
//! # fn main() -> Result<(), abbe::Error> {
//! use abbe::Function;
//! use abbe::lanes::{InstructionSet, PredictedDisplacement, Tiles, run};
//! use pps::{DESCRIPTION, Parameters, Pps};
//!
//! let (set, count) = (InstructionSet::best(), 1000);
//! let signature = Function::PredictedDisplacement.signature(); // takes q, s, u
//! let mut arguments = Tiles::new(set, signature.arguments_len(&DESCRIPTION), count);
//! for (row, value) in [0.0; 6].into_iter().chain(Parameters::NOMINAL.to_array()).enumerate() {
//!     arguments.fill_row(row, value);
//! }
//! for i in 0..count {
//!     arguments.set_value(0, i, 2.256 * i as f64); // d1, along the rail
//! }
//! let mut results = Tiles::new(set, signature.results_len(&DESCRIPTION), count);
//! run(&Pps, PredictedDisplacement, &arguments, &mut results)?;
//! println!("{} mm along z in the middle of the rail", results.get(2, 500));
//! # assert!(results.get(2, 500).is_finite());
//! # Ok(())
//! # }
//! ```
//!
//! A [`Kernel`] is written once, for [`Lanes`] of any register. [`InstructionSet::run`] compiles it
//! for each instruction set and selects one at run time, so that an ordinary build uses the full
//! width of the machine. [`Tiles`] hold the numbers of many configurations in the layout of the
//! lanes. Configurations are computed independently: for one instruction set the bits of a result
//! do not depend on its position in the batch.
//!
//! | instruction set | lanes | `a · b + c` |
//! |---|---|---|
//! | AVX-512 | 8 | rounded once |
//! | AVX2 and FMA | 4 | rounded once |
//! | all others: SSE2, NEON | 2 | rounded twice, as in scalar code |

mod arc_tangent;
mod functions;
mod instruction_set;
mod one_by_one;
mod run;
mod scalar;
mod sweepable;
#[cfg(test)]
mod tests;
mod tiles;

pub use crate::register::{Lanes, Mask, Register};
pub use functions::*;
pub use instruction_set::{InstructionSet, Kernel};
pub use one_by_one::{OneByOne, one_by_one};
#[doc(hidden)]
pub use run::put_margin;
pub use run::{Evaluate, Named, check, run};
pub use sweepable::Sweepable;
pub use tiles::Tiles;
