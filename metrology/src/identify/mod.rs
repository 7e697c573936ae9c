//! Identifies the generalized errors of a real machine from measurements.
//!
//! `options` are the user's settings. `setup` places the machine relative to the instrument, by
//! places `registered` in closed form, `open_places` finds what the map does not place,
//! `line_of_sight` moves the machine to where instruments can be read, and `instruments` estimates
//! their uncertainties. `board_check` tests the corners of a camera's board, `interpretation_check`
//! the `map_interpretation`, `plausibility` finds errors too large for a machine. `job` runs all of
//! it, and counts test rows that were fitted.
//!
//! `solve` fits and cross-validates with `priors`, and `row_notes` warns of gross errors and of
//! what rows cannot say. `between_stations` includes the differences of the machine between
//! stations, `between_blocks` those between regions and runs of rows. `terms` are errors of richer
//! models, `families` and `candidates` those that are tried, and `derived` the inputs computed from
//! the row order. `choose` selects the terms that help, `complete_fit` fits constants with them,
//! `extended` adds them and magnitudes of sources to the spec. `profiles` adds errors of joints by
//! many cycles per turn, each as a `profile_table`; `joint_profiles` are their results.
//!
//! `found_model` is the identified machine, `found_placement` its placement and that of the
//! targets, `fitted` their values. `spec_writer` writes its spec, `compliance_writer` full
//! compliances, `covariance_writer` the `found_covariance`, `unexplained` the errors that the model
//! does not have, and `map_writer` the map; `read_back` evaluates both. The `report` contains
//! `as_joint_errors` (errors as `chain_numbers`: zeros and lengths) and their `alternatives`, what
//! is `indistinguishable`, `parameters`, the `scale`, the `gain` over other models (`compare`),
//! `known_distances` with their residuals, and `point_residuals` for plots. `unread` are
//! instruments without a reading.

mod alternatives;
mod as_joint_errors;
mod between_blocks;
mod between_stations;
mod board_check;
mod candidates;
mod chain_numbers;
mod choose;
mod compare;
mod complete_fit;
mod compliance_writer;
mod covariance_writer;
mod derived;
mod extended;
mod families;
mod fitted;
mod found_covariance;
mod found_model;
mod found_placement;
mod gain;
mod indistinguishable;
mod instruments;
mod interpretation_check;
mod job;
mod joint_profiles;
mod known_distances;
mod line_of_sight;
mod map_interpretation;
mod map_writer;
mod open_places;
pub mod options;
mod parameters;
mod plausibility;
mod point_residuals;
mod priors;
mod profile_table;
mod profiles;
mod read_back;
mod reading_units;
mod registered;
mod report;
mod row_notes;
mod scale;
mod setup;
mod solve;
mod spec_writer;
mod terms;
mod unexplained;
mod unread;

use as_joint_errors::AsJointErrors;
use complete_fit::{Assessed, BLOCKS, FitInput};
use solve::{Solved, diagnose, solve};

pub use alternatives::Alternative;
pub use as_joint_errors::JointError;
pub use candidates::{Stages, candidates};
pub use derived::{Derived, DerivedKind};
pub use extended::extended;
pub use families::{Family, Harmonics};
pub use found_model::{FoundError, FoundMagnitude, FoundModel, FoundTerm};
pub use found_placement::{FoundInstrument, FoundPlacement, FoundStation, PlacementAtStation};
pub use gain::Gain;
pub use indistinguishable::{Indistinguishable, IndistinguishableReason};
pub use instruments::InstrumentFit;
pub use job::{Identify, overlap_warning};
pub use joint_profiles::{JointProfile, JointProfiles};
pub use known_distances::KnownDistanceFit;
pub use options::Settings;
pub use point_residuals::PointResidual;
pub use priors::Prior;
pub use report::{
    Certainty, Compared, Counts, CrossValidation, Kind, LeftOut, Magnitude, MagnitudeSum, Pair, Parameter,
    Redundant, Report, ResidualDrift, TermGain, TestExtrapolation, WeaklyDetermined, Written,
};
pub use row_notes::shown_lines;
pub use spec_writer::IdentifiedSpec;
pub use terms::{Angle, Basis, ErrorSite, HeldJoint, Term, Wave};

pub use crate::sizes::Sizes;

pub(crate) use chain_numbers::{chain_errors, unknowns_of};
pub(crate) use extended::own_magnitudes;
pub(crate) use indistinguishable::indistinguishable;
pub(crate) use interpretation_check::check_interpretation;
pub(crate) use line_of_sight::{nothing_readable, readable_configurations};
pub(crate) use parameters::redundant;
pub(crate) use plausibility::{check_plausibility, too_large};
pub(crate) use row_notes::RowNotes;
pub(crate) use scale::scale_note;
pub(crate) use setup::Setup;
pub(crate) use unexplained::unknown_sources;
