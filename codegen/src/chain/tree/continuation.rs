//! Start and number of steps of the search for the passive variables, decided when code is
//! generated.

use abbe_core::VariableKind;
use abbe_spec::expr::Symbol;
use abbe_spec::{Spec, Variable};

use super::parts::Parts;
use crate::graph::{Graph, Node};

/// Start and number of steps of Newton's method for the passive variables.
pub(super) struct Continuation {
    /// Passive variables for which the loops close at home, as found from those of the spec; these
    /// themselves if none are found.
    pub(super) start: Vec<f64>,
    /// Number of equal steps by which the joint variables move from home to their values.
    pub(super) steps: usize,
}

/// Numbers of steps that are tried, the last one without comparison.
const STEPS: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Number of configurations at which numbers of steps are compared.
const SAMPLES: usize = 24;

/// Number of Newton's steps at the final values of the joint variables.
pub(crate) const REFINEMENTS: usize = 3;

/// Number of Newton's steps at home.
const STEPS_AT_HOME: usize = 50;

/// Largest square of the last step, relative to 1 plus that of the passive variables, of loops that
/// close: above the rounding errors in single precision, and such that the next step, of the order
/// of its square, is far below all errors.
pub(crate) const CLOSED: f64 = 1e-10;

impl Continuation {
    /// Closes the loops at home, and then finds the number of steps from there with which Newton's
    /// method finds the same passive variables as with twice as many, at samples of the joint
    /// variables within their limits. Parameters have their nominal values.
    pub(super) fn new(spec: &Spec) -> Self {
        let given = home(&spec.passive);
        if spec.loops.is_empty() {
            return Self { start: given, steps: 0 };
        }
        let newton = Newton::new(spec);
        let at_home = newton.closed(&given, &newton.home, STEPS_AT_HOME);
        let start = at_home.filter(|found| found.iter().all(|value| value.is_finite())).unwrap_or(given);
        let is_same =
            |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6 * b.abs().max(1.0));
        let mut needed = STEPS[0];
        for sample in 0..SAMPLES {
            let variables = spec.variables.iter().enumerate();
            let q: Vec<f64> = variables.map(|(i, variable)| sampled(variable, i, sample)).collect();
            let found: Vec<Option<Vec<f64>>> =
                STEPS.iter().map(|steps| newton.closed(&start, &q, *steps)).collect();
            let Some(last) = &found[STEPS.len() - 1] else { continue };
            let differs = |found: &Option<Vec<f64>>| found.as_ref().is_none_or(|found| !is_same(found, last));
            let enough = found.iter().rposition(differs).map_or(0, |index| index + 1);
            needed = needed.max(STEPS[enough]);
        }
        Self { start, steps: (2 * needed).min(STEPS[STEPS.len() - 1]) }
    }
}

/// Newton's method for the passive variables of the nominal machine.
struct Newton<'s> {
    spec: &'s Spec,
    graph: Graph,
    step: Vec<Node>,
    home: Vec<f64>,
}

impl<'s> Newton<'s> {
    fn new(spec: &'s Spec) -> Self {
        let mut graph = Graph::with_tables(&spec.tables);
        let parts = Parts::new(&mut graph, spec);
        let residual = parts.residual(&mut graph);
        let step = parts.factored.solve(&mut graph, &residual);
        Self { spec, graph, step, home: home(&spec.variables) }
    }

    /// Returns the passive variables at q, found from those at home; `None` if the last step is not
    /// small.
    fn closed(&self, start: &[f64], q: &[f64], steps: usize) -> Option<Vec<f64>> {
        let mut p = start.to_vec();
        let mut change = f64::INFINITY;
        for k in 1..=steps + REFINEMENTS {
            let share = (k as f64 / steps as f64).min(1.0);
            let newton = self.graph.evaluate(&self.step, |symbol| match symbol {
                Symbol::Variable(i) => self.home[i] + share * (q[i] - self.home[i]),
                Symbol::Parameter(i) => self.spec.parameters[i].value,
                Symbol::Local(i) => p[i],
                _ => f64::NAN,
            });
            p.iter_mut().zip(&newton).for_each(|(p, step)| *p -= step);
            change = squares(&newton);
        }
        (change <= CLOSED * (1.0 + squares(&p))).then_some(p)
    }
}

/// Returns the values of variables at home.
pub(super) fn home(variables: &[Variable]) -> Vec<f64> {
    variables.iter().map(|variable| variable.home).collect()
}

fn squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

/// Returns a value within the limits, by multiples of the golden ratio that differ for each
/// variable; within a turn of home without limits.
fn sampled(variable: &Variable, index: usize, sample: usize) -> f64 {
    let [lower, upper] = variable.limits;
    let half = match variable.kind {
        VariableKind::Revolute => std::f64::consts::PI,
        VariableKind::Prismatic => 0.0,
    };
    let lower = if lower.is_finite() { lower } else { variable.home - half };
    let upper = if upper.is_finite() { upper } else { variable.home + half };
    let share =
        (0.618_033_988_749_894_9 * (sample + 1) as f64 * (index + 1) as f64 + 0.1 * index as f64).fract();
    lower + (upper - lower) * share
}
