//! The enclosing box of a workspace.

use abbe_spec::{Spec, expr::Symbol, option::SET};
use std::sync::Arc;

use abbe::analysis::{BudgetOptions, Configuration, Measurand, error_budget};
use abbe_bound::{Effort, Limits, MOST_MOVING, Moving, Progress, Watch};
use abbe_codegen::chain::{DIRECTION, Implicit, Magnitude, PerFrameMagnitudes};
use abbe_codegen::graph::{Graph, Node};
use indexmap::IndexMap;

use crate::workspace::{Span, in_one_run};
use crate::{Machine, Result, Study, mistake, number};

/// Largest number of names that may move. The search for the worst case moves two more.
const MOST_NAMES: usize = MOST_MOVING - DIRECTION.len();

/// Number of boxes after which an infinite bound is given up.
pub(super) const GIVE_UP_BOXES: usize = 3_000;

/// Box of joints, parameters and inputs that encloses the configurations of a study.
pub(super) struct Domain {
    pub(super) spec: Arc<Spec>,
    pub(super) spans: Vec<Span>,
    /// Passive variables at home, where the loops close.
    passive: Vec<f64>,
    /// Passive variables that are given.
    pub(super) given: Vec<usize>,
}

impl Domain {
    /// Creates the box of a machine and a study; changes are already applied. Fails if the loops
    /// are open at home, a span is unlimited or too many names move.
    pub(super) fn new(machine: &Machine, study: &Study) -> Result<Self> {
        let (spec, manipulator) = (machine.spec.clone(), machine.evaluator(true));
        let spans = study.region.spans(&spec, &*manipulator, &machine.origin)?;
        let mut passive = vec![0.0; spec.passive.len()];
        let home = Configuration::home(manipulator.description());
        let closed = manipulator.passive(&home.q, &home.s, &mut passive);
        closed.map_err(|error| {
            mistake::not_evaluated(&machine.origin, "home", &error, manipulator.description())
        })?;
        let given = if study.region.is_platform() { 0..passive.len() } else { 0..0 };
        let domain = Self { spec, spans, passive, given: given.collect() };
        let moving = domain.moving_count();
        if moving > MOST_NAMES {
            return Err(mistake::with_help(
                &machine.origin,
                format!(
                    "{moving} joints, parameters and inputs vary; a bound can be computed for up \
                     to {MOST_NAMES}"
                ),
                format!(
                    "fix some of them: use a study whose workspace is a `grid`, which varies only the \
                 joints that it names, or fix inputs by `{SET}`"
                ),
            ));
        }
        Ok(domain)
    }

    /// Returns the configuration of the study with the largest worst case over all signs, and the
    /// worst cases of position and orientation: what a sweep finds counts for the bound, too.
    /// `None` if there is none.
    pub(super) fn worst_of_workspace(
        &self,
        machine: &Machine,
        study: &Study,
    ) -> Option<(Vec<f64>, [f64; 2])> {
        let manipulator = &*machine.evaluator(true);
        let workspace = study.region.workspace(manipulator, None).ok()?;
        in_one_run(workspace.len(), "").ok()?;
        let budget = error_budget(manipulator, &*workspace, BudgetOptions::default(), &mut ()).ok()?;
        let worst = budget.combined.worst_case_radius.configuration?;
        let Configuration { q, s, u } = workspace.configuration(worst).ok()?;
        let mut passive = self.passive.clone();
        manipulator.passive(&q, &s, &mut passive).ok()?;
        let value = |span: &Span| match span.symbol {
            Symbol::Variable(i) => q[i],
            Symbol::Passive(i) => passive[i],
            Symbol::Parameter(i) => s[i],
            Symbol::Input(i) => u[i],
            _ => f64::NAN,
        };
        let at = self.spans.iter().map(|span| value(span).clamp(span.range[0], span.range[1]));
        Some((at.collect(), Measurand::ALL.map(|of| budget.errors(of).1.worst_case_radius.value)))
    }

    /// Bounds the largest magnitude of an error over the box. The search starts at `start`, or at
    /// home.
    pub(super) fn largest(
        &self,
        graph: &mut Graph,
        magnitude: &Magnitude,
        implicit: &[Implicit],
        start: Option<&[f64]>,
        effort: &Effort,
        watch: &mut Watch<'_>,
    ) -> abbe_bound::Bound {
        let mut names = self.names();
        for (name, start) in names.iter_mut().zip(start.unwrap_or_default()) {
            name.start = *start;
        }
        let mut watch = |progress: &Progress| {
            let is_given_up = progress.certified.is_infinite() && progress.boxes >= GIVE_UP_BOXES;
            (implicit.is_empty() || !is_given_up) && watch(progress)
        };
        let still = |symbol| self.home(symbol);
        abbe_bound::largest(graph, magnitude, implicit, &names, &still, effort, &mut watch)
    }

    /// Bounds the norms by the sum of their parts; infinite unless the frames are a chain.
    pub(super) fn limits(&self, graph: &mut Graph, apart: Option<&PerFrameMagnitudes>) -> Limits {
        let none = Limits { position: [f64::INFINITY; 3], rotation: [f64::INFINITY; 3] };
        apart.map_or(none, |apart| {
            abbe_bound::limits(graph, apart, &self.names(), &|symbol| self.home(symbol))
        })
    }

    /// Returns true if the first node depends on fewer moving names than the second.
    pub(super) fn depends_on_fewer(&self, graph: &Graph, nodes: [Node; 2]) -> bool {
        let [first, second] = nodes.map(|node| {
            let symbols = graph.symbols(&[node]);
            let moving = self.spans.iter().filter(|span| span.range[0] < span.range[1]);
            moving.filter(|span| symbols.contains(&span.symbol)).count()
        });
        first < second
    }

    /// Returns the values of all variables and of every moving parameter and input, and a
    /// description of those that are not at home.
    pub(super) fn describe(&self, values: &[f64]) -> (IndexMap<String, f64>, String) {
        let Self { spec, spans, .. } = self;
        let variables = spec.variables.iter().map(|variable| (variable.name.clone(), variable.home));
        // Where passive variables are given, the others follow.
        let mut at: IndexMap<String, f64> = variables.filter(|_| self.given.is_empty()).collect();
        let mut description = Vec::new();
        for (span, value) in spans.iter().zip(values) {
            let name = spec.name_of(span.symbol);
            at.insert(name.to_owned(), *value);
            if *value != self.home(span.symbol) {
                description.push(format!("{name} = {}", number::of_symbol(*value, span.symbol, spec)));
            }
        }
        (at, description.join(", "))
    }

    /// Returns the number of names that move.
    pub(super) fn moving_count(&self) -> usize {
        self.spans.iter().filter(|span| span.range[0] < span.range[1]).count()
    }

    pub(super) fn names(&self) -> Vec<Moving> {
        let names = self.spans.iter().map(|Span { symbol, range }| Moving {
            symbol: match *symbol {
                Symbol::Passive(i) => Symbol::Local(i),
                symbol => symbol,
            },
            range: *range,
            home: self.home(*symbol),
            start: self.home(*symbol),
        });
        names.collect()
    }

    /// Returns the home or nominal value of a symbol.
    pub(super) fn home(&self, symbol: Symbol) -> f64 {
        match symbol {
            Symbol::Variable(i) => self.spec.variables[i].home,
            Symbol::Passive(i) | Symbol::Local(i) => self.passive.get(i).copied().unwrap_or(f64::NAN),
            Symbol::Parameter(i) => self.spec.parameters[i].value,
            Symbol::Input(i) => self.spec.inputs[i].value,
            // The errors of a spec depend on no other symbols.
            _ => f64::NAN,
        }
    }
}
