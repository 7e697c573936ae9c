//! Values that variables, parameters and inputs go through, and their combinations.

use abbe_core::{Error, Quantity};

/// The values that one variable, parameter or input goes through.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Which of them, from 0.
    pub index: usize,
    /// The values: the length unit, rad, or coherent units.
    pub values: Vec<f64>,
}

/// How many combinations the values of some axes have.
pub(super) fn combinations(axes: &[Axis]) -> usize {
    axes.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul)
}

/// Puts combination `number` of the axes' values in, the last axis fastest. Returns what is left of the number.
pub(super) fn combine(mut number: usize, axes: &[Axis], values: &mut [f64]) -> usize {
    for axis in axes.iter().rev() {
        let count = axis.values.len().max(1);
        if let Some(value) = axis.values.get(number % count) {
            values[axis.index] = *value;
        }
        number /= count;
    }
    number
}

/// [`Error::Count`] if an index is `count` or more.
pub(crate) fn in_range(
    indices: impl Iterator<Item = usize>,
    quantity: Quantity,
    count: usize,
) -> Result<(), Error> {
    match indices.max() {
        Some(largest) if largest >= count => {
            Err(Error::Count { quantity, expected: count, found: largest + 1 })
        }
        _ => Ok(()),
    }
}
