//! `J_e` by the structured product rule: `∂A_T/∂ε_ik = T_i G_k S_i`.

use abbe_core::Component;
use abbe_spec::expr::{Motion, motion};

use super::moments::Moments;
use super::rows::Rows;
use crate::graph::{Frame, Graph, Node, Vector};

/// Parts of a frame's six columns: its axes, and the moments and rows 4–6 of the rotations `e_s e_r
/// e_p`.
pub(crate) struct Columns {
    axes: [Vector; 3],
    /// Moments of `e_s e_r e_p`.
    pub(super) moments: [Vector; 3],
    rows: [Vector; 3],
}

/// Returns the six columns of every frame. With `T_i = (R_i, p_i)` and the tool point `p_T` these
/// are
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
) -> Vec<Columns> {
    let of_frame = |(i, frame): (usize, &Frame)| {
        let moments = moments.of_frame(graph, i);
        Columns::new(graph, frame, moments, rows)
    };
    frames.iter().enumerate().map(of_frame).collect()
}

impl Columns {
    /// Builds the columns of a frame from the moments of its x, y and z axes.
    pub(crate) fn new(graph: &mut Graph, frame: &Frame, moments: [Vector; 3], rows: &Rows) -> Self {
        let rotations =
            [Component::Spin, Component::Roll, Component::Pitch].map(|component| motion(component).1);
        Self {
            axes: frame.axes,
            moments: rotations.map(|axis| moments[axis]),
            rows: rotations.map(|axis| rows.orientation_rows(graph, frame.axes[axis])),
        }
    }

    /// Returns all entries of the six columns.
    pub(crate) fn dense(&self, graph: &mut Graph) -> [[Node; 6]; 6] {
        let zero = [graph.zero(); 3];
        Component::ALL.map(|component| {
            let ([a, b, c], [d, e, f]) = match motion(component) {
                (Motion::Translation, axis) => (self.axes[axis], zero),
                (Motion::Rotation, _) => {
                    let index = component as usize - Component::Spin as usize;
                    (self.moments[index], self.rows[index])
                }
            };
            [a, b, c, d, e, f]
        })
    }

    /// Returns the entries that are neither zero nor repeated: the axes, the moments of `e_s e_r
    /// e_p`, and rows 4–6 where they differ from the axes.
    pub(crate) fn distinct(&self, rows: &Rows) -> Vec<Node> {
        let rows = match rows {
            Rows::RotationVector => &[][..],
            Rows::Euler(_) => &self.rows,
        };
        self.axes.iter().chain(&self.moments).chain(rows).flatten().copied().collect()
    }
}
