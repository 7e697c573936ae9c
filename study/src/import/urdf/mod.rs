//! URDF, the format of ROS: links, and the joints between them.
//!
//! `read` takes the XML apart into a `robot`, `tree` checks how it hangs together, `chained` takes out what lies between two
//! links.

mod chained;
mod read;
mod robot;
mod tree;

use abbe_spec::document::Document;

pub(super) use chained::Ends;

use super::almost::Almost;
use super::chain::Chain;
use crate::notes::Notes;

/// The chain between two links of a URDF file.
pub(super) fn chain(
    document: &mut Document,
    ends: &Ends,
    fold: bool,
    almost: &mut Almost,
    notes: &mut dyn Notes,
) -> Option<Chain> {
    let robot = read::robot(document)?;
    if !document.found.is_empty() {
        return None;
    }
    let tree = tree::Tree::new(&robot, document)?;
    chained::chain(&robot, &tree, ends, fold, almost, document, notes)
}
