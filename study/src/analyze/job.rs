//! The question, and how it is answered.

use std::ops::Range;
use std::path::PathBuf;

use abbe::analysis::{Asked, Budget, Row, Subset, Survey, Unevaluated, Workspace};
use abbe_spec::diagnostic::Diagnostics;

use super::parts::Shard;
use super::prepared::{Gathered, Prepared};
use super::report::Report;
use super::unreachable;
use crate::changes::Changes;
use crate::extrapolated::extrapolated;
use crate::machine::Machine;
use crate::notes::Notes;
use crate::reads::Reads;
use crate::study_file::Study;
use crate::{mistake, number};

/// At how many configurations it is looked whether errors are extrapolated.
const EXTRAPOLATED: usize = 2000;

/// What does every source do?
#[derive(Clone)]
pub struct Analyze {
    pub(super) machine: Machine,
    pub(super) study: Study,
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

    /// The study, but for inputs that are set.
    pub fn study(&self) -> &Study {
        &self.study
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
        self.prepared(notes, |prepared, notes| {
            let gathered = prepared.gather(0..prepared.survey.chunks(), rows, notes)?;
            prepared.report(gathered, notes)
        })
    }

    /// Sweeps some of the chunks of the workspace, of which there are as many as `chunks` is told.
    pub(super) fn gather(
        &self,
        chunks: impl FnOnce(usize) -> Range<usize>,
        notes: &mut dyn Notes,
    ) -> Result<Gathered, Diagnostics> {
        self.prepared(notes, |prepared, notes| prepared.gather(chunks(prepared.survey.chunks()), None, notes))
    }

    /// The report of what was gathered, shard after shard.
    pub(super) fn finish(
        &self,
        parts: Vec<(String, Shard, Gathered)>,
        notes: &mut dyn Notes,
    ) -> Result<Report, Diagnostics> {
        self.prepared(notes, |prepared, notes| {
            let mut all: Option<Gathered> = None;
            for (name, shard, part) in parts {
                let fits = part.budget.chunks() == shard.chunks(prepared.survey.chunks())
                    && prepared.survey.fits(&part.budget);
                let put = match &mut all {
                    Some(all) => fits && prepared.append(all, part),
                    None => {
                        all = Some(part);
                        fits
                    }
                };
                if !put {
                    let message = "this part does not hold what its question asks for";
                    return Err(mistake::with_help(name, message, "make it again"));
                }
            }
            match all {
                Some(all) => prepared.report(all, notes),
                None => prepared.report(prepared.gather(0..0, None, notes)?, notes),
            }
        })
    }

    fn prepared<T>(
        &self,
        notes: &mut dyn Notes,
        work: impl FnOnce(&Prepared<'_>, &mut dyn Notes) -> Result<T, Diagnostics>,
    ) -> Result<T, Diagnostics> {
        let Self { machine, study, .. } = self;
        let manipulator = &*machine.evaluator(!self.interpret);
        let description = manipulator.description();
        let workspace = study.region.workspace(manipulator, self.seed);
        let workspace = &*workspace.map_err(|error| mistake::whole(&machine.origin, &error))?;
        notes.progress(0, workspace.len());
        let residuals = study.compensation.as_ref().map(|left| left.of(description));
        let tolerances = [study.tolerance, study.orientation_tolerance];
        let asked = Asked { residuals: residuals.as_deref(), tolerances };
        let survey = Survey::new(manipulator, workspace, asked);
        let survey = survey.map_err(|refused| self.not_evaluated(workspace, &refused, description))?;
        work(&Prepared { job: self, manipulator, workspace, tolerances, survey }, notes)
    }

    /// Looks at some configurations of a large workspace.
    pub(super) fn warn_of_extrapolation(&self, workspace: &dyn Workspace, notes: &mut dyn Notes) {
        if self.machine.spec.fitted.is_empty() {
            return;
        }
        let seen = Subset { workspace, count: EXTRAPOLATED }.reached();
        let places = seen.iter().map(|place| (&place.q[..], &place.u[..]));
        let manipulator = self.machine.evaluator(true);
        extrapolated(&self.machine.spec, &*manipulator, "configurations", places, notes);
    }

    pub(super) fn require_reached(&self, budget: &Budget) -> Result<(), Diagnostics> {
        if budget.configurations > 0 {
            return Ok(());
        }
        let reasons = unreachable::summary(&budget.unreachable, &self.machine.spec);
        let message = format!("no configuration of the workspace can be reached: {reasons}");
        let help = "move or shrink the workspace of the study, or widen the limits of the joints";
        Err(mistake::with_help(&self.machine.origin, message, help))
    }

    pub(super) fn not_evaluated(
        &self,
        workspace: &dyn Workspace,
        refused: &Unevaluated,
        description: &abbe::Description,
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
