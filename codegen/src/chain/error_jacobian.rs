//! `J_e` by the structured product rule: `∂A_T/∂ε_ik = T_i G_k S_i`.

use super::rows::Rows;
use crate::expr::Motion;
use crate::graph::{Frame, Graph, Node, Vector};
use crate::spec::Component;

/// The six columns of every frame: with `T_i = (R_i, p_i)` and the tool point `p_T` these are
///
/// ```text
/// translation along e    (R_i e ; 0)
/// rotation about a       (R_i a × (p_T − p_i) ; R_i a)
/// ```
pub(super) fn columns(graph: &mut Graph, frames: &[Frame], tool: &Frame, rows: &Rows) -> Vec<[Node; 6]> {
    let mut columns = Vec::with_capacity(6 * frames.len());
    for (i, frame) in frames.iter().enumerate() {
        let lever = lever(graph, frame, tool, i + 1);
        let zero = [graph.zero(); 3];
        for component in Component::ALL {
            columns.push(match component.motion() {
                (Motion::Translation, axis) => rows.column(graph, frame.axes[axis], zero),
                (Motion::Rotation, axis) => {
                    let velocity = graph.cross(frame.axes[axis], lever);
                    rows.column(graph, velocity, frame.axes[axis])
                }
            });
        }
    }
    columns
}

/// `p_T − p_i`.
fn lever(graph: &mut Graph, frame: &Frame, tool: &Frame, i: usize) -> Vector {
    let lever = graph.sub_vectors(tool.position, frame.position);
    for (node, axis) in lever.into_iter().zip("xyz".chars()) {
        graph.propose(node, || format!("lever{i}_{axis}"));
    }
    lever
}
