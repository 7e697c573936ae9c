//! `J_e` by the structured product rule: `∂A_T/∂ε_ik = T_i G_k S_i`.

use super::moments::Moments;
use super::rows::Rows;
use crate::expr::Motion;
use crate::graph::{Frame, Graph, Node};
use crate::spec::Component;

/// The six columns of every frame: with `T_i = (R_i, p_i)` and the tool point `p_T` these are
///
/// ```text
/// translation along e    (R_i e ; 0)
/// rotation about a       (R_i a × (p_T − p_i) ; R_i a)
/// ```
pub(super) fn columns(
    graph: &mut Graph,
    frames: &[Frame],
    mut moments: Moments<'_>,
    rows: &Rows,
) -> Vec<[Node; 6]> {
    let mut columns = Vec::with_capacity(6 * frames.len());
    for (i, frame) in frames.iter().enumerate() {
        let moments = moments.of(graph, i);
        let zero = [graph.zero(); 3];
        for component in Component::ALL {
            columns.push(match component.motion() {
                (Motion::Translation, axis) => rows.column(graph, frame.axes[axis], zero),
                (Motion::Rotation, axis) => rows.column(graph, moments[axis], frame.axes[axis]),
            });
        }
    }
    columns
}
