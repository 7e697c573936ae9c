//! How large the errors of the tool point are at most: over a box of joints, parameters and inputs, with a proof.
//!
//! `domain` is the box in which everything is sought, `remainder` what first order and a step of compensation leave, `least` how far
//! the joints move the tool at least, and how stiff the machine is at least; `norms` are those of the position's errors alone, for an
//! analysis.

mod domain;
mod least;
mod norms;
pub mod options;
mod remainder;
mod report;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use abbe::Orientation;
use abbe_bound::{Bound as Proved, Effort, Progress};
use abbe_codegen::chain::{Magnitude, Magnitudes};
use abbe_codegen::graph::Graph;
use abbe_spec::diagnostic::Diagnostics;

use crate::changes::Changes;
use crate::machine::Machine;
use crate::notes::Notes;
use crate::reads::Reads;
use crate::study_file::Study;

use domain::Domain;
pub use norms::Norms;
pub use report::{AfterStep, Dexterity, Errors, Largest, Least, Margin, Remainder, Report};
use report::{Classes, Others};

/// How large are the errors at most?
#[derive(Clone)]
pub struct Bound {
    machine: Machine,
    study: Study,
    /// What is proved of each error, and when it is enough.
    pub effort: Effort,
    /// Whether the dexterity and the stiffness are asked for, too.
    pub least: bool,
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
        Self { machine, study, effort: Effort::default(), least: false, time: None }
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
        let Magnitudes { mut graph, repeatable, random, radius, across_z, apart } =
            Magnitudes::new(&domain.spec);
        let limits = domain.limits(&mut graph, &apart);
        // Rows 4–6 are no rotation vector there.
        let is_rotation = domain.spec.orientation == Orientation::RotationVector;
        let at_most = |kind: usize| {
            let rotation = if is_rotation { limits.rotation[kind] } else { f64::INFINITY };
            [limits.position[kind], rotation]
        };
        let mut sought = Sought { job: self, domain: &domain, begun: Instant::now(), done: 0 };
        let repeatable = sought.errors(&mut graph, &repeatable, &across_z[0], at_most(0), notes)?;
        let random = sought.errors(&mut graph, &random, &across_z[1], at_most(1), notes)?;
        // Of one class alone both together are that one.
        let radius = match Classes::of(&domain.spec) {
            Classes { repeatable: true, random: true } => {
                let both = sought.errors(&mut graph, &radius, &across_z[2], at_most(2), notes)?;
                both.at_most(&repeatable, &random)
            }
            Classes { random: true, .. } => random.clone(),
            _ => repeatable.clone(),
        };
        let remainder = sought.one(notes, |_, watch| domain.remainder(&self.effort, watch))?;
        let before = [&repeatable.norm, &repeatable.orientation];
        let before = before.map(|largest| largest.certified.unwrap_or(f64::INFINITY));
        let after_one_step = sought.one(notes, |_, watch| domain.after_step(&self.effort, before, watch))?;
        let (mut dexterity, mut stiffness) = (None, None);
        if self.least {
            dexterity = sought.one(notes, |_, watch| domain.dexterity(&self.effort, watch))?;
            stiffness = sought.one(notes, |_, watch| domain.stiffness(&self.effort, watch))?;
        }
        let errors = [repeatable, random, radius];
        let others = Others { remainder, after_one_step, dexterity, stiffness };
        let report = Report::new(domain, study, &self.effort, errors, others);
        report.warn(notes);
        Ok(report)
    }
}

/// How much is looked for: five errors of each of three kinds and what those along x and y do not exceed, the remainder, what a step of
/// compensation leaves, the dexterity and the stiffness.
const SOUGHT: usize = 22;

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
        [norm, x, y, z, orientation]: &[Magnitude; 5],
        across_z: &Magnitude,
        at_most: [f64; 2],
        notes: &mut dyn Notes,
    ) -> Result<Errors, Diagnostics> {
        let [of_norm, of_turn] = at_most.map(|at_most| Effort { at_most, ..self.job.effort });
        let norm = self.largest(graph, norm, None, &of_norm, notes)?;
        // No part of a position's error is larger than its norm.
        let of_part = Effort { at_most: norm.certified, ..of_norm };
        // Where a joint turns both about z, the largest part across z is soon known and leads to those along x and y.
        let across = match self.domain.moves_less(graph, [across_z.node, x.node]) {
            true => Some(self.largest(graph, across_z, None, &of_part, notes)?),
            false => None,
        };
        let start = across.as_ref().map(|across| &across.at[..]);
        let at_most = across.as_ref().map_or(norm.certified, |across| across.certified);
        let of_row = Effort { at_most, ..of_part };
        let mut x = self.largest(graph, x, start, &of_row, notes)?;
        x.boxes += across.as_ref().map_or(0, |across| across.boxes);
        let y = self.largest(graph, y, start, &of_row, notes)?;
        let z = self.largest(graph, z, None, &of_part, notes)?;
        let orientation = self.largest(graph, orientation, None, &of_turn, notes)?;
        let largest = |bound| Largest::new(&bound, self.domain);
        Ok(Errors {
            norm: largest(norm),
            x: largest(x),
            y: largest(y),
            z: largest(z),
            orientation: largest(orientation),
        })
    }

    fn largest(
        &mut self,
        graph: &mut Graph,
        magnitude: &Magnitude,
        start: Option<&[f64]>,
        effort: &Effort,
        notes: &mut dyn Notes,
    ) -> Result<Proved, Diagnostics> {
        self.one(notes, |domain, watch| domain.largest(graph, magnitude, start, effort, watch))
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
