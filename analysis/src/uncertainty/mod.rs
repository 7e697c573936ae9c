//! What a figure covers, at one configuration: how likely a tolerance is met, and the uncertainty as the GUM (JCGM 100) states it.

mod compliance;
mod errors_at;
mod statement;
#[cfg(test)]
mod tests;

pub use compliance::{Compliance, DRAWS, compliance, normal_compliance};
pub use errors_at::{ErrorsAt, errors_at};
pub use statement::{COVERAGE, Contribution, Statement, student_95};
