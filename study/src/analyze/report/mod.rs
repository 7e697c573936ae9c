//! The answer: what was found over a workspace.
//!
//! Each file is one part of it, with the names of sources and of `error_sites`: `source_report` each source alone, `combined` all
//! together, `orientation` rows 4–6, `ledger` the ranks, `error_allowance` the budget backwards, `tolerance_verdict` the verdict,
//! `uncertainty_budget` the budget after the GUM with `source_value`, `comparison` what is published, `drawn` Monte Carlo.

mod combined;
mod comparison;
mod drawn;
mod error_allowance;
mod error_sites;
mod ledger;
mod orientation;
mod source_report;
mod source_value;
mod tolerance_verdict;
mod uncertainty_budget;

use std::sync::Arc;

use abbe::analysis::{Budget, Configuration, Measurand, RemainingErrors};
use abbe_spec::Spec;
use serde::{Serialize, Serializer};

pub use combined::{CombinedReport, LongestEllipsoid, Radii, RootMeanSquares};
pub use comparison::{Agreement, Comparison};
pub use drawn::{Drawn, DrawnErrors};
pub use error_allowance::{ErrorAllowance, SourceAllowance};
pub(super) use error_sites::ErrorSites;
pub use ledger::{Ledger, LedgerEntry};
pub use orientation::{OrientationReport, OrientationSource};
pub use source_report::SourceReport;
pub use source_value::Quantity;
pub(super) use tolerance_verdict::SEED;
pub use tolerance_verdict::{ToleranceVerdict, Verdict, Verdicts};
pub use uncertainty_budget::{SourceUncertainty, UncertaintyBudget};

use super::figures::Figures;
use super::first_order::FirstOrder;
use super::unreachable::Reason;
use crate::bound::Norms;
use crate::number;
use crate::study_file::{CombinedFigure, PublishedResidual, Study, Subject};

/// What the sources do over a workspace. Lengths in the spec's unit and along the axes of `F_0`, angles in rad.
///
/// Serialized it is what `abbe analyze --json` prints.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the manipulator.
    pub manipulator: String,
    /// Number of configurations that were reached and evaluated.
    pub configurations: usize,
    /// Number of configurations that could not be reached.
    pub unreachable: usize,
    /// Position errors of each source alone. These are the sources that are switched on.
    pub sources: Vec<SourceReport>,
    /// Position errors of all sources together.
    pub combined: CombinedReport,
    /// Title of the study.
    #[serde(rename = "study")]
    pub title: String,
    /// The workspace in a sentence.
    pub workspace: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// The study's tolerance of the position error.
    #[serde(rename = "tolerance", skip_serializing_if = "Option::is_none")]
    pub position_tolerance: Option<f64>,
    /// Verdicts on the tolerances of the study; none if it has no tolerance.
    #[serde(rename = "verdict", skip_serializing_if = "Option::is_none")]
    pub verdicts: Option<Verdicts>,
    /// Uncertainty budget of the position after the GUM; none if no random source moves the tool point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyBudget>,
    /// Errors of the orientation.
    pub orientation: OrientationReport,
    /// Published figures beside ours.
    #[serde(rename = "published")]
    pub comparisons: Vec<Comparison>,
    /// The published residual after compensation, with our random errors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after_compensation: Option<AfterCompensation>,
    /// What first order neglects.
    pub first_order: FirstOrder,
    /// What the norms of all errors are at most; none if the workspace has no box, or too many names move.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub certified: Option<Norms>,
    /// Reasons why configurations could not be reached, the most frequent first.
    pub unreachable_reasons: Vec<Reason>,
    /// What cannot be reproduced of what was published, one sentence each.
    pub not_reproducible: Vec<String>,
    /// The sources by rank, and their sums.
    pub ledger: Ledger,
    /// What the tolerance of the position allows.
    #[serde(rename = "budget", skip_serializing_if = "Option::is_none")]
    pub allowance: Option<ErrorAllowance>,
    /// What compensation leaves, if the study asks for it.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "values")]
    pub compensation: Option<RemainingErrors>,
    /// What was drawn, if it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub monte_carlo: Option<Drawn>,

    /// The manipulator, with all changes.
    #[serde(skip)]
    pub spec: Arc<Spec>,
    /// The study that was asked for.
    #[serde(skip)]
    pub study: Study,
    /// The home configuration, with which those of the workspace are compared.
    #[serde(skip)]
    pub home: Configuration,
    /// Indices of the inputs that the workspace moves; the others are nominal.
    #[serde(skip)]
    pub moving_inputs: Vec<usize>,
    /// Every source alone, and all together, by index: sources are counted as in [`sources`](Self::sources).
    #[serde(skip)]
    pub budget: Budget,
    /// What the figures of the study show, if it was asked for.
    #[serde(skip)]
    pub figures: Option<Figures>,
    #[serde(skip)]
    pub(super) sites: ErrorSites,
}

/// The published residual after compensation, with our random errors.
#[derive(Clone, Debug, Serialize)]
pub struct AfterCompensation {
    /// The published residual of the repeatable errors.
    pub residual: f64,
    /// Our random errors.
    pub random: f64,
    /// Both, added.
    pub total: f64,
    /// What is published.
    pub published: PublishedResidual,
}

impl AfterCompensation {
    pub(super) fn new(published: &PublishedResidual, budget: &Budget) -> Self {
        let (residual, random) = (published.residual, budget.combined.random_radius.value);
        Self { residual, random, total: residual + random, published: published.clone() }
    }
}

fn values<S: Serializer>(left: &Option<RemainingErrors>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(left.iter().flat_map(|left| {
        [("residual", left.residual), ("residual_sum", left.residual_sum), ("total", left.total)]
            .map(|(name, extreme)| (name, extreme.value))
    }))
}

impl Report {
    /// The configuration of an index of the budget.
    pub fn configuration(&self, index: Option<usize>) -> Option<&Configuration> {
        self.sites.get(index).map(|site| &site.configuration)
    }

    /// The tolerance of a measurand.
    pub fn tolerance(&self, measurand: Measurand) -> Option<f64> {
        match measurand {
            Measurand::Position => self.position_tolerance,
            Measurand::Orientation => self.orientation.tolerance,
        }
    }

    /// What it allows.
    pub fn allowance(&self, measurand: Measurand) -> Option<&ErrorAllowance> {
        match measurand {
            Measurand::Position => self.allowance.as_ref(),
            Measurand::Orientation => self.orientation.allowance.as_ref(),
        }
    }

    /// The uncertainty budgets, that of position first.
    pub fn uncertainty_budgets(&self) -> impl Iterator<Item = &UncertaintyBudget> {
        self.uncertainty.iter().chain(&self.orientation.uncertainty)
    }

    /// The worst verdict on the tolerances of the study; none if it has no tolerance.
    pub fn verdict(&self) -> Option<Verdict> {
        self.verdicts.as_ref().map(|verdicts| verdicts.verdict)
    }

    /// What is published on something; none of a source that is switched off.
    pub fn published(&self, subject: &Subject) -> Option<&Comparison> {
        self.comparisons.iter().find(|comparison| comparison.subject == *subject)
    }

    /// One of the three figures of all sources together; the radius has no components.
    pub fn combined_figure(&self, figure: CombinedFigure) -> ([Option<f64>; 3], f64) {
        let radii = &self.combined.radii;
        match figure {
            CombinedFigure::Repeatable => (radii.repeatable.map(Some), radii.repeatable_radius),
            CombinedFigure::Random => (radii.random.map(Some), radii.random_radius),
            CombinedFigure::Both => ([None; 3], radii.radius),
        }
    }

    /// The inputs in words: `payload within 0 kg … 5 kg (0 kg at home)`, or `payload = 0 kg` of one that does not move.
    pub fn inputs(&self) -> Vec<String> {
        let inputs = self.spec.inputs.iter().enumerate();
        let inputs = inputs.map(|(i, input)| {
            let [home, lower, upper] = [input.value, input.range[0], input.range[1]]
                .map(|value| number::quantity(value, &input.unit));
            match self.moving_inputs.contains(&i) {
                true => format!("{} within {lower} … {upper} ({home} at home)", input.name),
                false => format!("{} = {home}", input.name),
            }
        });
        inputs.collect()
    }

    /// Who printed the published figures.
    pub fn publisher(&self) -> &str {
        if self.study.publisher.is_empty() { "what is published" } else { &self.study.publisher }
    }

    /// What is not at home at a configuration.
    pub fn label(&self, configuration: &Configuration) -> String {
        number::configuration(configuration, &self.home, &self.spec)
    }
}
