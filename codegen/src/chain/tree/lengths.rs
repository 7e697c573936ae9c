//! Errors of the lengths of legs and struts as errors of the frames at their ends.

use abbe_spec::expr::Symbol;
use abbe_spec::{Loop, Spec};

use super::closure::Ends;
use super::view::View;
use crate::chain::frame_twist::FrameTwist;
use crate::graph::{Graph, Node, in_programs};

/// Adds the twists that are equivalent to the change of lengths per unit of a symbol. A leg from b
/// to a that is longer by `δl` has the effect of its end a, displaced against the direction `u = (p_a
/// − p_b) / |p_a − p_b|`, or of its end b, displaced along it:
///
/// ```text
/// δp_a = −u δl        δp_b = u δl
/// ```
pub(crate) fn add_lengths(graph: &mut Graph, spec: &Spec, symbol: Symbol, twists: &mut [FrameTwist]) {
    for (closed, slope) in spec.loops.iter().zip(length_slopes(graph, spec, symbol)) {
        let Some((end, sign)) = spec.own_end(closed).filter(|_| slope != graph.zero()) else { continue };
        let ends = Ends::new(spec, closed);
        let view = View::new(graph, spec, ends.root(spec));
        let [a, b] = closed.frames.map(|frame| *view.pose(frame));
        let difference = graph.sub_vectors(a.position, b.position);
        let distance = graph.norm(difference);
        let signed = graph.constant(sign);
        let change = graph.mul(signed, slope);
        let per_length = graph.div(change, distance);
        let shift = graph.scale(per_length, difference);
        let shift = view.pose(Some(end)).axes.map(|axis| graph.dot(axis, shift));
        twists[end].velocity = graph.add_vectors(twists[end].velocity, shift);
    }
}

/// Returns the change of the length of each loop per unit of a symbol; zero without a length.
pub(crate) fn length_slopes(graph: &mut Graph, spec: &Spec, symbol: Symbol) -> Vec<Node> {
    let slope = |closed: &Loop| match closed.closure.length() {
        Some(length) => {
            let length = graph.lower(length);
            graph.diff(length, in_programs(symbol))
        }
        None => graph.zero(),
    };
    spec.loops.iter().map(slope).collect()
}
