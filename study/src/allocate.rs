//! Allocation: factors of the error sources with which a study keeps its tolerance at least cost.

use abbe::analysis::{Sweepable, Workspace};

use crate::analyze::{self, Analyze, Verdict};
use crate::factors::Factors;
use crate::study_file::{Criterion, Study};
use crate::workspace::in_one_run;
use crate::{About, Changes, Machine, Notes, Result, mistake};

pub use crate::factors::{AllocatedSource, Report, printed};

/// Number of bisections of the multiple of the tolerance: it is found to 1 %.
const BISECTIONS: usize = 9;
/// Smallest and largest multiple of the tolerance.
const MULTIPLES: [f64; 2] = [0.05, 5.0];

/// Job of `abbe allocate`: finds the factors of the sources that cost least.
#[derive(Clone)]
pub struct Allocate {
    machine: Machine,
    study: Study,
    /// Allows factors above 1.
    pub loosen: bool,
}

crate::reads! { Allocate: machine study, without loosen; }

impl Allocate {
    /// Creates the job for a machine and a study, and applies the study's changes to the machine.
    pub fn new(mut machine: Machine, mut study: Study) -> Self {
        study.change(&mut machine, &study.changes.clone());
        Self { machine, study, loosen: false }
    }

    /// Makes further changes.
    pub fn change(&mut self, changes: &Changes) {
        self.study.change(&mut self.machine, changes);
    }

    /// Finds the factors.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let manipulator = &*self.machine.evaluator(true);
        let workspace = self.study.region.workspace(manipulator, None).about(&self.machine.origin)?;
        in_one_run(workspace.len(), &self.machine.origin)?;
        match self.study.criterion {
            Criterion::WorstCase | Criterion::RootSumOfSquares => {
                self.factors(&self.study).over(manipulator, &*workspace, notes)
            }
            Criterion::Probability | Criterion::Yield => self.by_draws(manipulator, &*workspace, notes),
        }
    }

    fn factors<'a>(&'a self, study: &'a Study) -> Factors<'a> {
        Factors { machine: &self.machine, study, loosen: self.loosen }
    }

    /// Finds the factors by the root sum of squares for the largest multiple of the tolerance with
    /// which draws keep the tolerance itself, without the sources that counteract others, too.
    fn by_draws(
        &self,
        manipulator: &dyn Sweepable,
        workspace: &dyn Workspace,
        notes: &mut dyn Notes,
    ) -> Result<Report> {
        let Self { study, .. } = self;
        let at = |multiple: f64, notes: &mut dyn Notes| {
            let times = |tolerance: Option<f64>| tolerance.map(|tolerance| multiple * tolerance);
            let scaled = Study {
                tolerance: times(study.tolerance),
                orientation_tolerance: times(study.orientation_tolerance),
                ..study.clone()
            };
            self.factors(&scaled).over(manipulator, workspace, notes)
        };
        let [mut kept, mut exceeded] = MULTIPLES;
        let widest = at(exceeded, notes)?;
        let mut found = self.is_kept(&widest.scales(), notes)?.then_some(widest);
        for _ in 0..if found.is_some() { 0 } else { BISECTIONS } {
            let multiple = (kept * exceeded).sqrt();
            match at(multiple, notes) {
                Ok(tried) if self.is_kept(&tried.scales(), notes)? => (kept, found) = (multiple, Some(tried)),
                Ok(_) => exceeded = multiple,
                // Fixed sources alone exceed it, if the search was not stopped.
                Err(_) => {
                    notes.go_on()?;
                    kept = multiple;
                }
            }
        }
        let Some(found) = found else {
            let message = "no factors keep the tolerance with the required probability";
            let help = "allow a larger tolerance or a smaller probability, or remove `fixed`";
            return Err(mistake::with_help(&self.machine.origin, message, help));
        };
        let judged = self.analyzed(&found.scales())?.verdicts;
        let drawn = judged.and_then(|verdicts| Some(verdicts.counting().yielded?.configurations));
        let configurations = drawn.unwrap_or(found.configurations);
        let study = study.clone();
        let (tolerance, orientation_tolerance) = (study.tolerance, study.orientation_tolerance);
        Ok(Report { tolerance, orientation_tolerance, configurations, study, ..found })
    }

    /// Returns `true` if an analysis with these factors meets the study, and still does without the
    /// sources that counteract others.
    fn is_kept(&self, scales: &[String], notes: &mut dyn Notes) -> Result<bool> {
        notes.go_on()?;
        let report = self.analyzed(scales)?;
        let is_met = |report: &analyze::Report| {
            report.verdicts.as_ref().is_some_and(|verdicts| verdicts.verdict == Verdict::Met)
        };
        let opposing =
            report.ledger.sources.iter().filter(|source| source.share.is_some_and(|share| share < 0.0));
        let without: Vec<String> = opposing.map(|source| format!("{}=0", source.name)).collect();
        Ok(is_met(&report) && (without.is_empty() || is_met(&self.analyzed(&[scales, &without].concat())?)))
    }

    fn analyzed(&self, scales: &[String]) -> Result<analyze::Report> {
        let changes = Changes::read([&[], &[], &[], scales], &self.machine.spec)?;
        let study = Study { changes: Changes::default(), figures: Vec::new(), ..self.study.clone() };
        let mut job = Analyze::new(self.machine.clone(), study);
        job.change(&changes, &mut ());
        job.run(&mut ())
    }
}
