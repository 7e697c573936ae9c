//! Normal and Student vectors in space: probabilities and quantiles of their norms.

mod quadrature;
mod student;
#[cfg(test)]
mod tests;
mod vector;

pub use student::StudentVector;
pub(crate) use vector::ONE_SIDED_95;
pub use vector::{FLAT, NormalVector, PROBABILITY_ERROR, Principal};
