//! Text of [`WIDTH`] columns, or as many as [`at_width`] sets: layout, and the commands whose
//! output is no report.

mod imported;
mod jacobian;
mod layout;
mod list;
mod table;

pub use imported::imported;
pub use jacobian::jacobian;
pub use layout::next;
pub(crate) use layout::{aligned, fact};
pub use list::list;
pub use table::{Table, WIDTH, at_width, wrapped};

/// Amount of a report to print.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// The answer on one screen: at most 25 lines.
    #[default]
    Answer,
    /// The answer, every table and every sentence.
    Full,
}

impl Detail {
    /// Returns [`Full`](Self::Full) if everything is wanted.
    pub fn new(full: bool) -> Self {
        if full { Self::Full } else { Self::Answer }
    }
}
