//! How large the errors of the tool point are at most: over a box of joints, parameters and inputs, with a proof.
//!
//! `domain` is the box in which everything is sought; `norms` are those of the position's errors alone, for an analysis.

mod domain;
mod norms;
mod report;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use abbe_codegen::chain::{Magnitude, Magnitudes};
use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::graph::Graph;
use abbe_interpreter::bound::{Effort, Progress};

use crate::changes::Changes;
use crate::machine::Machine;
use crate::notes::Notes;
use crate::reads::Reads;
use crate::study_file::Study;

use domain::Domain;
pub use norms::Norms;
use report::Classes;
pub use report::{Errors, Largest, Remainder, Report};

/// How large are the errors at most?
#[derive(Clone)]
pub struct Bound {
    machine: Machine,
    study: Study,
    /// What is proved of each error, and when it is enough.
    pub effort: Effort,
    /// After so much time no further box is looked at.
    pub time: Option<Duration>,
}

impl Reads for Bound {
    fn files(&self) -> Vec<PathBuf> {
        [self.machine.files(), self.study.files()].concat()
    }
}

impl Bound {
    /// Asks it of a manipulator over the box that contains the workspace of a study, with the changes that the study makes.
    pub fn new(mut machine: Machine, mut study: Study) -> Self {
        machine.change(&study.changes);
        machine.add_magnitude_errors();
        study.fix(machine.fixed_inputs());
        Self { machine, study, effort: Effort::default(), time: None }
    }

    /// Makes further changes.
    pub fn change(&mut self, changes: &Changes) {
        self.machine.change(changes);
        self.machine.add_magnitude_errors();
        self.study.fix(self.machine.fixed_inputs());
    }

    /// Looks at boxes until each error is known to the gap.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, study, .. } = self;
        let domain = Domain::new(machine, study)?;
        let Magnitudes { mut graph, repeatable, random, radius } = Magnitudes::new(&domain.spec);
        let mut sought = Sought { job: self, domain: &domain, begun: Instant::now(), done: 0 };
        let repeatable = sought.errors(&mut graph, repeatable, notes)?;
        let random = sought.errors(&mut graph, random, notes)?;
        // Of one class alone both together are that one.
        let radius = match Classes::of(&domain.spec) {
            Classes { repeatable: true, random: true } => sought.errors(&mut graph, radius, notes)?,
            Classes { random: true, .. } => random.clone(),
            _ => repeatable.clone(),
        };
        let remainder = sought.one(notes, |_, watch| domain.remainder(&self.effort, watch))?;
        let errors = [repeatable, random, radius];
        let report = Report::new(domain, study, &self.effort, errors, remainder);
        report.warn(notes);
        Ok(report)
    }
}

/// How much is looked for: five errors of each of three kinds, and the remainder.
const SOUGHT: usize = 16;

/// What is being looked for.
struct Sought<'a> {
    job: &'a Bound,
    domain: &'a Domain,
    begun: Instant,
    /// How much is known.
    done: usize,
}

impl Sought<'_> {
    fn errors(
        &mut self,
        graph: &mut Graph,
        magnitudes: [Magnitude; 5],
        notes: &mut dyn Notes,
    ) -> Result<Errors, Diagnostics> {
        let mut largest: Vec<Largest> = Vec::with_capacity(5);
        for (i, magnitude) in magnitudes.into_iter().enumerate() {
            // No part of a position's error is larger than its norm.
            let norm = if (1..4).contains(&i) { largest[0].certified } else { None };
            let effort = Effort { at_most: norm.unwrap_or(f64::INFINITY), ..self.job.effort };
            largest.push(self.one(notes, |domain, watch| domain.largest(graph, magnitude, &effort, watch))?);
        }
        let [norm, x, y, z, orientation] = <[Largest; 5]>::try_from(largest).expect("five errors");
        Ok(Errors { norm, x, y, z, orientation })
    }

    /// One of what is looked for, while there is time.
    fn one<T>(
        &mut self,
        notes: &mut dyn Notes,
        search: impl FnOnce(&Domain, &mut dyn FnMut(&Progress) -> bool) -> T,
    ) -> Result<T, Diagnostics> {
        let Self { job, domain, begun, done } = *self;
        let found = search(domain, &mut |_| {
            notes.progress(done, SOUGHT);
            !notes.stop() && job.time.is_none_or(|time| begun.elapsed() < time)
        });
        self.done += 1;
        notes.progress(self.done, SOUGHT);
        notes.go_on()?;
        Ok(found)
    }
}
