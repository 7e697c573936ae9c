//! Many configurations at once: the lanes of the machine's widest registers.
//!
//! A [`Kernel`] is written once, for [`Lanes`] of any register; [`InstructionSet::run`] compiles it for each
//! instruction set and chooses when the program runs, so that an ordinary build is as fast as the machine.
//! [`Tiles`] hold the numbers of many configurations as lanes want them. Every configuration is computed by
//! itself: the same bits wherever it stands in a batch, as long as the instruction set is the same.
//!
//! | instruction set | lanes | `a · b + c` |
//! |---|---|---|
//! | AVX-512 | 8 | rounded once |
//! | AVX2 and FMA | 4 | rounded once |
//! | any other: SSE2, NEON | 2 | rounded twice, as in scalar code |

mod functions;
mod instruction_set;
mod one_by_one;
#[cfg(any(test, not(target_arch = "x86_64")))]
mod portable;
mod register;
mod rows;
mod run;
#[cfg(test)]
mod tests;
mod tiles;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use functions::*;
pub use instruction_set::{InstructionSet, Kernel};
pub use one_by_one::OneByOne;
#[cfg(feature = "analysis")]
pub(crate) use one_by_one::one_by_one;
pub use register::{Lanes, Mask, Register};
#[doc(hidden)]
pub use rows::{Rows, put_margin};
pub use run::{Evaluate, check, run};
pub use tiles::Tiles;
