//! The question, and how it is answered.

use std::path::PathBuf;

use abbe::Description;
use abbe::analysis::{
    Admissible, Asked, Budget, Measurand, Row, Statement, Subset, Unevaluated, Watch, Workspace,
    error_budget, errors_at, monte_carlo,
};
use abbe_codegen::diagnostic::Diagnostics;

use super::figures::Gathering;
use super::first_order::FirstOrder;
use super::judged::Judged;
use super::report::{Drawn, Places, Report};
use super::stated::Stated;
use super::unreachable;
use crate::changes::Changes;
use crate::extrapolated::extrapolated;
use crate::finite::finite;
use crate::machine::Machine;
use crate::notes::Notes;
use crate::reads::Reads;
use crate::study_file::Study;
use crate::{mistake, number};

/// At how many configurations it is looked whether errors are extrapolated.
const EXTRAPOLATED: usize = 2000;

/// The draws of verdicts and budgets are always the same: they are to be as good as integrals.
pub(super) const SEED: u64 = 0;

/// What does every source do?
#[derive(Clone)]
pub struct Analyze {
    machine: Machine,
    study: Study,
    /// How often all errors are drawn at the worst configuration and at home, if they are to be drawn.
    pub monte_carlo: Option<usize>,
    /// The seed of everything random: the draws, and the study's random samples. That of the study if not given.
    pub seed: Option<u64>,
    /// Whether the spec is run even where there is generated code: the same, slower.
    pub interpret: bool,
    /// Whether to gather what the figures of the study show.
    pub figures: bool,
}

impl Reads for Analyze {
    fn files(&self) -> Vec<PathBuf> {
        [self.machine.files(), self.study.files()].concat()
    }
}

impl Analyze {
    /// Asks that study of a manipulator, with the changes that the study makes to it. What is not known of the magnitudes of
    /// repeatable sources becomes random sources behind the others.
    pub fn new(mut machine: Machine, mut study: Study) -> Self {
        machine.change(&study.changes);
        machine.add_magnitude_errors();
        study.fix(machine.fixed_inputs());
        Self { machine, study, monte_carlo: None, seed: None, interpret: false, figures: false }
    }

    /// Makes further changes. Published figures are of another machine then, and are left out.
    pub fn change(&mut self, changes: &Changes, notes: &mut dyn Notes) {
        if !changes.is_empty() && self.study.forget_published() {
            notes.note("published figures are left out: --set, --enable and --disable make another machine");
        }
        self.machine.change(changes);
        self.machine.add_magnitude_errors();
        self.study.fix(self.machine.fixed_inputs());
    }

    /// The manipulator, with all changes.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Indices of the parameters that the workspace moves.
    pub fn varying(&self) -> Vec<usize> {
        self.study.region.varying(&self.machine.spec)
    }

    /// Indices of the inputs that the workspace moves.
    pub fn moving_inputs(&self) -> Vec<usize> {
        self.study.region.moving_inputs()
    }

    /// Sweeps the workspace.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        self.run_showing(None, notes)
    }

    /// As [`run`](Self::run), and shows every configuration that is reached to `rows`, in order.
    pub fn run_showing(
        &self,
        rows: Option<&mut dyn FnMut(&Row)>,
        notes: &mut dyn Notes,
    ) -> Result<Report, Diagnostics> {
        let Self { machine, study, .. } = self;
        let manipulator = &*machine.evaluator(!self.interpret);
        let description = manipulator.description();
        let workspace = study.region.workspace(manipulator, self.seed);
        let workspace = &*workspace.map_err(|error| mistake::whole(&machine.origin, &error))?;
        let gathering = self.figures.then(|| Gathering::new(study, description));
        notes.progress(0, workspace.len());
        let mut watching = Watching { rows, gathering, notes, total: workspace.len() };
        let residuals = study.compensation.as_ref().map(|left| left.of(description));
        let tolerances = [study.tolerance, study.orientation_tolerance];
        let asked = Asked { residuals: residuals.as_deref(), tolerances };
        let budget = error_budget(manipulator, workspace, asked, &mut watching);
        let Watching { gathering, notes, total, .. } = watching;
        notes.progress(total, total);
        let refused = |refused: Unevaluated| self.not_evaluated(workspace, &refused, description);
        let budget = budget.map_err(refused)?;
        self.require_reached(&budget)?;
        notes.go_on()?;

        let first_order = FirstOrder::over(manipulator, workspace).map_err(refused)?;
        let draw = |draws, index: Option<usize>| {
            let configuration = index.and_then(|index| workspace.configuration(index).ok());
            let configuration = configuration.unwrap_or_else(|| workspace.home().clone());
            monte_carlo(manipulator, &configuration, draws, self.seed.unwrap_or(0))
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
        let drawn = match self.monte_carlo {
            Some(draws) => Some(Drawn {
                seed: self.seed.unwrap_or(0),
                worst: draw(draws, budget.combined.radius.configuration)?,
                home: draw(draws, None)?,
            }),
            None => None,
        };
        notes.go_on()?;
        let gathered = match gathering {
            Some(gathering) => Some(gathering.finish(manipulator, workspace.home(), &machine.spec)?),
            None => None,
        };
        let report = Report {
            spec: machine.spec.clone(),
            study: study.clone(),
            workspace: study.region.describe(&machine.spec),
            home: workspace.home().clone(),
            varying: self.varying(),
            moving_inputs: self.moving_inputs(),
            places: Places::new(&budget, &judged, workspace),
            admissible: study.tolerance.map(|tolerance| Admissible::new(&budget, tolerance)),
            admissible_orientation: study
                .orientation_tolerance
                .map(|tolerance| Admissible::of_measurand(&budget, Measurand::Orientation, tolerance)),
            judged,
            stated,
            budget,
            first_order,
            monte_carlo: drawn,
            figures: gathered,
        };
        report.warn_of_first_order(notes);
        self.warn_of_extrapolation(workspace, notes);
        finite(&machine.origin, report)
    }

    /// Looks at some configurations of a large workspace.
    fn warn_of_extrapolation(&self, workspace: &dyn Workspace, notes: &mut dyn Notes) {
        if self.machine.spec.fitted.is_empty() {
            return;
        }
        let seen = Subset { workspace, count: EXTRAPOLATED }.reached();
        let places = seen.iter().map(|place| (&place.q[..], &place.u[..]));
        let manipulator = self.machine.evaluator(true);
        extrapolated(&self.machine.spec, &*manipulator, "configurations", places, notes);
    }

    fn require_reached(&self, budget: &Budget) -> Result<(), Diagnostics> {
        if budget.configurations > 0 {
            return Ok(());
        }
        let reasons = unreachable::summary(&budget.unreachable, &self.machine.spec);
        let message = format!("no configuration of the workspace can be reached: {reasons}");
        let help = "move or shrink the workspace of the study, or widen the limits of the joints";
        Err(mistake::with_help(&self.machine.origin, message, help))
    }

    fn not_evaluated(
        &self,
        workspace: &dyn Workspace,
        refused: &Unevaluated,
        description: &Description,
    ) -> Diagnostics {
        let at = match refused.configuration.and_then(|index| workspace.configuration(index).ok()) {
            Some(configuration) => {
                number::configuration(&configuration, workspace.home(), &self.machine.spec)
            }
            None => "home".to_owned(),
        };
        mistake::not_evaluated(&self.machine.origin, &at, &refused.error, description)
    }
}

/// Who is shown every configuration, if anybody is, and how far the sweep is.
struct Watching<'r, 'n, 'g> {
    rows: Option<&'r mut dyn FnMut(&Row)>,
    gathering: Option<Gathering<'g>>,
    notes: &'n mut dyn Notes,
    total: usize,
}

impl Watch for Watching<'_, '_, '_> {
    fn rows(&self) -> bool {
        self.rows.is_some() || self.gathering.is_some()
    }

    fn row(&mut self, row: &Row) {
        self.rows.iter_mut().for_each(|show| show(row));
        self.gathering.iter_mut().for_each(|gathering| gathering.add(row));
    }

    fn done(&mut self, before: usize) {
        self.notes.progress(before, self.total);
    }
}
