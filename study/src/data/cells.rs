//! Columns in memory.

/// The cells of a column.
#[derive(Clone, Debug)]
pub enum Cells {
    /// Numbers; one that is not there is NaN.
    Numbers(Vec<f64>),
    /// Texts; one that is not there is empty.
    Texts(Vec<String>),
}

impl Cells {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Numbers(cells) => cells.len(),
            Self::Texts(cells) => cells.len(),
        }
    }
}
