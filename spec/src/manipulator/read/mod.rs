//! Reads a manipulator's spec file and checks it.
//!
//! `spec` reads the file from top to bottom: `declarations` the names, `tables` (with `points`) the
//! functions defined by points, `frames` the transforms, `loops` what closes, `sources`, `effects`, `elastic`,
//! `deviations` and `loads` the physical errors, `fitted`, `covariance` and
//! `undetermined` the results of identification. `positive` checks the signs of masses and
//! stiffnesses, and `rigid` that every matrix is a rigid motion, at `samples`.

mod choices;
mod covariance;
mod declarations;
mod deviations;
mod effects;
mod elastic;
mod fitted;
mod frames;
pub(super) mod keys;
mod loads;
mod loops;
mod points;
mod positive;
mod rigid;
mod samples;
mod sources;
mod spec;
mod tables;
mod undetermined;
