//! Where the numbers of a function's results stand in an array of NumPy's.

use abbe::function::{Array, Count};
use abbe::{Description, Function};

/// How many numbers a pose has here, and how many in a matrix.
const POSE: usize = 12;
const MATRIX: usize = 16;

/// The last result of a function, row-major; poses are 4 × 4.
pub(crate) struct Layout {
    /// The dimensions of the array of one configuration.
    pub(crate) shape: Vec<usize>,
    /// Which results are copied, in their order.
    pub(crate) rows: Vec<usize>,
    /// Whether they are poses: to every twelve a row 0, 0, 0, 1 is added.
    poses: bool,
}

impl Layout {
    /// That of a function.
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
            // Columns become rows.
            [columns, rows] if is_matrix(last) => {
                let order = (0..rows).flat_map(|i| (0..columns).map(move |j| rows * j + i));
                (vec![rows, columns], order.collect())
            }
            _ => (counts, (0..last.len(description)).collect()),
        };
        Self { shape, rows: order.into_iter().map(|row| first + row).collect(), poses }
    }

    /// How many numbers the array of one configuration has.
    pub(crate) fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Fills arrays of some configurations; `copy` copies [`rows`](Self::rows) of all of them, one after the other.
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

/// Whether an array holds the columns of a matrix, and not one row of six for each of something.
fn is_matrix(array: &Array) -> bool {
    matches!(array.name, "columns" | "covariance")
}
