//! Reads study files, which define the analysis of a manipulator.
//!
//! `docs/reference/study.md` describes every key.
//!
//! `study` is the content of a study and `read` reads a file from top to bottom. `published` are
//! figures from a publication, `figure` the figures to draw, `compensation` the residuals after
//! compensation, `allocation` the costs of factors, and `tolerance` the permitted errors.
//! Everything is checked against the spec, and mistakes are reported like those of a spec.

mod allocation;
mod choices;
mod compensation;
mod figure;
mod keys;
mod published;
mod read;
mod study;
mod tolerance;

pub use choices::{CombinedFigure, Criterion, JudgedMachine, Metric};
pub use compensation::Compensated;
pub(crate) use figure::UP;
pub use figure::{Content, Figure, Over};
pub use keys::{TABLES, rules};
pub use published::{Published, PublishedResidual, Subject};
pub use study::Study;
