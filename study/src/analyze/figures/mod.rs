//! What the figures of a study show, gathered while the sweep goes on.
//!
//! `gathering` is all of them, `gather` one; `extremes` the envelope of errors over travels, `points` errors in space,
//! `histogram` how often they occur, all in `bins` that need no range in advance; `stick` the frames at home. `figure` is the
//! result.

mod bins;
mod errors;
mod extremes;
mod figure;
mod gather;
mod gathering;
mod histogram;
mod points;
mod stick;

pub use bins::{Bins, Merge, listed};
pub use errors::norm;
pub use extremes::{Envelope, Extremes, Mesh, Range, Worst};
pub use figure::{Figure, Figures, Gathered};
pub(super) use gather::Data;
pub(super) use gathering::Gathering;
pub use histogram::{Count, Histogram};
pub use points::{Point, Points};
pub use stick::{Place, Stick};
