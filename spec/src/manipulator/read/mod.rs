//! Reads a manipulator's spec file and checks it.
//!
//! `spec` reads the file from top to bottom: `declarations` the names, `tables` (with `points`) the
//! functions defined by points, `frames` the transforms, `loops` what closes (both with frames that
//! are `named`), `sources`, `effects`, `elastic`, `deviations` and `loads` the physical errors,
//! `fitted` and `covariance` the results of identification.
//!
//! `freedoms` checks that the loops determine the passive variables, `in_loops` that sources have
//! an effect that is known there. `positive` checks the signs of masses and stiffnesses, and
//! `rigid` that every matrix is a rigid motion, at `samples`.

mod choices;
mod covariance;
mod declarations;
mod deviations;
mod effects;
mod elastic;
mod fitted;
mod frames;
mod freedoms;
mod in_loops;
pub(super) mod keys;
mod loads;
mod loops;
mod named;
mod points;
mod positive;
mod rigid;
mod samples;
mod sources;
mod spec;
mod sum_limits;
mod tables;
