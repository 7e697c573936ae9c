//! Certified upper bounds on the errors of the tool, over a box of joints, parameters and inputs.
//!
//! `domain` is the enclosing box of the workspace. `remainder` bounds the first-order error and the
//! error after one step of compensation, `least` the dexterity and stiffness. `certified_norms`
//! holds the position bounds that an analysis shows.

mod certified_norms;
mod domain;
mod least;
pub mod options;
mod remainder;
mod report;

use std::time::{Duration, Instant};

use abbe::Orientation;
use abbe_bound::{Bound as Proved, Effort, Watch};
use abbe_codegen::chain::{Implicit, Magnitude, Magnitudes};
use abbe_codegen::graph::Graph;
use abbe_spec::diagnostic::Diagnostics;

use crate::changes::Changes;
use crate::machine::Machine;
use crate::notes::Notes;
use crate::study_file::Study;

pub use certified_norms::CertifiedNorms;
use domain::Domain;
use report::{Classes, OtherBounds};
pub use report::{Dexterity, ErrorBound, ErrorBounds, LowerBound, Margin, Remainder, Report, StepResidual};

/// Job of `abbe bound`: certifies upper bounds on the errors.
#[derive(Clone)]
pub struct Bound {
    machine: Machine,
    study: Study,
    /// Effort of each search: gap and number of boxes.
    pub effort: Effort,
    /// Also certifies the dexterity and the stiffness.
    pub least: bool,
    /// Time limit, after which no further box is evaluated; `None` for no limit.
    pub time: Option<Duration>,
}

crate::reads! { Bound: machine study, without effort least time; }

impl Bound {
    /// Creates the job for a machine and a study, and applies the study's changes to the machine.
    /// The uncertainty of the repeatable errors becomes random sources, after all others.
    pub fn new(mut machine: Machine, mut study: Study) -> Self {
        study.change(&mut machine, &study.changes.clone());
        Self { machine, study, effort: Effort::default(), least: false, time: None }
    }

    /// Makes further changes.
    pub fn change(&mut self, changes: &Changes) {
        self.study.change(&mut self.machine, changes);
    }

    /// Refines boxes until each bound reaches the gap, or a limit on boxes or time. Returns the
    /// report.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, study, .. } = self;
        if self.least {
            machine.require_chain(
                "no dexterity or stiffness is bounded",
                "use `abbe bound` for the errors alone, or `abbe check`, which names dead points",
            )?;
        }
        let domain = Domain::new(machine, study)?;
        let Magnitudes { mut graph, repeatable, random, total, across_z, apart, implicit } =
            Magnitudes::new(&domain.spec, &domain.given);
        let limits = domain.limits(&mut graph, apart.as_ref());
        // Euler angles are no rotation vector, so the limit on it does not apply.
        let is_rotation = domain.spec.orientation == Orientation::RotationVector;
        let at_most = |kind: usize| {
            let rotation = if is_rotation { limits.rotation[kind] } else { f64::INFINITY };
            [limits.position[kind], rotation]
        };
        let start = domain.worst_of_workspace(machine, study);
        let (start, in_study) =
            start.as_ref().map_or((None, None), |(at, worst)| (Some(&at[..]), Some(*worst)));
        let mut searches = Searches {
            job: self,
            domain: &domain,
            implicit: &implicit,
            begun: Instant::now(),
            done: 0,
            found: [0.0; 2],
        };
        let repeatable =
            searches.error_bounds(&mut graph, &repeatable, &across_z[0], at_most(0), start, notes)?;
        let random = searches.error_bounds(&mut graph, &random, &across_z[1], at_most(1), start, notes)?;
        // With sources of one class only, the combined error is that of the class.
        let [repeatable, random, total] = match Classes::enabled(&domain.spec) {
            Classes { repeatable: true, random: true } => {
                let both =
                    searches.error_bounds(&mut graph, &total, &across_z[2], at_most(2), start, notes)?;
                let both = both.tighten_by_sum(&repeatable, &random);
                // No part is larger than the sum.
                [repeatable.tighten(&both), random.tighten(&both), both]
            }
            Classes { random: true, .. } => [repeatable, random.clone(), random],
            _ => [repeatable.clone(), random, repeatable],
        };
        let remainder = searches.run(notes, |_, watch| domain.remainder(&self.effort, watch))?;
        let before = [&repeatable.norm, &repeatable.orientation];
        let before = before.map(|largest| largest.certified.unwrap_or(f64::INFINITY));
        let after_one_step =
            searches.run(notes, |_, watch| domain.after_step(&self.effort, before, watch))?;
        let (mut dexterity, mut stiffness) = (None, None);
        if self.least {
            dexterity = searches.run(notes, |_, watch| domain.dexterity(&self.effort, watch))?;
            stiffness = searches.run(notes, |_, watch| domain.stiffness(&self.effort, watch))?;
        }
        let errors = [repeatable, random, total];
        let others = OtherBounds { remainder, after_one_step, dexterity, stiffness };
        let report = Report::new(domain, study, &self.effort, errors, others);
        let mut report = Report { changes: machine.stated_changes().collect(), ..report };
        for (margin, k) in [&mut report.margin, &mut report.orientation_margin].into_iter().zip(0..) {
            if let Some(margin) = margin {
                margin.in_study = in_study.map(|worst: [f64; 2]| margin.tolerance - worst[k]);
            }
        }
        report.warn(notes);
        Ok(report)
    }
}

/// Number of searches: for each of three kinds of error five bounds and one on x and y together,
/// then the remainder, the residual after one step, the dexterity and the stiffness.
const SEARCHES: usize = 22;

/// Share of the gap below which an error is nothing beside a larger one of a machine with loops.
const NOTHING: f64 = 0.1;

/// Progress through the searches.
struct Searches<'a> {
    job: &'a Bound,
    domain: &'a Domain,
    /// Unknowns that loops determine.
    implicit: &'a [Implicit],
    begun: Instant,
    /// Number of completed searches.
    done: usize,
    /// Largest errors that were found, of position and of orientation.
    found: [f64; 2],
}

impl Searches<'_> {
    fn error_bounds(
        &mut self,
        graph: &mut Graph,
        [norm, x, y, z, orientation]: &[Magnitude; 5],
        across_z: &Magnitude,
        at_most: [f64; 2],
        from: Option<&[f64]>,
        notes: &mut dyn Notes,
    ) -> Result<ErrorBounds, Diagnostics> {
        let effort = self.job.effort;
        // What loops determine is enclosed with a rest, even where it is zero.
        let share = if self.implicit.is_empty() { 0.0 } else { NOTHING * effort.gap };
        let [norm_effort, orientation_effort] = [0, 1].map(|of: usize| Effort {
            at_most: at_most[of],
            nothing: share * self.found[of],
            ..effort
        });
        let norm = self.largest(graph, norm, from, &norm_effort, notes)?;
        // A component of the position error cannot exceed its norm.
        let component_effort = Effort { at_most: norm.certified, ..norm_effort };
        // If a joint rotates both components about z, their common bound is found quickly. It
        // yields a start and an upper bound for x and y.
        let across = match self.domain.depends_on_fewer(graph, [across_z.node, x.node]) {
            true => Some(self.largest(graph, across_z, None, &component_effort, notes)?),
            false => None,
        };
        let start = across.as_ref().map(|across| &across.at[..]).or(from);
        let at_most = across.as_ref().map_or(norm.certified, |across| across.certified);
        let row_effort = Effort { at_most, ..component_effort };
        let mut x = self.largest(graph, x, start, &row_effort, notes)?;
        x.boxes += across.as_ref().map_or(0, |across| across.boxes);
        let y = self.largest(graph, y, start, &row_effort, notes)?;
        let z = self.largest(graph, z, None, &component_effort, notes)?;
        let orientation = self.largest(graph, orientation, None, &orientation_effort, notes)?;
        self.found = [self.found[0].max(norm.found), self.found[1].max(orientation.found)];
        let largest = |bound| ErrorBound::new(&bound, self.domain);
        Ok(ErrorBounds {
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
        let implicit = self.implicit;
        self.run(notes, |domain, watch| domain.largest(graph, magnitude, implicit, start, effort, watch))
    }

    /// Runs one search within the time limit.
    fn run<T>(
        &mut self,
        notes: &mut dyn Notes,
        search: impl FnOnce(&Domain, &mut Watch<'_>) -> T,
    ) -> Result<T, Diagnostics> {
        let Self { job, domain, begun, done, .. } = *self;
        let found = search(domain, &mut |_| {
            notes.progress(done, SEARCHES);
            !notes.stop() && job.time.is_none_or(|time| begun.elapsed() < time)
        });
        self.done += 1;
        notes.progress(self.done, SEARCHES);
        notes.go_on()?;
        Ok(found)
    }
}
