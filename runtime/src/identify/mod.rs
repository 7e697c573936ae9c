//! Generalized errors from measurements: section 6 of the paper, and the algorithm that it leaves out.
//!
//! An [`Observation`] is what an instrument saw at one configuration. A [`Model`] says which numbers are unknown and
//! gives residuals and their exact derivatives on the real chain, equation (6). [`what_can_be_known`] finds which of
//! them the data determine and what the others are grouped with, [`groups()`] the same from the joint twists alone;
//! [`fit`] solves, [`cross_validate`] tests on data left out, [`select`] adds richer terms that earn their place.
//! [`d_optimal`] chooses where to measure, [`simulate()`] measures a machine whose errors are known.

mod columns;
mod data;
mod design;
mod figures;
mod folds;
mod groups;
mod known;
mod model;
mod registration;
mod robust;
mod select;
mod simulate;
mod solve;
mod statistics;
mod triangle;

#[cfg(test)]
mod tests;

pub use data::{Observation, Seen, Uncertainty};
pub use design::{Design, d_optimal, predicted, whole};
pub use figures::Figures;
pub use folds::{Folds, cross_validate};
pub use groups::{Group, Reason, groups};
pub use known::{Known, THRESHOLD, what_can_be_known};
pub use model::{Model, Role, Unknown};
pub use registration::{Registration, register};
pub use robust::{Loss, robust_scale};
pub use select::{Candidate, Selection, select};
pub use simulate::{Chance, simulate};
pub use solve::{Failure, Fit, Options, fit};
pub use statistics::{FTest, Observability, f_test};
