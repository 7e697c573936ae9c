//! The generalized errors of a real machine, from measurements.
//!
//! `setup` places the machine before the instrument, `instruments` says how good every one of several is, `aim` where they can
//! be read; `readings` asks whether the data are read as they were meant, `reading`
//! has other ways to read them, `doubt` says what no machine has, `known_rows` which test rows are none. `solve`
//! fits and judges on the data alone, `gross` looks for gross errors; `magnitude` are sources of the spec that are fitted with
//! the constants. `terms` are errors that richer models have, `candidates` those that are tried, `derived` the inputs that
//! follow from the order of the rows; `choose` takes in what earns its place, `extended` is the spec that has it. `found` is the
//! identified machine, `placed` where it stands and what is mounted on its tool, `written` its spec (`written_compliance` full compliances, `written_covariance` how well it is known) and `written_map` its map; `report` is what comes out,
//! with `point_residuals` for pictures, `alike`, `counts` and `meaning` (the findings in the words of the spec), `job` the way from one to the other.

mod aim;
mod alike;
mod candidates;
mod choose;
mod counts;
mod derived;
mod doubt;
mod extended;
mod families;
mod found;
mod gross;
mod instruments;
mod job;
mod known_rows;
mod magnitude;
mod meaning;
mod misread;
mod not_known;
mod order;
mod outside;
mod placed;
mod point_residuals;
mod priors;
mod report;
mod scale;
mod setup;
mod solve;
mod stated;
mod terms;
mod written;
mod written_compliance;
mod written_covariance;
mod written_map;

pub use alike::Alike;
pub(crate) use alike::alikes;
pub use candidates::candidates;
pub use counts::Counts;
pub use derived::{Derived, DerivedKind};
pub use extended::extended;
pub use families::{Family, Harmonics};
pub use found::{FoundError, FoundMagnitude, FoundModel, FoundTerm};
pub use gross::shown_lines;
pub use instruments::Told;
pub use job::Identify;
pub use not_known::NotKnown;
pub use order::Order;
pub use outside::Outside;
pub use placed::{Placed, PlacedInstrument, PlacedStation};
pub use point_residuals::PointResidual;
pub use priors::Prior;
pub use report::{
    Certainty, Compared, CrossValidation, Gain, Held, Indices, Kind, LeftOut, Magnitude, Pair, Parameter,
    Report, TermGain,
};
pub use solve::Settings;
pub use terms::{Angle, Basis, Place, Term, Wave};
pub use written::WrittenSpec;

pub(crate) use aim::{aimed, unaimed};
pub(crate) use doubt::{doubt, too_large};
pub use meaning::Meaning;
pub(crate) use meaning::chain_errors;
pub use crate::sizes::Sizes;
pub(crate) use misread::check_interpretation;
pub(crate) use scale::scale_note;
pub(crate) use setup::Setup;
