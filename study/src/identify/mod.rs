//! The generalized errors of a real machine, from measurements.
//!
//! `options` are what can be chosen. `setup` places the machine before the instrument, `line_of_sight` moves it to where instruments can be read, `instruments` fits
//! their uncertainties. `misread` tests whether the data are read as they are meant, against what the map has `stated`;
//! `plausibility` finds errors that no machine has, `train_test_overlap` test rows that were fitted.
//!
//! `solve` fits and judges on the data alone, with `priors`; `outliers` looks for gross errors; `magnitude` are sources of the spec that
//! are fitted with the constants. `terms` are errors that richer models have, `families` and `candidates` those that are tried,
//! `derived` the inputs that follow from the order of the rows; `choose` takes in those that help, `extended` is the spec that has
//! them.
//!
//! `found` is the identified machine, `placed` where it stands and what is mounted on its tool. `spec_writer` writes its spec,
//! `compliance_writer` full compliances, `covariance_writer` the covariance, `map_writer` the map. The `report` has `counts`,
//! `as_joint_errors` (the errors as zeros and lengths of the chain), what is `indistinguishable` or `weakly_determined`, `drift`,
//! `extrapolation`, the `scale`, and `point_residuals` for pictures. `job` is the way from one to the other.

mod as_joint_errors;
mod candidates;
mod choose;
mod compliance_writer;
mod counts;
mod covariance_writer;
mod derived;
mod drift;
mod extended;
mod extrapolation;
mod families;
mod found;
mod indistinguishable;
mod instruments;
mod job;
mod line_of_sight;
mod magnitude;
mod map_writer;
mod misread;
pub mod options;
mod outliers;
mod placed;
mod plausibility;
mod point_residuals;
mod priors;
mod report;
mod scale;
mod setup;
mod solve;
mod spec_writer;
mod stated;
mod terms;
mod train_test_overlap;
mod weakly_determined;

pub use as_joint_errors::JointError;
pub use candidates::candidates;
pub use counts::Counts;
pub use derived::{Derived, DerivedKind};
pub use drift::ResidualDrift;
pub use extended::extended;
pub use extrapolation::Extrapolation;
pub use families::{Family, Harmonics};
pub use found::{FoundError, FoundMagnitude, FoundModel, FoundTerm};
pub use indistinguishable::Indistinguishable;
pub use instruments::InstrumentFit;
pub use job::Identify;
pub use options::Settings;
pub use outliers::shown_lines;
pub use placed::{Placed, PlacedInstrument, PlacedStation};
pub use point_residuals::PointResidual;
pub use priors::Prior;
pub use report::{
    Certainty, Compared, CrossValidation, Gain, Held, Indices, Kind, LeftOut, Magnitude, Pair, Parameter,
    Report, TermGain,
};
pub use spec_writer::IdentifiedSpec;
pub use terms::{Angle, Basis, ErrorSite, Term, Wave};
pub use weakly_determined::WeaklyDetermined;

pub use crate::sizes::Sizes;

pub(crate) use as_joint_errors::chain_errors;
pub(crate) use indistinguishable::indistinguishable;
pub(crate) use line_of_sight::{nothing_readable, readable_configurations};
pub(crate) use misread::check_interpretation;
pub(crate) use plausibility::{check_plausibility, too_large};
pub(crate) use scale::scale_note;
pub(crate) use setup::Setup;
