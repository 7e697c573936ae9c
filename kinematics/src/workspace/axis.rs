//! Axes of a grid: values of variables, parameters or inputs, and their combinations.

/// Values of one variable, parameter or input along an axis of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Index of the variable, parameter or input, from 0.
    pub index: usize,
    /// Values in the length unit, rad, or coherent units.
    pub values: Vec<f64>,
}

/// Returns the number of combinations of the values of some axes.
pub(super) fn combinations(axes: &[Axis]) -> usize {
    axes.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul)
}

/// Writes combination `number` of the axes' values to `values`, the last axis fastest. Returns the
/// quotient of the number by the number of combinations.
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
