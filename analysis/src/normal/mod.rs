//! Normal and Student vectors in space: probabilities and quantiles of their norms.

mod principal;
mod quadrature;
mod student;
#[cfg(test)]
mod tests;
mod vector;

pub use principal::{FLAT, Principal};
pub use student::StudentVector;
pub(crate) use vector::ONE_SIDED_95;
pub use vector::{NormalVector, PROBABILITY_ERROR};
