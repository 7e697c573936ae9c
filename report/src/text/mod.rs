//! Text of [`WIDTH`] columns, or as many as [`at_width`] sets: layout, and the commands whose
//! output is no report, such as the list of the shipped manipulators.

mod imported;
mod jacobian;
mod layout;
mod table;

pub use imported::imported;
pub use jacobian::jacobian;
pub use layout::next;
pub(crate) use layout::{aligned, fact};
pub use table::{Table, WIDTH, at_width, wrapped};

use abbe_study::list::ShippedManipulator;

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

/// Returns what `abbe list` prints.
pub fn list(shipped: &[ShippedManipulator]) -> String {
    let mut table = Table::new(&["name", "manipulator", "joints", "unit", "sources", "study"]);
    for ShippedManipulator { name, title, joints, length, sources, study, .. } in shipped {
        let study = if *study { "yes" } else { "" };
        table.row([name, title, joints, *length, &sources.to_string(), study]);
    }
    table.right(&[4]).to_string()
}
