//! The question, and how it is answered.

use std::ops::Range;
use std::path::PathBuf;

use abbe::analysis::{BudgetOptions, BudgetSweep, Row};
use abbe_spec::diagnostic::Diagnostics;

use super::parts::shard::Shard;
use super::report::Report;
use super::sweep::{Sweep, SweepData, not_evaluated};
use crate::changes::Changes;
use crate::machine::Machine;
use crate::mistake;
use crate::notes::Notes;
use crate::reads::Reads;
use crate::study_file::Study;

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
        self.with_sweep(notes, |sweep, notes| {
            let all = sweep.run(0..sweep.budget.chunks(), rows, notes)?;
            sweep.report(all, notes)
        })
    }

    /// Sweeps some of the chunks of the workspace, of which there are as many as `chunks` is told.
    pub(super) fn gather(
        &self,
        chunks: impl FnOnce(usize) -> Range<usize>,
        notes: &mut dyn Notes,
    ) -> Result<SweepData, Diagnostics> {
        self.with_sweep(notes, |sweep, notes| sweep.run(chunks(sweep.budget.chunks()), None, notes))
    }

    /// The report of what was gathered, shard after shard.
    pub(super) fn finish(
        &self,
        parts: Vec<(String, Shard, SweepData)>,
        notes: &mut dyn Notes,
    ) -> Result<Report, Diagnostics> {
        self.with_sweep(notes, |sweep, notes| {
            let mut all: Option<SweepData> = None;
            for (name, shard, part) in parts {
                let fits = part.budget.chunks() == shard.chunks(sweep.budget.chunks())
                    && sweep.budget.fits(&part.budget);
                let put = match &mut all {
                    Some(all) => fits && sweep.append(all, part),
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
                Some(all) => sweep.report(all, notes),
                None => sweep.report(sweep.run(0..0, None, notes)?, notes),
            }
        })
    }

    fn with_sweep<T>(
        &self,
        notes: &mut dyn Notes,
        work: impl FnOnce(&Sweep<'_>, &mut dyn Notes) -> Result<T, Diagnostics>,
    ) -> Result<T, Diagnostics> {
        let Self { machine, study, monte_carlo, seed, figures, .. } = self;
        let manipulator = &*machine.evaluator(!self.interpret);
        let description = manipulator.description();
        let workspace = study.region.workspace(manipulator, *seed);
        let workspace = &*workspace.map_err(|error| mistake::whole(&machine.origin, &error))?;
        notes.progress(0, workspace.len());
        let residuals = study.compensation.as_ref().map(|left| left.of(description));
        let tolerances = [study.tolerance, study.orientation_tolerance];
        let options = BudgetOptions { residuals: residuals.as_deref(), tolerances };
        let budget = BudgetSweep::new(manipulator, workspace, options)
            .map_err(|refused| not_evaluated(machine, workspace, &refused, description))?;
        let sweep = Sweep {
            machine,
            study,
            monte_carlo: *monte_carlo,
            seed: seed.unwrap_or(0),
            figures: *figures,
            manipulator,
            workspace,
            budget,
        };
        work(&sweep, notes)
    }
}
