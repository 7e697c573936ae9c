//! Report of an analysis.
//!
//! Each file is one part of it: `source_report` holds each source alone and the names of
//! configurations, `combined` all sources, the draws and rows 4–6, `ledger` the ranking and the
//! parts of the sources, `tolerance_verdict` the verdicts, `uncertainty_budget` the budget after
//! the GUM, and `comparison` the published figures.

mod combined;
mod comparison;
mod ledger;
mod source_report;
mod tolerance_verdict;
mod uncertainty_budget;

use std::sync::Arc;

use abbe::analysis::{Budget, Configuration, Extreme, Measurand};
use abbe_spec::{Spec, option::NamedOption};
use serde::Serialize;

pub use combined::{
    CombinedReport, LongestEllipsoid, MonteCarloErrors, MonteCarloReport, OrientationReport,
    OrientationSource, Radii, RootMeanSquares,
};
pub use comparison::{Agreement, Comparison};
pub(super) use ledger::JudgedShares;
pub use ledger::{Ledger, LedgerEntry};
pub(super) use source_report::ErrorSites;
pub use source_report::{Quantity, SourceReport};
pub use tolerance_verdict::{
    CompensatedVerdicts, CompensationBasis, MachineVerdicts, ToleranceVerdict, Verdict, Verdicts,
};
pub(super) use tolerance_verdict::{JudgedErrors, SEED};
pub use uncertainty_budget::{SourceUncertainty, UncertaintyBudget};

use super::{FirstOrder, LoopCondition, UnreachableReason, compensated::CompensatedErrors, figures::Figures};
use crate::bound::CertifiedNorms;
use crate::study_file::{CombinedFigure, Criterion, PublishedResidual, Study, Subject};
use crate::{Extrapolation, RunRecord, number};

/// Errors of the sources over a workspace. Lengths are in the spec's unit, along the axes of `F_0`;
/// angles are in rad.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the manipulator.
    pub manipulator: String,
    /// Number of configurations that were reached and evaluated.
    pub configurations: usize,
    /// Number of configurations that could not be reached.
    pub unreachable: usize,
    /// Changes of the spec by options, in their order.
    #[serde(skip)]
    pub changes: Vec<NamedOption>,
    /// Position errors of each enabled source alone.
    pub sources: Vec<SourceReport>,
    /// Position errors of all sources together.
    pub combined: CombinedReport,
    /// Title of the study.
    #[serde(rename = "study")]
    pub title: String,
    /// Description of the workspace in a sentence.
    pub workspace: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Tolerance of the position error, from the study, in the length unit.
    #[serde(rename = "tolerance", skip_serializing_if = "Option::is_none")]
    pub position_tolerance: Option<f64>,
    /// Verdicts on the tolerances; `None` if the study has none.
    #[serde(rename = "verdict", skip_serializing_if = "Option::is_none")]
    pub verdicts: Option<Verdicts>,
    /// Uncertainty budget of the position after the GUM; `None` if no random source moves the tool
    /// point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyBudget>,
    /// Orientation errors.
    pub orientation: OrientationReport,
    /// Published figures compared with the computed ones.
    #[serde(rename = "published")]
    pub comparisons: Vec<Comparison>,
    /// Published residual after compensation, combined with the computed random errors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after_compensation: Option<AfterCompensation>,
    /// First-order error.
    pub first_order: FirstOrder,
    /// Condition of the loops; absent without loops.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loops: Option<LoopCondition>,
    /// Certified upper bounds on the norms; `None` if the workspace has no enclosing box, or too
    /// many names vary.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub certified: Option<CertifiedNorms>,
    /// Reasons for unreachable configurations, most frequent first.
    pub unreachable_reasons: Vec<UnreachableReason>,
    /// Published figures that cannot be reproduced, one sentence each.
    pub not_reproducible: Vec<String>,
    /// Sources by rank, and their sums.
    pub ledger: Ledger,
    /// Factor for all sources at which the judged position error as built equals the tolerance;
    /// `None` without a tolerance or an error, or if a probability or yield is judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub factor_for_all: Option<f64>,
    /// Errors that remain after the compensation that the study states; `None` if it states none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compensation: Option<RemainingErrors>,
    /// Monte Carlo draws; `None` if they were not requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monte_carlo: Option<MonteCarloReport>,
    /// Configurations outside the fitted ranges, and the uncertainty there; `None` if there are
    /// none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extrapolated: Option<Extrapolation>,
    /// Stated date, and the version of abbe; absent if there is no date.
    #[serde(skip_serializing_if = "RunRecord::is_empty")]
    pub record: RunRecord,

    /// Spec of the manipulator, with all changes.
    #[serde(skip)]
    pub spec: Arc<Spec>,
    /// The study.
    #[serde(skip)]
    pub study: Study,
    /// Home configuration, against which labels of configurations are relative.
    #[serde(skip)]
    pub home: Configuration,
    /// Indices of the inputs that vary over the workspace; the others are nominal.
    #[serde(skip)]
    pub moving_inputs: Vec<usize>,
    /// Budget by index, sources counted as in [`sources`](Self::sources).
    #[serde(skip)]
    pub budget: Budget,
    /// Data of the study's figures; `None` if they were not requested.
    #[serde(skip)]
    pub figures: Option<Figures>,
    #[serde(skip)]
    pub(super) sites: ErrorSites,
}

/// Errors that remain after compensation: the largest norms over the evaluated configurations, in
/// the length unit.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct RemainingErrors {
    /// Norm of the sum of the repeatable errors that are not compensated, + the root sum of squares
    /// of the residuals of the others.
    pub residual: f64,
    /// Residual + norm of the random bounds.
    pub total: f64,
}

impl RemainingErrors {
    pub(super) fn new(swept: &CompensatedErrors) -> Self {
        let position = &swept.extremes[Measurand::Position as usize];
        Self { residual: position.repeatable.value, total: position.radius.value }
    }
}

/// Published residual after compensation, combined with the computed random errors. In the length
/// unit.
#[derive(Clone, Debug, Serialize)]
pub struct AfterCompensation {
    /// Published residual of the repeatable errors.
    pub residual: f64,
    /// Computed random radius.
    pub random: f64,
    /// Sum of both.
    pub total: f64,
    /// The published figures.
    pub published: PublishedResidual,
}

impl AfterCompensation {
    pub(super) fn new(published: &PublishedResidual, budget: &Budget) -> Self {
        let (residual, random) = (published.residual, budget.combined.random_radius.value);
        Self { residual, random, total: residual + random, published: published.clone() }
    }
}

impl Report {
    /// Returns the configuration of a workspace index in the budget.
    pub fn configuration(&self, index: Option<usize>) -> Option<&Configuration> {
        self.sites.get(index).map(|site| &site.configuration)
    }

    /// Returns the label of a configuration on one line; nothing if there is none.
    pub fn label_at(&self, index: Option<usize>) -> String {
        self.configuration(index).map(|found| number::unbroken(&self.label(found))).unwrap_or_default()
    }

    /// Returns the tolerance of a measurand.
    pub fn tolerance(&self, measurand: Measurand) -> Option<f64> {
        match measurand {
            Measurand::Position => self.position_tolerance,
            Measurand::Orientation => self.orientation.tolerance,
        }
    }

    /// Returns the largest error of the machine as built, over the workspace, that the criterion of
    /// the study compares with a tolerance; the worst case if that is a probability.
    pub fn judged_error(&self, measurand: Measurand) -> Extreme {
        let combined = self.budget.errors(measurand).1;
        match self.study.criterion {
            Criterion::RootSumOfSquares => combined.radius,
            _ => combined.worst_case_radius,
        }
    }

    /// Iterates over the uncertainty budgets, position first.
    pub fn uncertainty_budgets(&self) -> impl Iterator<Item = &UncertaintyBudget> {
        self.uncertainty.iter().chain(&self.orientation.uncertainty)
    }

    /// Returns the worst verdict; `None` if the study has no tolerance.
    pub fn verdict(&self) -> Option<Verdict> {
        self.verdicts.as_ref().map(|verdicts| verdicts.verdict)
    }

    /// Returns the comparison with a published figure; `None` if nothing is published or the source
    /// is disabled.
    pub fn published(&self, subject: &Subject) -> Option<&Comparison> {
        self.comparisons.iter().find(|comparison| comparison.subject == *subject)
    }

    /// Returns one of the three combined figures: its components, if it has any, and its norm.
    pub fn combined_figure(&self, figure: CombinedFigure) -> ([Option<f64>; 3], f64) {
        let radii = &self.combined.radii;
        match figure {
            CombinedFigure::Repeatable => (radii.repeatable.map(Some), radii.repeatable_radius),
            CombinedFigure::Random => (radii.random.map(Some), radii.random_radius),
            CombinedFigure::Both => ([None; 3], radii.radius),
        }
    }

    /// Returns the inputs in words: `payload within 0 kg … 5 kg (0 kg at home)`, or `payload = 0
    /// kg` for one that does not vary.
    pub fn inputs(&self) -> Vec<String> {
        let inputs = self.spec.inputs.iter().enumerate().map(|(i, input)| {
            let [home, lower, upper] = [input.value, input.range[0], input.range[1]]
                .map(|value| number::quantity(value, &input.unit));
            match self.moving_inputs.contains(&i) {
                true => format!("{} within {lower} … {upper} ({home} at home)", input.name),
                false => format!("{} = {home}", input.name),
            }
        });
        inputs.collect()
    }

    /// Returns the publisher of the published figures.
    pub fn publisher(&self) -> &str {
        if self.study.publisher.is_empty() { "what is published" } else { &self.study.publisher }
    }

    /// Describes a configuration by its differences from home.
    pub fn label(&self, configuration: &Configuration) -> String {
        number::configuration(configuration, &self.home, &self.spec)
    }
}
