//! Another way to `ΔX = J_e ε`: what the frames do to the origin that has been reached, and with that to the tool point.
//!
//! With w the displacement of the point at the frame's origin, as if it were fixed to the tool, θ that of `Displacement` and
//! ρ the tool point as seen from the frame:
//!
//! ```text
//! δ = w + θ × ρ        take in ε_i: w ← w + d_i        through a shift by t: w ← w − θ × t
//! ```
//!
//! A shift along an axis takes two products where an error at a lever ρ takes six; and where several frames have one origin
//! nothing has to be done between them.

use super::accumulate::{Accumulated, Links};
use super::displacement::Displacement;
use super::local::Local;
use super::six::vectors;
use crate::graph::{Graph, Node};

/// States at every frame that both ways are equal; proposes to change there from one to the other.
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
        // From the tip to this frame by origins, from here by the tool point.
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
