//! Formats that are imported.

pub use abbe_exchange::dh::Units;
use abbe_spec::DhConvention;

/// Format of an imported robot.
#[derive(Clone, Debug)]
pub enum Format {
    /// URDF.
    Urdf {
        /// Link that is `F_0`; the root if not given.
        base: Option<String>,
        /// Link whose frame is the tool point; the only link without a child if not given.
        tip: Option<String>,
        /// Makes fixed joints part of the frames that follow them; else each is a frame.
        fold: bool,
    },
    /// Table of Denavit-Hartenberg numbers.
    Table {
        /// Order of the four factors of a row.
        convention: DhConvention,
        /// Units of numbers for which the table states none.
        units: Units,
    },
}
