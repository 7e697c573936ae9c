//! Data of the study's figures, gathered during the sweep.
//!
//! `figures_builder` handles all figures and `figure_builder` one. `extremes` holds envelopes over
//! travels and `points` error clouds, in `bins` that need no range in advance. `stick` holds the
//! frames at home, and `figure` the result, also the histograms of frequencies.

mod bins;
mod errors;
mod extremes;
mod figure;
mod figure_builder;
mod figures_builder;
mod points;
mod stick;

pub use abbe::analysis::sampling::norm;
pub use bins::{Bins, Merge, listed};
pub use extremes::{Envelope, Extremes, Mesh, Range, Worst};
pub use figure::{Count, Figure, FigureData, Figures, Histogram};
pub(super) use figure_builder::PartialFigure;
pub(super) use figures_builder::FiguresBuilder;
pub use points::{Point, Points};
pub use stick::{FrameOrigin, Stick};
