//! Generalized errors from measurements: section 6 of the paper, and the algorithm that it leaves out.
//!
//! An [`Observation`] is what an instrument measured at one configuration. A [`Model`] says which numbers are unknown and
//! gives residuals and their exact derivatives on the real chain, equation (6). [`identifiable()`] finds which of
//! them the data determine and what the others are grouped with, [`groups()`] the same from the joint twists alone;
//! [`fit()`] solves, [`cross_validate`] tests on data left out, [`select()`] adds richer terms that earn their place.
//! [`d_optimal`] chooses where to measure, [`simulate()`] measures a machine whose errors are known.

mod columns;
mod design;
mod failure;
mod figures;
mod fit;
mod folds;
mod groups;
mod identifiable;
mod linearize;
mod model;
mod observation;
mod options;
mod registration;
mod residuals;
mod robust;
mod select;
mod simulate;
mod solver;
mod statistics;
mod triangle;
mod unknown;

#[cfg(test)]
mod tests;

pub use design::{Design, d_optimal, predicted, whole};
pub use failure::Failure;
pub use figures::Figures;
pub use fit::{Fit, fit};
pub use folds::{Folds, cross_validate};
pub use groups::{Group, Reason, groups};
pub use identifiable::{Identifiable, THRESHOLD, identifiable};
pub use model::Model;
pub use observation::{Measurement, Observation, Uncertainty};
pub use options::Options;
pub use registration::{Registration, register};
pub use residuals::Room;
pub use robust::{Loss, robust_scale};
pub use select::{Selection, select};
pub use simulate::{Chance, simulate};
pub use statistics::{FTest, Observability, f_test};
pub use unknown::{Role, Unknown};
