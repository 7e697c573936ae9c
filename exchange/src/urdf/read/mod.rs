//! Reads the chain between two links of a URDF file.
//!
//! `xml` parses the file into a `robot`, `tree` checks that its links form a tree, and `path` takes
//! the chain from base to tip.

mod path;
mod robot;
mod tree;
mod xml;

use abbe_spec::{Document, Notes};

pub use self::path::Ends;
use crate::import::{AngleRounding, Chain};

/// Reads the chain between two links of a URDF file.
///
/// With `fold` set, fixed joints become part of the frames that follow them; else each is a frame.
/// Returns `None` if the file is wrong: the mistakes are then in the document. Notes say what is
/// left out.
pub fn read(
    document: &Document,
    ends: &Ends,
    fold: bool,
    angles: &mut AngleRounding,
    notes: &mut dyn Notes,
) -> Option<Chain> {
    let robot = xml::robot(document)?;
    if document.mistakes() > 0 {
        return None;
    }
    let tree = tree::Tree::new(&robot, document)?;
    path::chain(&robot, &tree, ends, fold, angles, document, notes)
}
