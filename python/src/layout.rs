//! Layout of the results of a function in a NumPy array.

use abbe::function::{Array, Count};
use abbe::{Description, Function};

/// Numbers of a pose in the results (4 × 3), and in a homogeneous matrix.
const POSE: usize = 12;
const MATRIX: usize = 16;

/// Layout of the last result of a function: row-major, poses as 4 × 4 matrices.
pub(crate) struct Layout {
    /// Shape of the array of one configuration.
    pub(crate) shape: Vec<usize>,
    /// Indices of the results in the order of the array.
    pub(crate) rows: Vec<usize>,
    /// True for poses: a row 0, 0, 0, 1 is added to every twelve numbers.
    poses: bool,
}

impl Layout {
    /// Returns the layout of a function.
    pub(crate) fn new(function: Function, description: &Description) -> Self {
        let results = function.signature().results;
        let Some((last, others)) = results.split_last() else { unreachable!("every function has a result") };
        let first: usize = others.iter().map(|array| array.len(description)).sum();
        let counts: Vec<usize> = last.shape.iter().map(|count| count.value(description)).collect();
        let poses = last.shape.ends_with(&[Count::Exactly(4), Count::Exactly(3)]);
        let (shape, order): (Vec<usize>, Vec<usize>) = match counts[..] {
            _ if poses => {
                let many = &counts[..counts.len() - 2];
                let count: usize = many.iter().product();
                let order = (0..count).flat_map(|k| (0..POSE).map(move |i| POSE * k + 3 * (i % 4) + i / 4));
                ([many, &[4, 4]].concat(), order.collect())
            }
            // Results are column-major, arrays row-major.
            [columns, rows] if is_matrix(last) => {
                let order = (0..rows).flat_map(|i| (0..columns).map(move |j| rows * j + i));
                (vec![rows, columns], order.collect())
            }
            _ => (counts, (0..last.len(description)).collect()),
        };
        Self { shape, rows: order.into_iter().map(|row| first + row).collect(), poses }
    }

    /// Returns the number of elements of the array of one configuration.
    pub(crate) fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Fills the arrays of some configurations. `copy` copies [`rows`](Self::rows) of all of them,
    /// one configuration after the other.
    pub(crate) fn fill(&self, array: &mut [f64], staged: &mut Vec<f64>, copy: impl FnOnce(&mut [f64])) {
        if !self.poses {
            return copy(array);
        }
        staged.resize(array.len() / MATRIX * POSE, 0.0);
        copy(staged);
        for (matrix, rows) in array.chunks_exact_mut(MATRIX).zip(staged.chunks_exact(POSE)) {
            matrix[..POSE].copy_from_slice(rows);
            matrix[POSE..].copy_from_slice(&[0.0, 0.0, 0.0, 1.0]);
        }
    }
}

/// Returns true for the columns of a matrix, false for six numbers per item.
fn is_matrix(array: &Array) -> bool {
    matches!(array.name, "columns" | "covariance")
}
