//! Columns of `J_q`, and effects of errors, at any frame of the chain and in its axes.

use abbe_core::VariableKind;
use abbe_spec::{ChainNumber, Spec};

use super::accumulate::{Accumulated, Links};
use super::deviation::frame_twists;
use super::displacement::Displacement;
use super::local::Local;
use super::six::six;
use crate::graph::{Graph, Node, Vector};

/// Number of joints that control the full pose. With fewer, only the tool point is considered.
pub(super) const JOINTS_OF_A_POSE: usize = 6;
/// Number of joints that control the tool point.
pub(super) const JOINTS_OF_A_POINT: usize = 3;

/// Returns the effect of a unit of each joint, as errors of all frames.
pub(super) fn errors_of_joints(graph: &mut Graph, spec: &Spec) -> Vec<Vec<[Node; 6]>> {
    let errors = |joint: usize| {
        let mut errors = vec![[graph.zero(); 6]; spec.frames.len()];
        for twist in frame_twists(graph, spec, ChainNumber::Joint(joint)) {
            errors[twist.frame] = six(twist.velocity, twist.rotation);
        }
        errors
    };
    (0..spec.variables.len()).map(errors).collect()
}

/// Returns 1 rad or 1 m in the unit of each joint.
pub(super) fn units(spec: &Spec) -> Vec<f64> {
    let unit = |kind: VariableKind| kind.either(1.0, 1.0 / spec.length.in_metres());
    spec.variables.iter().map(|variable| unit(variable.kind)).collect()
}

/// Returns the effect of errors of all frames on the tool point, in the axes of a frame.
pub(super) fn at_tool(graph: &mut Graph, links: &Links, errors: &[[Node; 6]], frame: usize) -> Displacement {
    let origin = [graph.zero(); 3];
    let lever = (frame + 1..=errors.len()).rev().fold(origin, |point, link| links.point(graph, link, point));
    let there = at_origin(graph, links, errors, frame);
    Displacement { shift: moved(graph, &there, lever, 1.0), ..there }
}

/// Returns the effect of errors of all frames on the point of the tool at the origin of a frame, in
/// its axes.
pub(super) fn at_origin(
    graph: &mut Graph,
    links: &Links,
    errors: &[[Node; 6]],
    frame: usize,
) -> Displacement {
    let take_in = |graph: &mut Graph, sum: &mut Displacement, errors: &[Node; 6]| {
        let here = [graph.zero(); 3];
        sum.add(graph, *errors, here);
    };
    let mut inner = Displacement::none(graph);
    for (link, before) in errors.iter().enumerate().take(frame) {
        take_in(graph, &mut inner, before);
        for motion in links.motions(link + 1) {
            match motion {
                Local::Shift(shift) => inner.shift = moved(graph, &inner, *shift, 1.0),
                _ => {
                    inner.shift = motion.direction_behind(graph, inner.shift);
                    inner.turn = motion.direction_behind(graph, inner.turn);
                }
            }
        }
    }
    let mut outer = Displacement::none(graph);
    for (link, behind) in errors.iter().enumerate().skip(frame).rev() {
        take_in(graph, &mut outer, behind);
        for motion in links.motions(link).iter().rev().filter(|_| link > frame) {
            match motion {
                Local::Shift(shift) => outer.shift = moved(graph, &outer, *shift, -1.0),
                _ => outer.turn(graph, motion),
            }
        }
    }
    Displacement {
        shift: graph.add_vectors(inner.shift, outer.shift),
        turn: graph.add_vectors(inner.turn, outer.turn),
    }
}

/// Returns the velocity of the point at (or, with a negative sign, before) a given offset.
fn moved(graph: &mut Graph, sum: &Displacement, shift: Vector, sign: f64) -> Vector {
    let swing = graph.cross(sum.turn, shift);
    if sign > 0.0 { graph.add_vectors(sum.shift, swing) } else { graph.sub_vectors(sum.shift, swing) }
}
