//! Loops over the frames of a long chain: what its generated functions call in place of straight-line code.
//!
//! They take `A_1 … A_n` and the tool by columns, as `raw::transforms` gives them, and do what straight-line code does
//! but know no zeros in them. Straight-line code of long chains outgrows the instruction cache and takes its time to
//! compile. Everything is plain loops and `#[inline(always)]`, so that lanes keep their instruction set.

mod covariance;
mod displacement;
mod error_jacobian;
mod euler;
mod pose;
mod sum;
mod symbol_jacobian;
mod vector;

pub use covariance::covariance;
pub use displacement::{by_source, displacement};
pub use error_jacobian::{distinct, error_jacobian};
pub use euler::{euler_columns, euler_covariance, euler_displacement, euler_distinct};
pub use pose::{pose, real_pose};
pub use sum::combine;
pub use symbol_jacobian::symbol_jacobian;

/// A rigid motion by columns: x, y, z axis and position.
type Motion<T> = [[T; 3]; 4];
