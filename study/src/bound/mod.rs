//! Certified upper bounds on the errors of the tool, over a box of joints, parameters and inputs.
//!
//! `domain` is the enclosing box of the workspace. `remainder` bounds the first-order error and the
//! error after one step of compensation, the dexterity and stiffness. Here are the job, and the
//! certified norms of position errors that an analysis shows beside the sampled ones.

mod domain;
pub mod options;
mod remainder;
mod report;

pub use report::{Dexterity, ErrorBound, ErrorBounds, LowerBound, Margin, Remainder, Report, StepResidual};

use std::time::{Duration, Instant};

use abbe::{Class, Orientation};
use abbe_bound::{Bound as Proved, Effort, Progress, Watch};
use abbe_codegen::chain::{Implicit, Magnitude, Magnitudes};
use abbe_codegen::graph::Graph;
use serde::Serialize;

use crate::{Changes, Machine, Notes, Result, Study};
use domain::Domain;
use report::Classes;

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
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
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
        let (most, least) = ((remainder, after_one_step), (dexterity, stiffness));
        let report = Report::new(domain, study, &self.effort, errors, most, least);
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
    ) -> Result<ErrorBounds> {
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
    ) -> Result<Proved> {
        let implicit = self.implicit;
        self.run(notes, |domain, watch| domain.largest(graph, magnitude, implicit, start, effort, watch))
    }

    /// Runs one search within the time limit.
    fn run<T>(
        &mut self,
        notes: &mut dyn Notes,
        search: impl FnOnce(&Domain, &mut Watch<'_>) -> T,
    ) -> Result<T> {
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

/// Limit on the work of an analysis for certified norms, in approximate operations. One box takes
/// about (nodes of the graph) × (moving names)².
const WORK: usize = 400_000_000;
/// Number by which the boxes of the search for all sources together are divided.
const SHORTER: usize = 16;
/// Limit on the evaluations of elastic deflections: about a second.
const SAMPLES: usize = 20_000_000;
/// Limit on (random sources) × (frames), above which the expressions grow too large.
const MOST_RANDOM: usize = 2_000;

/// Largest norms ‖ΔX‖ of the position errors over the enclosing box of a workspace, in the length
/// unit. The true maximum lies between `found` and `certified`.
#[derive(Clone, Debug, Serialize)]
pub struct CertifiedNorms {
    /// Norm of the sum of the repeatable sources, with signs; `None` if there are none.
    pub repeatable: Option<ErrorBound>,
    /// Norm of the sum of the random sources with any values within their bounds; `None` if there
    /// are none.
    pub random: Option<ErrorBound>,
    /// Norm of the sum of all sources; `None` unless there are sources of both classes.
    pub total: Option<ErrorBound>,
    /// Indicates that the enclosing box is larger than the workspace.
    pub contains_more: bool,
}

impl CertifiedNorms {
    /// Bounds the norms for a machine and a study; changes are already applied. Returns `None` if
    /// the workspace has no enclosing box, there is no source, or the work would exceed the limits.
    pub(crate) fn certify(machine: &Machine, study: &Study, notes: &dyn Notes) -> Option<Self> {
        let domain = Domain::new(machine, study).ok()?;
        let Classes { repeatable, random } = Classes::enabled(&domain.spec);
        let sources =
            domain.spec.enabled_sources().filter(|source| source.class != Class::Repeatable).count();
        // With loops, a bound takes too long beside an analysis.
        if !domain.spec.is_serial()
            || !repeatable && !random
            || sources * domain.spec.frames.len() > MOST_RANDOM
        {
            return None;
        }
        let mut magnitudes = Magnitudes::new(&domain.spec, &[]);
        let norms =
            [&magnitudes.repeatable, &magnitudes.random, &magnitudes.total].map(|five| five[0].clone());
        let moving = domain.moving_count();
        let boxes = WORK / (magnitudes.graph.len() * moving * moving).max(1);
        let effort = Effort { boxes: boxes.min(20_000), samples: SAMPLES, ..Effort::default() };
        let limits = domain.limits(&mut magnitudes.graph, magnitudes.apart.as_ref()).position;
        let mut largest = |i: usize, any: bool, effort: Effort| {
            any.then(|| {
                let mut go_on = |_: &Progress| !notes.stop();
                let bound = domain.largest(&mut magnitudes.graph, &norms[i], &[], None, &effort, &mut go_on);
                ErrorBound::new(&bound, &domain)
            })
        };
        let [of_repeatable, of_random] = [0, 1].map(|i| Effort { at_most: limits[i], ..effort });
        let (of_both, contains_more) = (repeatable && random, !study.region.is_box(&domain.spec));
        let repeatable = largest(0, repeatable, of_repeatable);
        let random = largest(1, random, of_random);
        // The sum of both parts is close; a short search finds where they add up.
        let parts = [&repeatable, &random].map(|part| part.as_ref().and_then(|part| part.certified));
        let sum = parts[0].zip(parts[1]).map_or(f64::INFINITY, |(first, second)| (first + second).next_up());
        let of_total = Effort { at_most: limits[2].min(sum), boxes: effort.boxes / SHORTER, ..effort };
        let total = largest(2, of_both, of_total);
        Some(Self { repeatable, random, total, contains_more })
    }

    /// Returns the bound for all sources together.
    pub fn all_sources(&self) -> Option<&ErrorBound> {
        self.total.as_ref().or(self.repeatable.as_ref()).or(self.random.as_ref())
    }
}
