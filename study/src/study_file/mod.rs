//! Reads study files, which define the analysis of a manipulator.
//!
//! `docs/reference/study.md` describes every key.
//!
//! `study` is the content of a study, with figures from a publication and the costs of factors, and
//! `read` reads a file from top to bottom. `figure` are the figures to draw, `compensation` the
//! residuals after compensation, and `tolerance` the permitted errors.
//! Everything is checked against the spec, and mistakes are reported like those of a spec.

mod choices;
mod compensation;
mod figure;
mod keys;
mod read;
mod study;
mod tolerance;

pub use choices::{CombinedFigure, Criterion, JudgedMachine, Metric};
pub use compensation::Compensated;
pub(crate) use figure::UP;
pub use figure::{Content, Figure, Over};
pub use keys::{rules, tables};
pub use study::{Published, PublishedResidual, Study, Subject};
