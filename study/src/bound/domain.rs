//! The box in which errors are sought.

use std::sync::Arc;

use abbe_codegen::chain::{self, Apart, Magnitude};
use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::expr::Symbol;
use abbe_codegen::graph::{Graph, Node};
use abbe_codegen::spec::Spec;
use abbe_interpreter::bound::{self, Effort, Limits, MOST_MOVING, Moving, Progress};

use crate::machine::Machine;
use crate::mistake;
use crate::study_file::Study;
use crate::workspace::Span;

use super::report::{Classes, Remainder};

/// What first order leaves out is small: it is known closely enough when it is known to a half, or after so many boxes.
const REMAINDER_EFFORT: Effort = Effort { gap: 0.5, boxes: 20_000, at_most: f64::INFINITY };
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
        magnitude: Magnitude,
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
        let mut moving = self.names();
        moving.push(Moving { symbol: share, range: [0.0, 1.0], home: 0.0, start: 0.0 });
        let gap = asked.gap.max(REMAINDER_EFFORT.gap);
        let effort = Effort { gap, boxes: asked.boxes.min(REMAINDER_EFFORT.boxes), ..REMAINDER_EFFORT };
        let still = |symbol| home(symbol, &self.spec);
        Some(Remainder::new(&bound::largest(&mut graph, magnitude, &moving, still, &effort, watch)))
    }

    /// How many names move.
    pub(super) fn moving(&self) -> usize {
        self.spans.iter().filter(|span| span.range[0] < span.range[1]).count()
    }

    fn names(&self) -> Vec<Moving> {
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
