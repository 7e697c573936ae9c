//! Section 5 of the paper: the effect of each source over a workspace, alone and combined.
//!
//! `job` holds the options, `sweep` evaluates the workspace once, and `report` is the result that
//! `--json` prints. `parts` divides the sweep over several machines, `figures` gathers figure data
//! during the sweep, and `first_order` compares with the exact chain.
//!
//! `unreachable` has the reasons and the state of loops, and `singular` the Euler angles.
//! `errors_with_parts` are those of several sources, `compensated` the machine after compensation,
//! and `judgement` holds both machines against the tolerances.

mod compensated;
mod errors_with_parts;
pub mod figures;
mod first_order;
mod job;
mod judgement;
pub mod options;
pub mod parts;
mod report;
mod singular;
mod sweep;
mod unreachable;

pub use first_order::FirstOrder;
pub use job::Analyze;
pub use unreachable::{
    LoopCondition, NEARLY_SINGULAR, UnreachableReason, unreachable_reason, unreachable_reasons,
    unreachable_summary,
};

/// Reason why nothing is certified of machines that are not a chain.
pub const NOT_CERTIFIED: &str = "`abbe bound` proves a bound, which takes longer";
pub use report::{
    AfterCompensation, Agreement, CombinedReport, Comparison, CompensatedVerdicts, CompensationBasis, Ledger,
    LedgerEntry, LongestEllipsoid, MachineVerdicts, MonteCarloErrors, MonteCarloReport, OrientationReport,
    OrientationSource, Quantity, Radii, RemainingErrors, Report, RootMeanSquares, SourceReport,
    SourceUncertainty, ToleranceVerdict, UncertaintyBudget, Verdict, Verdicts,
};
