//! Normal and Student vectors in space: probabilities and quantiles of their norms.

mod principal;
mod quadrature;
mod student;
#[cfg(test)]
mod tests;
mod vector;

pub use principal::{FLAT, Principal};
pub use student::StudentVector;
pub use vector::{NormalVector, PROBABILITY_ERROR};
