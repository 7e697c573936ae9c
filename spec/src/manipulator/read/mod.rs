//! Reads a manipulator's spec file and checks it.
//!
//! `spec` reads the file from top to bottom: `declarations` the names, `tables` (with `points`) the
//! functions defined by points, `frames` the transforms, `loops` what closes, `sources`, `effects`,
//! `elastic`, `deviations` and `loads` the physical errors, `covariance` the results of
//! identification.
//!
//! `freedoms` checks that the loops determine the passive variables, and that sources have
//! an effect that is known there. `positive` checks the signs of masses and stiffnesses, and
//! `rigid` that every matrix is a rigid motion, at samples.

mod covariance;
mod declarations;
mod deviations;
mod effects;
mod elastic;
mod frames;
mod freedoms;
pub(super) mod keys;
mod loads;
mod loops;
mod points;
mod positive;
mod rigid;
mod sources;
mod spec;
mod sum_limits;
mod tables;

use declarations::Declarations;
use effects::{Named, find_frame, frame_or_base, read_effect, read_parent};
use keys::{
    BEAM_AXES, CLASSES, CLOSURES, COVARIANCE, COVARIANCE_OF, INTERPOLATIONS, JOINT_KINDS, LENGTHS, LOAD_AXES,
    ORIENTATIONS, OUTSIDE, TOOL,
};
