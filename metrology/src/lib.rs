//! Jobs on measurements: reading them, checking how they are meant, identifying errors from them,
//! and judging a machine by them.
//!
//! They follow the rules of [`abbe_study`]: one folder per job, named after the command, with one
//! struct that holds options and inputs, and one serializable report.
//!
//! [`data`] holds measurements and the maps of their columns.

pub mod compensate;
pub mod doctor;
pub mod identify;
pub mod measure;
pub mod monitor;
pub mod plan;
pub mod positioning;
pub mod simulate;

pub mod data;
pub mod schema;

mod acceptance;
mod interpretations;
mod reads;
mod running_sums;
mod sizes;

pub use acceptance::{Acceptance, AcceptanceVerdict, Decision, Judged, LimitCheck};
