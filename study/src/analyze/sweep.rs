//! The sweep over the workspace: data gathered chunk by chunk, and the report on all of it.

use abbe_spec::option::{MONTE_CARLO, Q};
use std::ops::Range;

use abbe::analysis::{
    Budget, BudgetSweep, Configuration, ErrorParts, Measurand, PartialBudget, Row, Statement, Subset,
    Sweepable, Unevaluated, Watch, Workspace, errors_at, monte_carlo,
};
use abbe_spec::{Diagnostics, Spec};
use serde::{Deserialize, Serialize};

use super::errors_with_parts::LargestWithParts;
use super::figures::{Figures, FiguresBuilder, PartialFigure};
use super::report::{
    AfterCompensation, CombinedReport, Comparison, CompensationBasis, ErrorSites, Ledger, MonteCarloErrors,
    MonteCarloReport, OrientationReport, RemainingErrors, Report, SEED, SourceReport, UncertaintyBudget,
};
use super::{FirstOrder, LoopCondition, unreachable};
use crate::bound::CertifiedNorms;
use crate::calibration::named_as_one;
use crate::extrapolation::{Extrapolation, warn_of_extrapolation};
use crate::workspace::{Form, in_one_run};
use crate::{Machine, Notes, Result, RunRecord, Study, finite, mistake, number};

/// Largest number of configurations that are checked for extrapolation.
const EXTRAPOLATED: usize = 2000;

/// Data gathered over some chunks of a workspace.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct PartialAnalysis {
    /// Data of the error sources.
    pub(super) budget: PartialBudget,
    /// Errors with several parts.
    with_parts: LargestWithParts,
    /// Data of the figures; `None` if they were not requested.
    figures: Option<Vec<PartialFigure>>,
}

/// Sweep over the workspace of a study.
pub(super) struct AnalysisSweep<'a> {
    pub(super) machine: &'a Machine,
    pub(super) study: &'a Study,
    pub(super) monte_carlo: Option<usize>,
    pub(super) seed: u64,
    /// Options that the figures depend on.
    pub(super) options: Vec<(&'static str, String)>,
    /// Gathers the data of the study's figures.
    pub(super) figures: bool,
    pub(super) manipulator: &'a dyn Sweepable,
    pub(super) workspace: &'a dyn Workspace,
    pub(super) budget: BudgetSweep<'a>,
}

impl AnalysisSweep<'_> {
    /// Sweeps some chunks of the workspace.
    pub(super) fn run(
        &self,
        chunks: Range<usize>,
        rows: Option<&mut dyn FnMut(&Row)>,
        notes: &mut dyn Notes,
    ) -> Result<PartialAnalysis> {
        let range = self.budget.configurations(&chunks);
        in_one_run(range.len(), &self.machine.origin)?;
        let builder = self.figures.then(|| FiguresBuilder::new(self.study, self.manipulator.description()));
        notes.progress(0, range.len());
        let parts = self.parts();
        let with_parts = LargestWithParts::new(&parts);
        let mut observer = SweepObserver { rows, with_parts, parts, builder, notes, range: range.clone() };
        let budget = self.budget.part(chunks, &mut observer);
        let SweepObserver { with_parts, builder, notes, .. } = observer;
        notes.progress(range.len(), range.len());
        let budget = budget.map_err(|refused| self.not_evaluated(&refused))?;
        // An interrupted sweep returns an incomplete part; do not use it.
        notes.go_on()?;
        Ok(PartialAnalysis { budget, with_parts, figures: builder.map(FiguresBuilder::data) })
    }

    fn parts(&self) -> ErrorParts {
        ErrorParts::new(self.manipulator.description())
    }

    /// Returns whether data can belong to this sweep. They may come from a file.
    pub(super) fn fits(&self, data: &PartialAnalysis) -> bool {
        data.with_parts.fits(&self.parts(), self.workspace.len()) && self.budget.fits(&data.budget)
    }

    /// Appends the data of the chunks that follow. Returns false if they do not follow or have
    /// other figures.
    pub(super) fn append(&self, all: &mut PartialAnalysis, next: PartialAnalysis) -> bool {
        let figures = match (all.figures.take(), next.figures) {
            (None, None) => Some(None),
            (Some(here), Some(next)) => {
                let mut builder = FiguresBuilder::new(self.study, self.manipulator.description());
                (builder.append(here) && builder.append(next)).then(|| Some(builder.data()))
            }
            _ => None,
        };
        let Some(figures) = figures else { return false };
        all.figures = figures;
        all.with_parts.append(&next.with_parts);
        all.budget.append(next.budget).is_ok()
    }

    /// Returns the report on all gathered data.
    pub(super) fn report(&self, data: PartialAnalysis, notes: &mut dyn Notes) -> Result<Report> {
        let Self { machine, study, manipulator, workspace, .. } = *self;
        let spec = &named_as_one(&machine.spec);
        let mut budget = self.budget.finish(data.budget);
        data.with_parts.replace_parts(&mut budget, &self.parts());
        self.require_reached(&budget)?;
        self.require_oriented(&budget)?;
        notes.go_on()?;

        let first_order = FirstOrder::compare(manipulator, workspace);
        let first_order = first_order.map_err(|refused| self.not_evaluated(&refused))?;
        let moving_inputs = study.region.moving_inputs();
        let compensated = self.compensated()?;
        let others = compensated.iter().flat_map(|(_, swept)| swept.indices());
        let varying = study.region.varying(spec);
        let sites = ErrorSites::new(&budget, workspace, spec, &varying, &moving_inputs, others);
        let stated = compensated.as_ref().filter(|(basis, _)| *basis == CompensationBasis::Stated);
        let compensation = stated.map(|(_, swept)| RemainingErrors::new(swept));
        let verdicts = self.verdicts(&budget, &sites, compensated)?;
        let [judged, turned_judged] = self.shares(&budget, verdicts.as_ref())?;
        let allocation = verdicts.as_ref().and_then(|verdicts| self.allocation(verdicts));
        let uncertainty = self.uncertainty(&budget, &sites, (spec, Measurand::Position))?;
        let turned = self.uncertainty(&budget, &sites, (spec, Measurand::Orientation))?;
        let monte_carlo = self.draw_errors(&budget, &sites, notes)?;
        let certified = CertifiedNorms::certify(machine, study, notes);
        notes.go_on()?;
        let figures = data.figures.map(|data| self.finish_figures(data)).transpose()?;
        let sources = SourceReport::all(&budget, spec, &sites);
        let tolerance = study.tolerance;
        let report = Report {
            manipulator: spec.name.clone(),
            configurations: budget.configurations,
            changes: machine.stated_changes().collect(),
            unreachable: budget.unreachable.count,
            combined: CombinedReport::new(&budget.combined, &sites),
            title: study.title.clone(),
            workspace: study.region.describe(spec),
            length: spec.length.symbol(),
            position_tolerance: tolerance,
            verdicts,
            uncertainty,
            orientation: OrientationReport::new(
                &budget,
                spec,
                &sites,
                (study.orientation_tolerance, &turned_judged),
                turned,
            ),
            comparisons: Comparison::all(&study.published, &sources, &budget.combined),
            after_compensation: study.compensated.as_ref().map(|left| AfterCompensation::new(left, &budget)),
            first_order,
            loops: LoopCondition::new(spec, manipulator, workspace),
            certified,
            unreachable_reasons: unreachable::unreachable_reasons(&budget.unreachable, spec),
            not_reproducible: study.not_reproducible.clone(),
            ledger: Ledger::new(&budget, &sources, tolerance, &judged, allocation.as_ref()),
            factor_for_all: judged.factor_for_all,
            compensation,
            monte_carlo,
            extrapolated: None,
            record: RunRecord::default().with_options(self.options.clone()),
            sources,
            spec: spec.clone(),
            study: study.clone(),
            home: workspace.home().clone(),
            moving_inputs,
            budget,
            figures,
            sites,
        };
        self.warn_of_first_order(first_order, notes);
        let report = Report { extrapolated: self.warn_of_calibration(notes), ..report };
        finite(&machine.origin, report)
    }

    /// Returns the uncertainty budget at the configuration with the largest standard uncertainty;
    /// `None` if there is no random error.
    fn uncertainty(
        &self,
        budget: &Budget,
        sites: &ErrorSites,
        (spec, measurand): (&Spec, Measurand),
    ) -> Result<Option<UncertaintyBudget>> {
        let largest = budget.errors(measurand).1.standard_radius;
        if largest.value == 0.0 {
            return Ok(None);
        }
        let errors =
            self.at(largest.configuration, |configuration| errors_at(self.manipulator, configuration))?;
        let statement = Statement::new(&errors, measurand, SEED);
        Ok(Some(UncertaintyBudget::new(&statement, largest.configuration, spec, sites)))
    }

    /// Draws errors at the configuration with the largest radius and at home; `None` if no draws
    /// were requested.
    fn draw_errors(
        &self,
        budget: &Budget,
        sites: &ErrorSites,
        notes: &mut dyn Notes,
    ) -> Result<Option<MonteCarloReport>> {
        let Some(draws) = self.monte_carlo else { return Ok(None) };
        let draw = |index| {
            let errors = self
                .at(index, |configuration| monte_carlo(self.manipulator, configuration, draws, self.seed))?;
            Ok::<_, Diagnostics>(MonteCarloErrors::new(sites.get(index).unwrap_or(&sites.home), errors))
        };
        notes.progress(0, 2 * draws);
        let worst = draw(budget.combined.radius.configuration)?;
        notes.progress(draws, 2 * draws);
        notes.go_on()?;
        let home = draw(None)?;
        notes.progress(2 * draws, 2 * draws);
        Ok(Some(MonteCarloReport { draws, seed: self.seed, worst, home }))
    }

    fn finish_figures(&self, data: Vec<PartialFigure>) -> Result<Figures> {
        let Self { machine, study, manipulator, workspace, .. } = *self;
        let mut builder = FiguresBuilder::new(study, manipulator.description());
        if !builder.append(data) {
            let message = "the figures of this part are not those of the study";
            return Err(mistake::with_help(&machine.origin, message, "create all parts again"));
        }
        builder.finish(manipulator, workspace.home(), &machine.spec)
    }

    /// Evaluates a function at a configuration of the workspace, or at home if there is no index.
    pub(super) fn at<T>(
        &self,
        index: Option<usize>,
        evaluate: impl FnOnce(&Configuration) -> Result<T, abbe::Error>,
    ) -> Result<T> {
        let configuration = index.and_then(|index| self.workspace.configuration(index).ok());
        evaluate(configuration.as_ref().unwrap_or_else(|| self.workspace.home()))
            .map_err(|error| self.not_evaluated(&Unevaluated { configuration: index, error }))
    }

    fn require_reached(&self, budget: &Budget) -> Result<()> {
        if budget.configurations > 0 {
            return Ok(());
        }
        let reasons = unreachable::unreachable_summary(&budget.unreachable, &self.machine.spec);
        let (what, help) = match self.study.region.form {
            Form::One(_) => {
                (format!("the configuration of {Q} is not"), "change it, or widen the limits of the joints")
            }
            _ => (
                "no configuration of the workspace is".to_owned(),
                "move or shrink the workspace of the study, or widen the limits of the joints",
            ),
        };
        Err(mistake::with_help(&self.machine.origin, format!("{what} reachable: {reasons}"), help))
    }

    /// Fails if the study limits an orientation error that exists at no configuration.
    fn require_oriented(&self, budget: &Budget) -> Result<()> {
        if budget.orientation.configurations > 0 || self.study.orientation_tolerance.is_none() {
            return Ok(());
        }
        let message = "Euler angles are singular at every configuration: there is no orientation error to \
                       compare with the tolerance";
        let help = "write `orientation = \"rotation-vector\"` in [manipulator]: it has no singularity";
        Err(mistake::with_help(&self.machine.origin, message, help))
    }

    /// Warns if the first-order error exceeds a tenth of the tolerance.
    fn warn_of_first_order(&self, FirstOrder { largest: neglected, .. }: FirstOrder, notes: &mut dyn Notes) {
        let length = |value| number::length(value, self.machine.spec.length);
        if let Some(tolerance) = self.study.tolerance.filter(|tolerance| neglected > tolerance / 10.0) {
            notes.warn(&format!(
                "first order differs from the exact chain by up to {}, more than a tenth of the \
                 tolerance of {}; see {MONTE_CARLO}",
                length(neglected),
                length(tolerance),
            ));
        }
    }

    /// Warns of extrapolation, checked at some configurations of a large workspace.
    fn warn_of_calibration(&self, notes: &mut dyn Notes) -> Option<Extrapolation> {
        let Self { machine, workspace, .. } = *self;
        if machine.spec.fitted.is_empty() {
            return None;
        }
        let reached = Subset { workspace, count: EXTRAPOLATED }.reached();
        let configurations = reached.iter().map(|reached| (&reached.q[..], &reached.u[..]));
        let evaluator = machine.evaluator(true);
        warn_of_extrapolation(
            &machine.spec,
            &*evaluator,
            &[[0.0; 3]],
            "configurations",
            configurations,
            notes,
        )
    }

    pub(super) fn not_evaluated(&self, refused: &Unevaluated) -> Diagnostics {
        self.machine.not_evaluated(self.workspace, refused, self.manipulator.description())
    }
}

/// Observer of the sweep: passes each configuration on, and reports progress.
struct SweepObserver<'r, 'n, 'g> {
    rows: Option<&'r mut dyn FnMut(&Row)>,
    with_parts: LargestWithParts,
    parts: ErrorParts,
    builder: Option<FiguresBuilder<'g>>,
    notes: &'n mut dyn Notes,
    /// Indices of the configurations of this sweep.
    range: Range<usize>,
}

impl Watch for SweepObserver<'_, '_, '_> {
    fn rows(&self) -> bool {
        self.rows.is_some() || !self.with_parts.is_empty() || self.builder.is_some()
    }

    fn row(&mut self, row: &Row) {
        self.rows.iter_mut().for_each(|show| show(row));
        self.with_parts.add(row, &self.parts);
        self.builder.iter_mut().for_each(|builder| builder.add(row));
    }

    fn done(&mut self, before: usize) -> bool {
        self.notes.progress(before - self.range.start, self.range.len());
        !self.notes.stop()
    }
}
