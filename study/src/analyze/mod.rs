//! Section 5 of the paper: what every source does over a workspace, alone and together.
//!
//! `job` is the question, `sweep` how it is answered, `parts` the same on several machines, `report` the answer, which is what
//! `--json` prints. The sweep runs once; `figures` gathers on the way what the figures show, and `first_order` compares with the
//! exact chain.
//!
//! The others put the report into words: `summary` answers in a few sentences and `verdict` says whether the tolerance is met,
//! `ledger` and `uncertainty` are tables, `at_most` stands beside what is certified, `agreement` beside what is published,
//! `unreachable` says what could not be had and why, `conclusions` puts the results into sentences; `unit` has the units.

mod agreement;
mod at_most;
mod conclusions;
pub mod figures;
mod first_order;
mod job;
mod ledger;
pub mod options;
pub mod parts;
mod report;
mod summary;
mod sweep;
mod uncertainty;
pub mod unit;
mod unreachable;
mod verdict;

pub use at_most::{Sampled, at_most};
pub use first_order::FirstOrder;
pub use job::Analyze;
pub use ledger::{allowed, ledger, turns};
pub use report::{
    AfterCompensation, Agreement, CombinedReport, Comparison, Drawn, DrawnErrors, ErrorAllowance, Ledger,
    LedgerEntry, LongestEllipsoid, OrientationReport, OrientationSource, Quantity, Radii, Report,
    RootMeanSquares, SourceAllowance, SourceReport, SourceUncertainty, ToleranceVerdict, UncertaintyBudget,
    Verdict, Verdicts,
};
pub use uncertainty::{contributions, sentences, totals};
pub use unreachable::{Reason, first_few, reason, reasons, summary};
