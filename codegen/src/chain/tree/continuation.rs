//! Passive variables at home.

use abbe_spec::Spec;

use super::units::{Units, at_home};
use crate::graph::{Graph, Node};

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
