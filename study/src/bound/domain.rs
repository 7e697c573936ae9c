//! The box in which errors are sought.

use std::sync::Arc;

use abbe_bound::{Effort, Limits, MOST_MOVING, Moving, Progress};
use abbe_codegen::chain::{Apart, Magnitude};
use abbe_codegen::graph::{Graph, Node};
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::expr::Symbol;
use indexmap::IndexMap;

use crate::machine::Machine;
use crate::mistake;
use crate::number;
use crate::study_file::Study;
use crate::workspace::{Span, name};

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
    ) -> abbe_bound::Bound {
        let still = |symbol| home(symbol, &self.spec);
        let mut names = self.names();
        for (name, start) in names.iter_mut().zip(start.unwrap_or_default()) {
            name.start = *start;
        }
        abbe_bound::largest(graph, magnitude, &names, still, effort, watch)
    }

    /// What norms cannot exceed because of their parts.
    pub(super) fn limits(&self, graph: &mut Graph, apart: &Apart) -> Limits {
        abbe_bound::limits(graph, apart, &self.names(), |symbol| home(symbol, &self.spec))
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
