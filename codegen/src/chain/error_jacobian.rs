//! `J_e` by the structured product rule: `∂A_T/∂ε_ik = T_i G_k S_i`.
//!
//! A moment is the velocity `a × (p_T − p_i)` of the tool point per unit of rotation about an axis
//! `a` of frame i. The direct formula takes 6 multiplications and 3 additions. It takes fewer where
//! another frame has the same axis:
//!
//! ```text
//! p_i = p_j + δ        a × (p_T − p_i) = a × (p_T − p_j) − a × δ
//! δ along a            a × δ = 0
//! δ = d b, b ⊥ a       a × δ = d c, with c the third axis of the frame that has a and b
//! ```
//!
//! The tool point itself serves as such a frame, because every moment about it is 0.

use abbe_core::Component;
use abbe_spec::{Motion, motion};

use super::{Rows, walk::Step};
use crate::graph::{Frame, Graph, Node, Six, Vector};

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
    pub(crate) fn dense(&self, graph: &mut Graph) -> [Six; 6] {
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

/// Quantities from which the moments are computed.
pub(super) struct Moments<'m> {
    frames: &'m [Frame],
    tool: &'m Frame,
    /// Translations from frame i to the next, and from the last frame to the tool: direction and
    /// distance.
    segments: Vec<Vec<(Vector, Node)>>,
    /// Axes of the preceding frame and their moments.
    before: Vec<(Vector, Vector)>,
}

impl<'m> Moments<'m> {
    /// Collects the translations of a chain; `ends` is the number of steps that lead to each frame.
    pub(super) fn new(
        graph: &Graph,
        frames: &'m [Frame],
        tool: &'m Frame,
        steps: &[Step],
        ends: &[usize],
    ) -> Self {
        let mut segments = Vec::with_capacity(frames.len());
        for (i, &start) in ends.iter().enumerate() {
            let end = ends.get(i + 1).copied().unwrap_or(steps.len());
            segments.push(steps[start..end].iter().flat_map(|step| translations(graph, step)).collect());
        }
        Self { frames, tool, segments, before: Vec::new() }
    }

    /// Returns the moments of the three axes of frame i. Call it for the frames in ascending order.
    pub(super) fn of_frame(&mut self, graph: &mut Graph, i: usize) -> [Vector; 3] {
        let axes = self.frames[i].axes;
        let mut known = Vec::new();
        let moments = axes.map(|axis| {
            let moment = self.moment(graph, i, axis);
            known.push((axis, moment));
            moment
        });
        self.before = known;
        moments
    }

    /// Returns `a × (p_T − p_i)` by the formula that takes the fewest operations.
    fn moment(&self, graph: &mut Graph, i: usize, axis: Vector) -> Vector {
        let mut forms: Vec<MomentForm> = Vec::new();
        if let Some(offset) = self.offset(graph, i, self.segments[i..].iter().flatten(), axis) {
            forms.push(MomentForm { known: None, offset });
        }
        for &(known, moment) in &self.before {
            if let Some(same) = parallel(graph, known, axis)
                && let Some(offset) = self.offset(graph, i, self.segments[i - 1].iter(), axis)
            {
                let moment = if same { moment } else { graph.neg_vector(moment) };
                forms.push(MomentForm { known: Some(moment), offset });
            }
        }
        let Some(form) = forms.into_iter().min_by_key(MomentForm::operations) else {
            let lever = self.lever(graph, i);
            return graph.cross(axis, lever);
        };
        let offset = form.offset.vector(graph);
        match form.known {
            // About the tool point every moment is 0, and δ is the lever itself.
            None => offset,
            Some(moment) => graph.sub_vectors(moment, offset),
        }
    }

    /// Returns `a × δ` for the sum δ of translations if it takes at most one product of a number
    /// and an axis.
    fn offset<'t>(
        &self,
        graph: &mut Graph,
        i: usize,
        translations: impl Iterator<Item = &'t (Vector, Node)>,
        axis: Vector,
    ) -> Option<Offset> {
        let mut offset = Offset::Zero;
        for &(direction, distance) in translations {
            if parallel(graph, direction, axis).is_some() {
                continue;
            }
            if !matches!(offset, Offset::Zero) {
                return None;
            }
            offset = Offset::Along(self.cross(graph, i, axis, direction)?, distance);
        }
        Some(offset)
    }

    /// Returns `a × b` for two axes of one frame near frame i: ± its third axis.
    fn cross(&self, graph: &mut Graph, i: usize, a: Vector, b: Vector) -> Option<Vector> {
        for frame in self.frames[i.saturating_sub(1)..].iter().take(3).chain([self.tool]) {
            let find = |graph: &mut Graph, v: Vector| {
                (0..3).find_map(|k| parallel(graph, frame.axes[k], v).map(|sign| (k, sign)))
            };
            if let (Some((j, first)), Some((k, second))) = (find(graph, a), find(graph, b))
                && j != k
            {
                let third = frame.axes[3 - j - k];
                let cyclic = (j + 1) % 3 == k;
                return Some(if cyclic == (first == second) { third } else { graph.neg_vector(third) });
            }
        }
        None
    }

    /// Returns `p_T − p_i`.
    fn lever(&self, graph: &mut Graph, i: usize) -> Vector {
        let lever = graph.sub_vectors(self.tool.position, self.frames[i].position);
        for (node, axis) in lever.into_iter().zip("xyz".chars()) {
            graph.propose(node, || format!("lever{}_{axis}", i + 1));
        }
        lever
    }
}

/// `a × δ`.
enum Offset {
    Zero,
    /// A direction times a distance.
    Along(Vector, Node),
}

/// A known moment (`None` for the tool point) and the offset from it.
struct MomentForm {
    known: Option<Vector>,
    offset: Offset,
}

impl MomentForm {
    /// Returns the number of multiplications and additions.
    fn operations(&self) -> usize {
        match (&self.offset, self.known) {
            (Offset::Zero, _) => 0,
            (Offset::Along(..), None) => 3,
            (Offset::Along(..), Some(_)) => 6,
        }
    }
}

impl Offset {
    fn vector(&self, graph: &mut Graph) -> Vector {
        match *self {
            Self::Zero => [graph.zero(); 3],
            Self::Along(direction, distance) => graph.scale(distance, direction),
        }
    }
}

/// Returns `Some(true)` for equal vectors and `Some(false)` for opposite ones.
fn parallel(graph: &mut Graph, a: Vector, b: Vector) -> Option<bool> {
    if a == b {
        return Some(true);
    }
    (graph.neg_vector(a) == b).then_some(false)
}

fn translations(graph: &Graph, step: &Step) -> Vec<(Vector, Node)> {
    let candidates = match step {
        Step::Translation { direction, amount } => vec![(*direction, *amount)],
        Step::Rotation { .. } => Vec::new(),
        Step::Matrix { before, local, .. } => before.axes.into_iter().zip(local.position).collect(),
    };
    candidates.into_iter().filter(|(_, distance)| graph.value(*distance) != Some(0.0)).collect()
}
