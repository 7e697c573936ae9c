//! Products and unit vectors of three coordinates.

pub(super) use abbe_analysis::sampling::vectors::{cross, dot, subtract as difference, unit};

/// Returns the unit vector of coordinate axis 0, 1 or 2.
pub(super) fn unit_axis(axis: usize) -> [f64; 3] {
    core::array::from_fn(|i| f64::from(u8::from(i == axis)))
}
