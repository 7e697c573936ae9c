//! The traits of wrenfold's Rust code, implemented for plain column-major arrays.

/// Readable matrix.
pub trait Span2D<const ROWS: usize, const COLUMNS: usize> {
    type ValueType;
    fn get(&self, row: usize, column: usize) -> Self::ValueType;
}

/// Writable matrix.
pub trait OutputSpan2D<const ROWS: usize, const COLUMNS: usize> {
    type ValueType;
    fn set(&mut self, row: usize, column: usize, value: Self::ValueType);
}

impl<const ROWS: usize, const COLUMNS: usize, const SIZE: usize> Span2D<ROWS, COLUMNS> for [f64; SIZE] {
    type ValueType = f64;

    #[inline(always)]
    fn get(&self, row: usize, column: usize) -> f64 {
        self[row + ROWS * column]
    }
}

impl<const ROWS: usize, const COLUMNS: usize, const SIZE: usize> OutputSpan2D<ROWS, COLUMNS> for [f64; SIZE] {
    type ValueType = f64;

    #[inline(always)]
    fn set(&mut self, row: usize, column: usize, value: f64) {
        self[row + ROWS * column] = value;
    }
}
