//! Alternative form of `ΔX = J_e ε`: accumulates the displacement of the current origin instead of
//! the tool point's.
//!
//! Let w be the displacement of the point at the frame's origin, considered as fixed to the tool, θ
//! the rotation of `Displacement`, and ρ the tool point relative to the frame:
//!
//! ```text
//! δ = w + θ × ρ        take in ε_i: w ← w + d_i        through a shift by t: w ← w − θ × t
//! ```
//!
//! A translation along an axis takes two products, where an error at a lever ρ takes six. Between
//! frames with a common origin there is nothing to compute.

use super::accumulate::{Accumulated, Links};
use super::displacement::Displacement;
use super::local::Local;
use super::six::vectors;
use crate::graph::{Graph, Node};

/// States at every frame that both forms are equal, and proposes to switch from one to the other
/// there.
pub(super) fn equate(graph: &mut Graph, links: &Links, errors: &[[Node; 6]]) {
    let zero = [graph.zero(); 3];
    let mut at_tool = Displacement::none(graph);
    let mut at_origin = zero;
    let mut lever = links.point(graph, errors.len(), zero);
    let mut origins = Vec::new();
    for (link, errors) in errors.iter().enumerate().rev() {
        at_tool.add(graph, *errors, lever);
        at_origin = graph.add_vectors(at_origin, vectors(*errors).0);
        let swing = graph.cross(at_tool.turn, lever);
        let there = graph.add_vectors(at_origin, swing);
        let back = graph.sub_vectors(at_tool.shift, swing);
        graph.equate_vectors(at_tool.shift, there);
        graph.equate_vectors(at_origin, back);
        // Path from the tip to this frame by origins, from here on by the tool point.
        origins.extend(at_origin);
        graph.propose_together([&origins[..], &there].concat());
        for motion in links.motions(link).iter().rev() {
            at_origin = match motion {
                Local::Shift(shift) => {
                    let swing = graph.cross(at_tool.turn, *shift);
                    graph.sub_vectors(at_origin, swing)
                }
                _ => motion.direction(graph, at_origin),
            };
            at_tool.turn(graph, motion);
            lever = motion.point(graph, lever);
        }
    }
    let swing = graph.cross(at_tool.turn, lever);
    let there = graph.add_vectors(at_origin, swing);
    graph.equate_vectors(at_tool.shift, there);
    graph.propose_together([&origins[..], &there].concat());
}
