//! Normally distributed vectors: how likely is a norm, and which norm is not exceeded with a probability.

mod principal;
mod quadrature;
mod student;
#[cfg(test)]
mod tests;
mod vector;

pub use principal::{FLAT, Principal};
pub use student::StudentVector;
pub use vector::{NormalVector, PROBABILITY_ERROR};
