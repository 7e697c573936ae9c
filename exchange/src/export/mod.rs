//! Parts that the writers of all formats share.
//!
//! A [`RealMachine`] is a spec with its repeatable errors: an `error_model` gives them
//! frame by frame. `origins` are the poses of its joints for robots, and the frames
//! and legs of machines with loops, `slides` and `rotary_axes` the axes of machine tools.
//! [`ExportReport`] holds the files and the [`PoseDifference`] that remains when they are used.

mod error_model;
pub(crate) mod origins;
mod pose_difference;
mod real_machine;
pub(crate) mod report;
pub(crate) mod rotary_axes;
pub(crate) mod slides;

use error_model::{Cause, ChainErrors, ErrorModel, Link};

pub use self::pose_difference::{Figure, PoseDifference};
pub use self::real_machine::RealMachine;
pub use self::report::{ExportReport, ExportedFile};
pub use self::rotary_axes::RotaryAxis;
pub(crate) use error_model::{about_x, about_z, product};
