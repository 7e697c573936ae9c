//! The exact chain with the errors of the spec's own sources: equation (6) with true rotations.

use super::walk::{Step, walk};
use crate::expr::{Motion, motion};
use crate::graph::{Frame, Graph, Node};
use crate::spec::{Component, Spec};

/// `A_1 E_1 A_2 E_2 … A_n E_n · T`; errors that are always zero are left out.
pub(super) fn real_pose(graph: &mut Graph, spec: &Spec, errors: &[[Node; 6]]) -> Frame {
    let mut unused: Vec<Step> = Vec::new();
    let mut pose = graph.identity();
    for (frame, errors) in spec.frames.iter().zip(errors) {
        pose = walk(graph, pose, &frame.factors, &mut unused);
        pose = displaced(graph, pose, errors);
    }
    walk(graph, pose, &spec.tool, &mut unused)
}

/// A pose and `E = T(e_x, e_y, e_z) R_y(e_s) R_z(e_r) R_x(e_p)`, in the order of ε.
pub(crate) fn displaced(graph: &mut Graph, mut pose: Frame, errors: &[Node; 6]) -> Frame {
    for (component, error) in Component::ALL.into_iter().zip(errors) {
        if *error == graph.zero() {
            continue;
        }
        pose = match motion(component) {
            (Motion::Translation, axis) => graph.moved(&pose, axis, *error),
            (Motion::Rotation, axis) => graph.turned(&pose, axis, *error),
        };
    }
    pose
}
