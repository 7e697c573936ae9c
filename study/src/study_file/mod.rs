//! Study files: what to do with a manipulator.
//!
//! `docs/reference/study.md` has every key.
//!
//! `study` is what a study says, `read` reads a file from top to bottom, `published` the figures that somebody printed,
//! `figure` those to draw, `compensation` what compensation leaves,
//! `tolerance` how large errors may be. Everything is checked against the spec, and mistakes are
//! shown as those of a spec.

mod compensation;
mod figure;
mod keys;
mod published;
mod read;
mod study;
mod tolerance;

pub use compensation::Compensated;
pub use figure::{Content, Figure, Over};
pub use keys::TABLES;
pub use published::{CombinedFigure, Metric, Published, PublishedResidual, Subject};
pub use study::Study;
