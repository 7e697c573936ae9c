//! Newton's steps that close the loops, of the nominal machine and with errors.

use abbe_core::{Class, VariableKind};
use abbe_spec::expr::Symbol;
use abbe_spec::{Closure, Spec, Variable};

use super::closure::{self, Ends};
use super::factored::Factored;
use super::model::Parts;
use crate::chain::real::RealChain;
use crate::chain::sources::{Causes, PlacedErrors};
use crate::graph::{Frame, Graph, Node};

/// How the loops close. Passive variables are local symbols, from 0.
#[derive(Clone, Debug)]
pub(crate) struct Loops {
    /// Values of the passive variables at home, from which they are found.
    pub(crate) passive_home: Vec<f64>,
    /// Values of the joint variables at home.
    pub(crate) home: Vec<f64>,
    /// Number of equal steps by which the joint variables move from home to their values.
    pub(crate) continuation: usize,
    /// Newton's step `φ_p⁻¹ φ` of the nominal machine, to be subtracted from p.
    pub(crate) step: Vec<Node>,
    /// The machine with the errors of the repeatable sources.
    pub(crate) real: RealNodes,
    /// The machine with the errors of all sources, each times its magnitude.
    pub(crate) drawn: RealNodes,
    /// The machine with given errors of the frames.
    pub(crate) displaced: RealNodes,
    /// The passive variables.
    pub(crate) passive: Vec<Node>,
}

/// A machine with errors.
#[derive(Clone, Debug)]
pub(crate) struct RealNodes {
    /// The errors, at the nominal values of the passive variables. The other nodes read them as
    /// local symbols after the passive variables.
    pub(crate) errors: Vec<Node>,
    /// Newton's step of the machine with errors, to be subtracted from its p; empty without loops.
    pub(crate) step: Vec<Node>,
    /// Pose of the tool point.
    pub(crate) pose: Frame,
}

impl Loops {
    pub(super) fn new(
        graph: &mut Graph,
        spec: &Spec,
        parts: &Parts<'_>,
        causes: &Causes,
        errors: &[[Node; 6]],
    ) -> Self {
        let residual = parts.residual(graph);
        let step = parts.factored.solve(graph, &residual);
        let repeatable = spec.enabled_sources().map(|source| source.class == Class::Repeatable);
        let magnitudes: Vec<Node> =
            repeatable.map(|one| graph.constant(if one { 1.0 } else { 0.0 })).collect();
        let real = RealNodes::new(graph, spec, causes, &magnitudes);
        let magnitudes: Vec<Node> =
            (0..spec.enabled_sources().count()).map(|i| graph.symbol(Symbol::Magnitude(i))).collect();
        let drawn = RealNodes::new(graph, spec, causes, &magnitudes);
        let displaced = RealNodes::displaced(graph, spec, errors);
        Self {
            passive_home: home(&spec.passive),
            home: home(&spec.variables),
            continuation: if spec.loops.is_empty() { 0 } else { continuation(spec) },
            step,
            real,
            drawn,
            displaced,
            passive: (0..spec.passive.len()).map(|i| graph.symbol(Symbol::Local(i))).collect(),
        }
    }
}

/// Returns the values of variables at home.
fn home(variables: &[Variable]) -> Vec<f64> {
    variables.iter().map(|variable| variable.home).collect()
}

/// Numbers of steps that are tried, the last one without comparison.
const STEPS: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Number of configurations at which numbers of steps are compared.
const SAMPLES: usize = 24;

/// Returns the number of steps from home at which Newton's method finds the same passive variables
/// as with twice as many, at samples of the joint variables within their limits.
fn continuation(spec: &Spec) -> usize {
    let mut graph = Graph::with_tables(&spec.tables);
    let parts = Parts::new(&mut graph, spec);
    let residual = parts.residual(&mut graph);
    let step = parts.factored.solve(&mut graph, &residual);
    let (start, home) = (home(&spec.passive), home(&spec.variables));
    let closed = |q: &[f64], steps: usize| -> Option<Vec<f64>> {
        let mut p = start.clone();
        let mut change = f64::INFINITY;
        for k in 1..=steps + REFINEMENTS {
            let share = (k as f64 / steps as f64).min(1.0);
            let newton = graph.evaluate(&step, |symbol| match symbol {
                Symbol::Variable(i) => home[i] + share * (q[i] - home[i]),
                Symbol::Parameter(i) => spec.parameters[i].value,
                Symbol::Local(i) => p[i],
                _ => f64::NAN,
            });
            p.iter_mut().zip(&newton).for_each(|(p, step)| *p -= step);
            change = squares(&newton);
        }
        (change <= CLOSED * (1.0 + squares(&p))).then_some(p)
    };
    let is_same =
        |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6 * b.abs().max(1.0));
    let mut needed = STEPS[0];
    for sample in 0..SAMPLES {
        let q: Vec<f64> =
            spec.variables.iter().enumerate().map(|(i, variable)| sampled(variable, i, sample)).collect();
        let found: Vec<Option<Vec<f64>>> = STEPS.iter().map(|steps| closed(&q, *steps)).collect();
        let Some(last) = &found[STEPS.len() - 1] else { continue };
        let differs = |found: &Option<Vec<f64>>| found.as_ref().is_none_or(|found| !is_same(found, last));
        let enough = found.iter().rposition(differs).map_or(0, |index| index + 1);
        needed = needed.max(STEPS[enough]);
    }
    (2 * needed).min(STEPS[STEPS.len() - 1])
}

/// Number of Newton's steps at the final values of the joint variables.
pub(crate) const REFINEMENTS: usize = 3;

/// Largest square of the last step, relative to 1 plus that of the passive variables, of loops that
/// close: above the rounding errors in single precision, and such that the next step, of the order
/// of its square, is far below all errors.
pub(crate) const CLOSED: f64 = 1e-10;

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

impl RealNodes {
    /// Returns the machine with the errors of sources, each times its magnitude.
    fn new(graph: &mut Graph, spec: &Spec, causes: &Causes, magnitudes: &[Node]) -> Self {
        let mut causes = causes.clone();
        let mut errors = Vec::new();
        let one = graph.constant(1.0);
        let of_errors = causes.errors.iter_mut().flat_map(|placed| {
            let magnitude = magnitudes[placed.source];
            placed.errors.iter_mut().map(move |error| (magnitude, error))
        });
        let of_numbers = causes
            .deviations
            .iter_mut()
            .map(|deviation| (magnitudes[deviation.source], &mut deviation.error));
        for (magnitude, error) in of_errors.chain(of_numbers) {
            *error = graph.mul(magnitude, *error);
            // Without loops nothing is repeated, and errors need no array.
            if !spec.loops.is_empty() && graph.value(*error).is_none() {
                errors.push(*error);
                *error = graph.symbol(Symbol::Local(spec.passive.len() + errors.len() - 1));
            }
        }
        let chain = RealChain::new(graph, spec, &causes, vec![one; magnitudes.len()]);
        Self::of_chain(graph, spec, &chain, errors)
    }

    /// Returns the machine with given errors of its frames.
    fn displaced(graph: &mut Graph, spec: &Spec, errors: &[[Node; 6]]) -> Self {
        let placed = |(frame, errors): (usize, &[Node; 6])| PlacedErrors {
            source: 0,
            frame,
            place: None,
            errors: *errors,
        };
        let errors = errors.iter().enumerate().map(placed).collect();
        let causes = Causes { errors, deviations: Vec::new() };
        let one = graph.constant(1.0);
        let chain = RealChain::new(graph, spec, &causes, vec![one]);
        Self::of_chain(graph, spec, &chain, Vec::new())
    }

    /// Returns `true` if the errors move the passive variables from their nominal values.
    pub(crate) fn moves_passive(&self, nominal: &Loops) -> bool {
        self.step != nominal.step
    }

    fn of_chain(graph: &mut Graph, spec: &Spec, chain: &RealChain<'_>, errors: Vec<Node>) -> Self {
        let poses = chain.poses(graph);
        let mut residual = Vec::new();
        for closed in &spec.loops {
            let ends = Ends::new(spec, closed);
            let poses = chain.poses_below(graph, ends.root(spec));
            let identity = graph.identity();
            let length = match &closed.closure {
                Closure::Distance(length) => Some(chain.length(graph, length)),
                Closure::Coordinates(_) => None,
            };
            let pose = |frame: Option<usize>| frame.map_or(identity, |frame| poses[frame]);
            residual.extend(closure::residual(graph, ends, &closed.closure, length, pose));
        }
        let columns = (0..spec.passive.len()).map(|i| graph.diff_all(&residual, Symbol::Local(i))).collect();
        let step = Factored::new(graph, columns).solve(graph, &residual);
        Self { errors, step, pose: poses[poses.len() - 1] }
    }
}
