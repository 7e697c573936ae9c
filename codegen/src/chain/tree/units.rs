//! Units of equations and variables, and values at home.

use abbe_spec::{Spec, Symbol, Variable};

use crate::chain::transform;
use crate::graph::{Graph, Node};

/// Units by which lengths and angles compare: lengths of loops, or 1 rad.
#[derive(Clone, Debug)]
pub(crate) struct Units {
    pub(super) equations: Vec<f64>,
    pub(super) passive: Vec<f64>,
    pub(super) variables: Vec<f64>,
}

impl Units {
    /// Finds the length of each loop: the sum of the lengths of its frames' transforms at home, and
    /// of its leg.
    pub(super) fn new(spec: &Spec, graph: &mut Graph) -> Self {
        let passive: Vec<f64> = spec.passive.iter().map(|variable| variable.home).collect();
        let mut length = |closed: &abbe_spec::Loop| {
            let frames = spec.tree().between(closed);
            let mut nodes: Vec<Node> = frames
                .iter()
                .flat_map(|frame| transform(graph, &spec.frames[*frame].factors).position)
                .collect();
            let (zero, leg) = (graph.zero(), closed.closure.length().map(|length| graph.lower(length)));
            nodes.extend(leg.into_iter().flat_map(|leg| [leg, zero, zero]));
            let numbers = graph.evaluate(&nodes, at_home(spec, &passive));
            let lengths = numbers.chunks_exact(3).map(|xyz| xyz.iter().map(|x| x * x).sum::<f64>().sqrt());
            let length: f64 = lengths.sum();
            if length > 0.0 && length.is_finite() { length } else { 1.0 }
        };
        let lengths: Vec<f64> = spec.loops.iter().map(&mut length).collect();
        let longest = lengths.iter().copied().reduce(f64::max).unwrap_or(1.0);
        let unit = |variable: &Variable| variable.kind.either(1.0, longest);
        let of_loop = |(closed, length): (&abbe_spec::Loop, f64)| {
            let unit = |i| if closed.closure.is_angle(i) { 1.0 } else { length };
            (0..closed.closure.equations()).map(unit).collect::<Vec<f64>>()
        };
        Self {
            equations: spec.loops.iter().zip(lengths).flat_map(of_loop).collect(),
            passive: spec.passive.iter().map(unit).collect(),
            variables: spec.variables.iter().map(unit).collect(),
        }
    }
}

/// Returns the value of a symbol at home, without errors; `passive` are the passive variables.
pub(super) fn at_home<'a>(spec: &'a Spec, passive: &'a [f64]) -> impl Fn(Symbol) -> f64 + 'a {
    move |symbol| match symbol {
        Symbol::Variable(i) => spec.variables[i].home,
        Symbol::Parameter(i) => spec.parameters[i].value,
        Symbol::Input(i) => spec.inputs[i].value,
        Symbol::Local(i) | Symbol::Passive(i) => passive.get(i).copied().unwrap_or(0.0),
        Symbol::Magnitude(_) => 1.0,
        Symbol::Error(_) | Symbol::Target(_) => 0.0,
    }
}

/// Largest number of Newton's steps at home.
const STEPS_AT_HOME: usize = 50;

/// Closes the loops at home by Newton's method from the passive variables of the spec, and returns
/// these themselves if that fails.
pub(super) fn passive_at_home(
    spec: &Spec,
    graph: &mut Graph,
    residual: &[Node],
    step: &[Node],
    units: &Units,
) -> Vec<f64> {
    let given: Vec<f64> = spec.passive.iter().map(|variable| variable.home).collect();
    let mut p = given.clone();
    for _ in 0..STEPS_AT_HOME {
        let step = graph.evaluate(step, at_home(spec, &p));
        p.iter_mut().zip(&step).for_each(|(p, step)| *p -= step);
    }
    let residual = graph.evaluate(residual, at_home(spec, &p));
    let is_closed = residual.iter().zip(&units.equations).all(|(value, unit)| value.abs() <= 1e-10 * unit);
    if is_closed && p.iter().all(|value| value.is_finite()) { p } else { given }
}
