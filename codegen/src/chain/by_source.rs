//! Effects of the spec's own sources on the tool point.

use abbe_spec::Spec;

use super::{Displacement, EffectNode, Links, Rows};
use crate::graph::{Graph, Node, Six};

/// Returns `ΔX = J_e ε`, accumulated along the chain.
pub(super) fn along(graph: &mut Graph, links: &Links, rows: &Rows, errors: &[Six]) -> Six {
    let none = Displacement::none(graph);
    links.accumulate(graph, errors, 0, none).column(graph, rows)
}

/// Returns the six errors of every frame that each source causes alone; random sources at their
/// standard deviation or magnitude.
pub(super) fn errors_by_source(zero: Node, spec: &Spec, effects: &[EffectNode]) -> Vec<Vec<Six>> {
    let mut errors = vec![vec![[zero; 6]; spec.frames.len()]; spec.enabled_sources().count()];
    for effect in effects {
        errors[effect.source][effect.frame][effect.component as usize] = effect.value;
    }
    errors
}

/// Returns `ΔX = J_e ε` from the columns of `J_e`.
pub(super) fn product(graph: &mut Graph, columns: &[Six], errors: &[Six]) -> Six {
    let mut sum = [graph.zero(); 6];
    for (column, error) in columns.iter().zip(errors.as_flattened()) {
        for (sum, entry) in sum.iter_mut().zip(column) {
            *sum = graph.add_product(*sum, *error, *entry);
        }
    }
    sum
}
