//! The box in which errors are sought.

use std::sync::Arc;

use abbe_codegen::chain::{self, Apart, Magnitude};
use abbe_codegen::graph::{Graph, Node};
use abbe_interpreter::bound::{self, Effort, Limits, MOST_MOVING, Moving, Progress};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::expr::Symbol;
use indexmap::IndexMap;

use crate::machine::Machine;
use crate::mistake;
use crate::number;
use crate::study_file::Study;
use crate::workspace::{Span, name};

use super::report::{AfterStep, Classes, Remainder};

/// What first order leaves out, and a step of compensation leaves, is small: it is known closely enough when it is known to a half, or
/// after so many boxes.
const REMAINDER_EFFORT: Effort = Effort { gap: 0.5, boxes: 20_000, at_most: f64::INFINITY };
/// Of what is still endless after so many boxes nothing will soon be known.
const HOPELESS: usize = 3_000;
/// How many names may move: the search for the remainder moves one more.
const MOST_NAMES: usize = MOST_MOVING - 1;

/// The box of joints, parameters and inputs that contains the workspace of a study.
pub(super) struct Domain {
    pub(super) spec: Arc<Spec>,
    pub(super) spans: Vec<Span>,
}

impl Domain {
    /// That of a machine and a study with all changes.
    pub(super) fn new(machine: &Machine, study: &Study) -> Result<Self, Diagnostics> {
        let spans = study.region.spans(&machine.spec, &machine.origin)?;
        let domain = Self { spec: machine.spec.clone(), spans };
        let moving = domain.moving();
        if moving > MOST_NAMES {
            return Err(mistake::with_help(
                &machine.origin,
                format!(
                    "{moving} joints, parameters and inputs move: of more than {MOST_NAMES} at once nothing can be proved"
                ),
                "hold some of them: a study whose workspace is a `grid` moves those that it names, `--set` holds inputs",
            ));
        }
        Ok(domain)
    }

    /// The largest size of an error in it; the search begins at `start`, or at home.
    pub(super) fn largest(
        &self,
        graph: &mut Graph,
        magnitude: &Magnitude,
        start: Option<&[f64]>,
        effort: &Effort,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> bound::Bound {
        let still = |symbol| home(symbol, &self.spec);
        let mut names = self.names();
        for (name, start) in names.iter_mut().zip(start.unwrap_or_default()) {
            name.start = *start;
        }
        bound::largest(graph, magnitude, &names, still, effort, watch)
    }

    /// What norms cannot exceed because of their parts.
    pub(super) fn limits(&self, graph: &mut Graph, apart: &Apart) -> Limits {
        bound::limits(graph, apart, &self.names(), |symbol| home(symbol, &self.spec))
    }

    /// Whether fewer of the names that move move the first node than the second.
    pub(super) fn moves_less(&self, graph: &Graph, nodes: [Node; 2]) -> bool {
        let [first, second] = nodes.map(|node| {
            let symbols = graph.symbols(&[node]);
            let moving = self.spans.iter().filter(|span| span.range[0] < span.range[1]);
            moving.filter(|span| symbols.contains(&span.symbol)).count()
        });
        first < second
    }

    /// What first order leaves out of the repeatable sources' position; none if there are no such sources.
    pub(super) fn remainder(
        &self,
        asked: &Effort,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Option<Remainder> {
        if !Classes::of(&self.spec).repeatable {
            return None;
        }
        let chain::Remainder { mut graph, magnitude, share } = chain::Remainder::new(&self.spec);
        Some(Remainder::new(&self.curve(&mut graph, &magnitude, share, asked, watch)))
    }

    /// What one step of compensation leaves of the repeatable sources; none if there are no such sources, or too few joints. Where it
    /// may leave more than `before`, what the sources do without it, nothing is sought any longer.
    pub(super) fn after_step(
        &self,
        asked: &Effort,
        before: [f64; 2],
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Option<AfterStep> {
        if !Classes::of(&self.spec).repeatable {
            return None;
        }
        let chain::Residual { mut graph, point, turn, share } = chain::Residual::new(&self.spec)?;
        let mut largest = |magnitude: &Magnitude, before: f64| {
            let mut watch = |progress: &Progress| {
                let is_hopeless = progress.certified.is_infinite() && progress.boxes >= HOPELESS;
                progress.found <= before && !is_hopeless && watch(progress)
            };
            self.curve(&mut graph, magnitude, share, asked, &mut watch)
        };
        let corrects_orientation = turn.is_some();
        let point = largest(&point, before[0]);
        let turn = turn.filter(|_| point.certified.is_finite()).map(|turn| largest(&turn, before[1]));
        Some(AfterStep::new(self, &[Some(point), turn], before, corrects_orientation))
    }

    /// The largest size along a curve that leads to the errors, anywhere in the box.
    fn curve(
        &self,
        graph: &mut Graph,
        magnitude: &Magnitude,
        share: Symbol,
        asked: &Effort,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> bound::Bound {
        let mut moving = self.names();
        moving.push(Moving { symbol: share, range: [0.0, 1.0], home: 0.0, start: 0.0 });
        let gap = asked.gap.max(REMAINDER_EFFORT.gap);
        let effort = Effort { gap, boxes: asked.boxes.min(REMAINDER_EFFORT.boxes), ..REMAINDER_EFFORT };
        bound::largest(graph, magnitude, &moving, |symbol| home(symbol, &self.spec), &effort, watch)
    }

    /// The value of every variable and of all else that moves, and in words those of what is not at home.
    pub(super) fn place(&self, values: &[f64]) -> (IndexMap<String, f64>, String) {
        let Self { spec, spans } = self;
        let variables = spec.variables.iter().map(|variable| (variable.name.clone(), variable.home));
        let mut at: IndexMap<String, f64> = variables.collect();
        let mut place = Vec::new();
        for (span, value) in spans.iter().zip(values) {
            let name = name(span.symbol, spec);
            at.insert(name.to_owned(), *value);
            if *value != home(span.symbol, spec) {
                place.push(format!("{name} = {}", number::of_symbol(*value, span.symbol, spec)));
            }
        }
        (at, place.join(", "))
    }

    /// How many names move.
    pub(super) fn moving(&self) -> usize {
        self.spans.iter().filter(|span| span.range[0] < span.range[1]).count()
    }

    pub(super) fn names(&self) -> Vec<Moving> {
        let names = self.spans.iter().map(|Span { symbol, range }| Moving {
            symbol: *symbol,
            range: *range,
            home: home(*symbol, &self.spec),
            start: home(*symbol, &self.spec),
        });
        names.collect()
    }
}

/// Where something stands that does not move.
pub(super) fn home(symbol: Symbol, spec: &Spec) -> f64 {
    match symbol {
        Symbol::Variable(i) => spec.variables[i].home,
        Symbol::Parameter(i) => spec.parameters[i].value,
        Symbol::Input(i) => spec.inputs[i].value,
        // No error of the spec's own sources depends on anything else.
        _ => f64::NAN,
    }
}
