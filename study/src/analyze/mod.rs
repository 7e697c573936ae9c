//! Section 5 of the paper: what every source does over a workspace, alone and together.
//!
//! `job` is the question, `prepared` how it is answered, `parts` the same on several machines, `report` the answer. The sweep runs
//! once; `figures` gathers on the way what the figures show.
//! `first_order` compares with the exact chain, `at_most` with what is certified, `agreement` with published figures;
//! `ledger` ranks the sources, `judged` holds them against the tolerance,
//! `summary` answers in a few sentences and `verdict` says so, `stated` are budgets after the GUM and `uncertainty` their tables,
//! `unreachable` says what could not be had and why, `conclusions` puts the results into sentences; `json` is the report as
//! machines read it.

mod agreement;
mod at_most;
mod conclusions;
pub mod figures;
mod first_order;
mod job;
mod json;
mod judged;
mod ledger;
pub mod parts;
mod prepared;
mod report;
mod source_value;
mod stated;
mod summary;
mod uncertainty;
pub mod unit;
mod unreachable;
mod verdict;

pub use agreement::{Agreement, figures_of};
pub use at_most::{Sampled, at_most};
pub use first_order::FirstOrder;
pub use job::Analyze;
pub use judged::{Judged, Verdict};
pub use ledger::{Entry, allowed, ledger, turns};
pub use report::{Drawn, Report};
pub use stated::Stated;
pub use uncertainty::{contributions, sentences, totals};
pub use unreachable::{Reason, first_few, reason, reasons, summary};
