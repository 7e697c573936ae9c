//! A job that is being done: what is gathered chunk by chunk, and the report of all of it.

use std::ops::Range;

use abbe::analysis::{
    Admissible, BudgetPart, Measurand, Row, Statement, Survey, Sweepable, Unevaluated, Watch, Workspace,
    errors_at, monte_carlo,
};
use abbe_spec::diagnostic::Diagnostics;
use serde::{Deserialize, Serialize};

use super::Analyze;
use super::figures::{Data, Figures, Gathering};
use super::first_order::FirstOrder;
use super::judged::Judged;
use super::report::{Drawn, Places, Report};
use super::stated::Stated;
use crate::bound::Norms;
use crate::finite::finite;
use crate::mistake;
use crate::notes::Notes;

/// The draws of verdicts and budgets are always the same: they are to be as good as integrals.
pub(super) const SEED: u64 = 0;

/// What was gathered over some chunks of a workspace.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Gathered {
    /// Of the sources.
    pub(super) budget: BudgetPart,
    /// For the figures, if they are asked for.
    figures: Option<Vec<Data>>,
}

/// A job that is being done.
pub(super) struct Prepared<'a> {
    pub(super) job: &'a Analyze,
    pub(super) manipulator: &'a dyn Sweepable,
    pub(super) workspace: &'a dyn Workspace,
    pub(super) tolerances: [Option<f64>; 2],
    pub(super) survey: Survey<'a>,
}

impl Prepared<'_> {
    /// Sweeps some chunks of the workspace.
    pub(super) fn gather(
        &self,
        chunks: Range<usize>,
        rows: Option<&mut dyn FnMut(&Row)>,
        notes: &mut dyn Notes,
    ) -> Result<Gathered, Diagnostics> {
        let Self { job, manipulator, workspace, survey, .. } = self;
        let range = survey.configurations(&chunks);
        let description = manipulator.description();
        let gathering = job.figures.then(|| Gathering::new(&job.study, description));
        notes.progress(0, range.len());
        let mut watching = Watching { rows, gathering, notes, range: range.clone() };
        let budget = survey.part(chunks, &mut watching);
        let Watching { gathering, notes, .. } = watching;
        notes.progress(range.len(), range.len());
        let budget = budget.map_err(|refused| job.not_evaluated(*workspace, &refused, description))?;
        // Of a sweep that was stopped there is a part.
        notes.go_on()?;
        Ok(Gathered { budget, figures: gathering.map(Gathering::data) })
    }

    /// Takes in what follows; says whether it does, and is of the same figures.
    pub(super) fn append(&self, all: &mut Gathered, next: Gathered) -> bool {
        let figures = match (all.figures.take(), next.figures) {
            (None, None) => Some(None),
            (Some(here), Some(next)) => {
                let mut gathering = Gathering::new(&self.job.study, self.manipulator.description());
                (gathering.append(here) && gathering.append(next)).then(|| Some(gathering.data()))
            }
            _ => None,
        };
        let Some(figures) = figures else { return false };
        all.figures = figures;
        all.budget.append(next.budget).is_ok()
    }

    fn figures(&self, data: Vec<Data>) -> Result<Figures, Diagnostics> {
        let Self { job, manipulator, workspace, .. } = self;
        let mut gathering = Gathering::new(&job.study, manipulator.description());
        if !gathering.append(data) {
            let message = "the figures are not those of the study";
            return Err(mistake::with_help(&job.machine.origin, message, "make all parts again"));
        }
        gathering.finish(*manipulator, workspace.home(), &job.machine.spec)
    }

    /// The report of all that was gathered.
    pub(super) fn report(
        &self,
        Gathered { budget, figures }: Gathered,
        notes: &mut dyn Notes,
    ) -> Result<Report, Diagnostics> {
        let Self { job, manipulator, workspace, tolerances, ref survey } = *self;
        let Analyze { machine, study, .. } = job;
        let description = manipulator.description();
        let refused = |refused: Unevaluated| job.not_evaluated(workspace, &refused, description);
        let budget = survey.finish(budget);
        job.require_reached(&budget)?;
        notes.go_on()?;

        let first_order = FirstOrder::over(manipulator, workspace).map_err(refused)?;
        let draw = |draws, index: Option<usize>| {
            let configuration = index.and_then(|index| workspace.configuration(index).ok());
            let configuration = configuration.unwrap_or_else(|| workspace.home().clone());
            monte_carlo(manipulator, &configuration, draws, job.seed.unwrap_or(0))
                .map_err(|error| refused(Unevaluated { configuration: index, error }))
        };
        let at = |index: Option<usize>| {
            let configuration = index.and_then(|index| workspace.configuration(index).ok());
            let configuration = configuration.unwrap_or_else(|| workspace.home().clone());
            errors_at(manipulator, &configuration)
                .map_err(|error| refused(Unevaluated { configuration: index, error }))
        };
        let mut judged = Vec::new();
        for (measurand, tolerance) in Measurand::ALL.into_iter().zip(tolerances) {
            if let Some(tolerance) = tolerance {
                judged.push(Judged::new(&budget, measurand, (tolerance, study.probability), at)?);
            }
        }
        let mut stated = Vec::new();
        for measurand in Measurand::ALL {
            let largest = budget.errors(measurand).1.standard_radius;
            if largest.value > 0.0 {
                let statement = Statement::new(&at(largest.configuration)?, measurand, SEED);
                stated.push(Stated { statement, configuration: largest.configuration });
            }
        }
        let drawn = match job.monte_carlo {
            Some(draws) => {
                notes.progress(0, 2 * draws);
                let worst = draw(draws, budget.combined.radius.configuration)?;
                notes.progress(draws, 2 * draws);
                notes.go_on()?;
                let home = draw(draws, None)?;
                notes.progress(2 * draws, 2 * draws);
                Some(Drawn { seed: job.seed.unwrap_or(0), worst, home })
            }
            None => None,
        };
        let certified = Norms::over(machine, study, notes);
        notes.go_on()?;
        let figures = figures.map(|data| self.figures(data)).transpose()?;
        let report = Report {
            spec: machine.spec.clone(),
            study: study.clone(),
            workspace: study.region.describe(&machine.spec),
            home: workspace.home().clone(),
            varying: job.varying(),
            moving_inputs: job.moving_inputs(),
            places: Places::new(&budget, &judged, workspace),
            admissible: study.tolerance.map(|tolerance| Admissible::new(&budget, tolerance)),
            admissible_orientation: study
                .orientation_tolerance
                .map(|tolerance| Admissible::of_measurand(&budget, Measurand::Orientation, tolerance)),
            judged,
            stated,
            budget,
            first_order,
            certified,
            monte_carlo: drawn,
            figures,
        };
        report.warn_of_first_order(notes);
        job.warn_of_extrapolation(workspace, notes);
        finite(&machine.origin, report)
    }
}

/// Who is shown every configuration, if anybody is, and how far the sweep is.
struct Watching<'r, 'n, 'g> {
    rows: Option<&'r mut dyn FnMut(&Row)>,
    gathering: Option<Gathering<'g>>,
    notes: &'n mut dyn Notes,
    /// The configurations that are looked at.
    range: Range<usize>,
}

impl Watch for Watching<'_, '_, '_> {
    fn rows(&self) -> bool {
        self.rows.is_some() || self.gathering.is_some()
    }

    fn row(&mut self, row: &Row) {
        self.rows.iter_mut().for_each(|show| show(row));
        self.gathering.iter_mut().for_each(|gathering| gathering.add(row));
    }

    fn done(&mut self, before: usize) -> bool {
        self.notes.progress(before - self.range.start, self.range.len());
        !self.notes.stop()
    }
}
