//! Coverage at one configuration: the probability that a tolerance is met, and the uncertainty
//! statement of the GUM (JCGM 100).

mod error_distribution;
mod errors_at;
mod machines;
mod statement;
#[cfg(test)]
mod tests;

pub use error_distribution::{
    COVERAGE, Compliance, Correction, DRAWS, ErrorDistribution, Residual, WorstCase,
};
pub use errors_at::{ErrorsAt, errors_at};
pub use machines::{Machines, Yield};
pub use statement::{Contribution, Statement, student_95, student_factor};
