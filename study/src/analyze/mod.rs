//! Section 5 of the paper: the effect of each source over a workspace, alone and combined.
//!
//! `job` holds the options, `sweep` evaluates the workspace once, and `report` is the result that
//! `--json` prints. `parts` divides the sweep over several machines, `figures` gathers figure data
//! during the sweep, and `first_order` compares with the exact chain.
//!
//! The other files turn the report into text: `summary` and `verdict` (first sentences), `ledger`
//! and `uncertainty` (tables), `norm_comparison` (certified bounds), `agreement` (published
//! figures), `unreachable` (reasons), `loop_condition` (loops), `singular` (Euler angles),
//! `conclusions` (closing sentences), and `unit` (units). `calibration` is its uncertainty,
//! `compensated` the machine after compensation.

mod agreement;
mod calibration;
mod compensated;
mod conclusions;
pub mod figures;
mod first_order;
mod job;
mod ledger;
mod loop_condition;
mod norm_comparison;
pub mod options;
pub mod parts;
mod report;
mod singular;
mod summary;
mod sweep;
mod uncertainty;
pub mod unit;
mod unreachable;
mod verdict;

pub use first_order::FirstOrder;
pub use job::Analyze;
pub use ledger::{allowance_table, ledger, orientation_ledger};
pub use loop_condition::{LoopCondition, NEARLY_SINGULAR};
pub use norm_comparison::{NOT_CERTIFIED, NormComparison, norm_comparison_table};
pub use report::{
    AfterCompensation, Agreement, CombinedReport, Comparison, CompensatedVerdicts, CompensationBasis,
    ErrorAllowance, Ledger, LedgerEntry, LongestEllipsoid, MachineVerdicts, MonteCarloErrors,
    MonteCarloReport, OrientationReport, OrientationSource, Quantity, Radii, RemainingErrors, Report,
    RootMeanSquares, SourceAllowance, SourceReport, SourceUncertainty, ToleranceVerdict, UncertaintyBudget,
    Verdict, Verdicts,
};
pub use uncertainty::{uncertainty_contributions, uncertainty_sentences, uncertainty_totals};
pub use unreachable::{
    UnreachableReason, first_unreachable, unreachable_reason, unreachable_reasons, unreachable_summary,
};
