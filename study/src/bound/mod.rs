//! How large the errors of the tool point are at most: over a box of joints, parameters and inputs, with a proof.

mod report;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use abbe_codegen::chain::{Magnitude, Magnitudes};
use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::expr::Symbol;
use abbe_codegen::graph::Graph;
use abbe_codegen::spec::Spec;
use abbe_interpreter::bound::{self, Effort, MOST_MOVING, Moving, Progress};

use crate::changes::Changes;
use crate::machine::Machine;
use crate::mistake;
use crate::notes::Notes;
use crate::reads::Reads;
use crate::study_file::Study;
use crate::workspace::Span;

use report::Classes;
pub use report::{Errors, Largest, Report};

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
        let spec = &machine.spec;
        let spans = study.region.spans(spec, &machine.origin)?;
        let moving = spans.iter().filter(|span| span.range[0] < span.range[1]).count();
        if moving > MOST_MOVING {
            return Err(mistake::with_help(
                &machine.origin,
                format!(
                    "{moving} joints, parameters and inputs move: of more than {MOST_MOVING} at once nothing can be proved"
                ),
                "hold some of them: a study whose workspace is a `grid` moves those that it names, `--set` holds inputs",
            ));
        }
        let Magnitudes { mut graph, repeatable, random, radius } = Magnitudes::new(spec);
        let begun = Instant::now();
        let mut sought = Sought { job: self, spans: &spans, begun, done: 0 };
        let repeatable = sought.errors(&mut graph, repeatable, notes)?;
        let random = sought.errors(&mut graph, random, notes)?;
        // Of one class alone both together are that one.
        let radius = match Classes::of(spec) {
            Classes { repeatable: true, random: true } => sought.errors(&mut graph, radius, notes)?,
            Classes { random: true, .. } => random.clone(),
            _ => repeatable.clone(),
        };
        let report = Report::new(spec.clone(), study, &self.effort, spans, [repeatable, random, radius]);
        report.warn(notes);
        Ok(report)
    }
}

/// How many errors are looked for: five of each of three kinds.
const ERRORS: usize = 15;

/// What is being looked for.
struct Sought<'a> {
    job: &'a Bound,
    spans: &'a [Span],
    begun: Instant,
    /// How many errors are known.
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
            largest.push(self.largest(graph, magnitude, &effort, notes));
            self.done += 1;
            notes.progress(self.done, ERRORS);
            notes.go_on()?;
        }
        let [norm, x, y, z, orientation] = <[Largest; 5]>::try_from(largest).expect("five errors");
        Ok(Errors { norm, x, y, z, orientation })
    }

    fn largest(
        &self,
        graph: &mut Graph,
        magnitude: Magnitude,
        effort: &Effort,
        notes: &mut dyn Notes,
    ) -> Largest {
        let Self { job, spans, begun, done } = *self;
        let spec = &job.machine.spec;
        let moving: Vec<Moving> = spans
            .iter()
            .map(|Span { symbol, range }| Moving {
                symbol: *symbol,
                range: *range,
                home: home(*symbol, spec),
            })
            .collect();
        let mut watch = |_: &Progress| {
            notes.progress(done, ERRORS);
            !notes.stop() && job.time.is_none_or(|time| begun.elapsed() < time)
        };
        let bound =
            bound::largest(graph, magnitude, &moving, |symbol| home(symbol, spec), effort, &mut watch);
        Largest::new(&bound, spans, spec)
    }
}

/// Where something stands that does not move.
fn home(symbol: Symbol, spec: &Spec) -> f64 {
    match symbol {
        Symbol::Variable(i) => spec.variables[i].home,
        Symbol::Parameter(i) => spec.parameters[i].value,
        Symbol::Input(i) => spec.inputs[i].value,
        // No error of the spec's own sources depends on anything else.
        _ => f64::NAN,
    }
}
