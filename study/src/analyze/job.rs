//! The job: options, and how the report is computed.

use abbe_spec::option::{DISABLE, ENABLE, Q, SCALE, SET};
use std::ops::Range;

use abbe::analysis::{BudgetOptions, BudgetSweep, Row};

use super::parts::shard::Shard;
use super::report::Report;
use super::sweep::{AnalysisSweep, PartialAnalysis};
use crate::{About, Changes, Machine, Notes, Result, Study, mistake, number};

/// Job of `abbe analyze`: evaluates each error source over the workspace of a study.
#[derive(Clone)]
pub struct Analyze {
    machine: Machine,
    study: Study,
    /// The configuration that replaces the study's workspace, as `--q` reads it.
    q: Option<String>,
    /// Number of Monte Carlo draws at the worst configuration and at home; `None` skips them.
    pub monte_carlo: Option<usize>,
    /// Seed of the Monte Carlo draws and of the study's random samples; `None` uses the study's.
    pub seed: Option<u64>,
    /// Interprets the spec even if generated code is available. The result is the same, computed
    /// more slowly.
    pub interpret: bool,
    /// Gathers the data of the study's figures.
    pub figures: bool,
}

crate::reads! { Analyze: machine study, without q monte_carlo seed interpret figures; }

impl Analyze {
    /// Creates the job for a machine and a study, and applies the study's changes to the machine.
    /// The uncertainty of the repeatable errors becomes random sources, after all others.
    pub fn new(mut machine: Machine, mut study: Study) -> Self {
        study.change(&mut machine, &study.changes.clone());
        Self { machine, study, q: None, monte_carlo: None, seed: None, interpret: false, figures: false }
    }

    /// Makes further changes. Published figures belong to the unchanged machine and are dropped.
    pub fn change(&mut self, changes: &Changes, notes: &mut dyn Notes) {
        if !changes.is_empty() && self.study.remove_published() {
            notes.note(&format!(
                "published figures are not compared: {SET}, {ENABLE}, {DISABLE} and {SCALE} define \
                 a different machine"
            ));
        }
        self.study.change(&mut self.machine, changes);
    }

    /// Analyzes configurations of the joints instead of the study's workspace, with nominal
    /// parameters and inputs. Published figures belong to the workspace and are dropped.
    pub fn restrict(&mut self, rows: Vec<Vec<f64>>, notes: &mut dyn Notes) {
        self.q = match &rows[..] {
            [q] => Some(number::exact_variables(q, &self.machine.spec)),
            _ => None,
        };
        if self.study.restrict(rows) {
            notes.note(&format!("published figures are not compared: {Q} defines another workspace"));
        }
    }

    /// Returns the study, without the inputs that changes have fixed.
    pub fn study(&self) -> &Study {
        &self.study
    }

    /// Returns the machine, with all changes.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// Returns the indices of the parameters that vary over the workspace.
    pub fn varying(&self) -> Vec<usize> {
        self.study.region.varying(&self.machine.spec)
    }

    /// Returns the indices of the inputs that vary over the workspace.
    pub fn moving_inputs(&self) -> Vec<usize> {
        self.study.region.moving_inputs()
    }

    /// Returns the options that the figures depend on.
    fn options(&self) -> Vec<(&'static str, String)> {
        let Self { machine, study: _, q, monte_carlo, seed, interpret: _, figures: _ } = self;
        machine.options_with([
            ("q", q.clone().unwrap_or_default()),
            ("monte-carlo", monte_carlo.map_or_else(String::new, |draws| draws.to_string())),
            ("seed", seed.map_or_else(String::new, |seed| seed.to_string())),
        ])
    }

    /// Sweeps the workspace and returns the report.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        self.run_with_rows(None, notes)
    }

    /// Like [`run`](Self::run), and passes each reached configuration to `rows`, in workspace
    /// order.
    pub fn run_with_rows(&self, rows: Option<&mut dyn FnMut(&Row)>, notes: &mut dyn Notes) -> Result<Report> {
        self.with_sweep(notes, |sweep, notes| {
            sweep.report(sweep.run(0..sweep.budget.chunks(), rows, notes)?, notes)
        })
    }

    /// Sweeps part of the workspace. `chunks` receives the number of chunks and returns the range
    /// to sweep.
    pub(super) fn sweep_chunks(
        &self,
        chunks: impl FnOnce(usize) -> Range<usize>,
        notes: &mut dyn Notes,
    ) -> Result<PartialAnalysis> {
        self.with_sweep(notes, |sweep, notes| sweep.run(chunks(sweep.budget.chunks()), None, notes))
    }

    /// Returns the report from the data of all shards, in shard order.
    pub(super) fn report_on_parts(
        &self,
        parts: Vec<(String, Shard, PartialAnalysis)>,
        notes: &mut dyn Notes,
    ) -> Result<Report> {
        self.with_sweep(notes, |sweep, notes| {
            let mut all: Option<PartialAnalysis> = None;
            for (name, shard, part) in parts {
                let fits = part.budget.chunks() == shard.chunks(sweep.budget.chunks()) && sweep.fits(&part);
                let put = match &mut all {
                    Some(all) => fits && sweep.append(all, part),
                    None => {
                        all = Some(part);
                        fits
                    }
                };
                if !put {
                    let message = "this part lacks data that its options ask for";
                    return Err(mistake::with_help(name, message, "create the part again"));
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
        work: impl FnOnce(&AnalysisSweep<'_>, &mut dyn Notes) -> Result<T>,
    ) -> Result<T> {
        let Self { machine, study, monte_carlo, seed, figures, .. } = self;
        let manipulator = &*machine.evaluator(!self.interpret);
        let description = manipulator.description();
        let workspace = &*study.region.workspace(manipulator, *seed).about(&machine.origin)?;
        notes.progress(0, workspace.len());
        let options = BudgetOptions { tolerances: study.tolerances() };
        let budget = BudgetSweep::new(manipulator, workspace, options)
            .map_err(|refused| machine.not_evaluated(workspace, &refused, description))?;
        let sweep = AnalysisSweep {
            machine,
            study,
            monte_carlo: *monte_carlo,
            seed: seed.unwrap_or(0),
            options: self.options(),
            figures: *figures,
            manipulator,
            workspace,
            budget,
        };
        work(&sweep, notes)
    }
}
