//! Alternative forms of poses, levers and velocities. Each is stated to be equal to the existing
//! form, and a program computes those that take the fewest operations together.
//!
//! Let `R_jk`, `q_jk` be the pose of frame k in the axes of frame j, and `l_ij = p_T − p_i` in the
//! axes of frame j:
//!
//! ```text
//! R_jk = R_j,k−1 A_k = A_j+1 R_j+1,k = R_jm R_mk            q_jk = q_j,k−1 + R_j,k−1 t_k = t_j+1 + A_j+1 q_j+1,k
//! l_ij = A_j+1 l_i,j+1 = l_i+1,j + R_ji t_i+1               p_T = p_i + l_i0
//! v_j  = ν_j + ω_j × l_ij = A_j+1 v_j+1                     of a small motion (ν, ω) of frame i
//! ```
//!
//! Hence rotations about parallel axes are combined (`R_mk` is then one rotation by the sum of the
//! angles), origins are read off columns, and quantities that are simple in the axes of a frame are
//! computed there. Three base frames and the last five frames before the one in question suffice,
//! so the work is linear in the length of the chain.
//!
//! For `ΔX = J_e ε`, the displacement of the current origin is accumulated instead of the tool
//! point's. Let w be the displacement of the point at the frame's origin, considered as fixed to
//! the tool, θ the rotation of `Displacement`, and ρ the tool point relative to the frame:
//!
//! ```text
//! δ = w + θ × ρ        take in ε_i: w ← w + d_i        through a shift by t: w ← w − θ × t
//! ```
//!
//! A translation along an axis takes two products, where an error at a lever ρ takes six. Between
//! frames with a common origin there is nothing to compute.

use abbe_core::Component;
use abbe_spec::{Spec, Symbol, motion};
use indexmap::IndexMap;

use super::deviation::local_twist;
use super::symbol_jacobian::{Steps, twist};
use super::{Accumulated, Columns, Displacement, Links, Local, vectors};
use crate::graph::{Frame, Graph, Six, Vector};

/// Number of frames, counted from `F_0`, whose axes are considered for all other frames.
const FIRST: usize = 3;
/// Number of frames before the one in question whose axes are considered.
const LAST: usize = 5;

/// Poses and levers in the axes of several frames.
pub(super) struct EquivalentForms<'l> {
    links: &'l Links,
    /// Pose of frame k in frame j, for the considered pairs.
    poses: Vec<Vec<Option<Frame>>>,
    /// Links that are one rotation, up to a permutation of axes. Other links simplify nothing.
    are_turns: Vec<bool>,
    /// Tool point relative to frame i, in the axes of frame j.
    levers: Vec<Vec<Option<Vector>>>,
}

impl<'l> EquivalentForms<'l> {
    /// States forms equal to the poses of the frames and of the tool, `known`, and to the levers
    /// between them.
    pub(super) fn new(graph: &mut Graph, links: &'l Links, known: &[Frame]) -> Self {
        let mut forms = Self::of_poses(graph, links, known);
        forms.levers(graph, known);
        forms
    }

    /// States forms equal to the poses only.
    pub(super) fn of_poses(graph: &mut Graph, links: &'l Links, known: &[Frame]) -> Self {
        let ends = known.len();
        let (poses, levers) = (vec![vec![None; ends + 1]; ends], vec![vec![None; ends]; ends]);
        let identity = graph.identity();
        let are_turns = (0..ends).map(|link| {
            let motion = links.onwards(graph, link, identity);
            is_turn(graph, &motion)
        });
        let are_turns = are_turns.collect();
        let mut forms = Self { links, poses, are_turns, levers };
        forms.poses(graph, known);
        forms
    }

    fn poses(&mut self, graph: &mut Graph, known: &[Frame]) {
        let ends = known.len();
        let identity = graph.identity();
        for j in (0..ends).rev() {
            let mut before = identity;
            let simple = j == 0 || zeros(graph, &known[j - 1]) > 0;
            for k in j + 1..=ends {
                let right = self.links.onwards(graph, k - 1, before);
                if !is_near(j, k) || !simple && zeros(graph, &right) == 0 {
                    break;
                }
                let pose = if j == 0 { known[k - 1] } else { right };
                equate_frames(graph, pose, right);
                if self.are_turns[j]
                    && let Some(rest) = self.poses.get(j + 1).and_then(|poses| poses[k])
                {
                    let left = self.links.before(graph, j, rest);
                    equate_frames(graph, pose, left);
                }
                self.turn_together(graph, j, k, pose);
                self.poses[j][k] = Some(pose);
                before = pose;
            }
        }
    }

    /// Combines rotations: splits the pose at every frame from which frame k is reached by one
    /// rotation.
    fn turn_together(&self, graph: &mut Graph, j: usize, k: usize, pose: Frame) {
        for m in j + 1..k.saturating_sub(1) {
            if let (Some(first), Some(rest)) = (self.poses[j][m], self.poses[m][k])
                && is_turn(graph, &rest)
            {
                let product = graph.then(&first, &rest);
                equate_frames(graph, pose, product);
            }
        }
    }

    fn levers(&mut self, graph: &mut Graph, known: &[Frame]) {
        let ends = known.len();
        let zero = [graph.zero(); 3];
        let tool = known[ends - 1].position;
        let mut own = zero;
        for i in (0..ends).rev() {
            own = self.links.point(graph, i, own);
            if let Some(pose) = self.poses[i][ends] {
                graph.equate_vectors(pose.position, own);
            }
            self.levers[i][i] = Some(own);
            let mut lever = own;
            for j in (0..i).rev().take_while(|j| self.are_turns[*j]) {
                lever = self.links.direction(graph, j, lever);
                self.levers[i][j] = self.poses[j][i].map(|_| lever);
            }
            if i > 0 {
                let lever = graph.sub_vectors(tool, known[i - 1].position);
                if let Some(carried) = self.levers[i][0].replace(lever) {
                    graph.equate_vectors(lever, carried);
                }
                let turned = graph.turn(&known[i - 1].axes, own);
                graph.equate_vectors(lever, turned);
                if known[i - 1].position != zero {
                    let sum = graph.add_vectors(known[i - 1].position, lever);
                    graph.equate_vectors(tool, sum);
                }
            }
        }
        // Sums from the tip to the base, segment by segment.
        let mut sums = Vec::new();
        for (i, j) in (0..ends).rev().flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let next = if i + 1 < ends { self.levers[i + 1][j] } else { Some(zero) };
            if let (Some(lever), Some(next), Some(pose)) = (self.levers[i][j], next, self.pose(graph, j, i)) {
                let shift = self.links.shift(graph, i, &pose.axes);
                let sum = graph.add_vectors(shift, next);
                graph.equate_vectors(lever, sum);
                if j == 0 && i > 0 {
                    // The levers from the tip to frame i, and the tool point from there.
                    sums.extend(sum);
                    let tool = graph.add_vectors(known[i - 1].position, lever);
                    graph.propose_together([&sums[..], &tool].concat());
                }
            }
        }
    }

    fn pose(&self, graph: &mut Graph, j: usize, k: usize) -> Option<Frame> {
        if j == k { Some(graph.identity()) } else { self.poses[j][k] }
    }

    /// States forms equal to the moments of a Jacobian's columns.
    pub(super) fn moments(&self, graph: &mut Graph, columns: &[Columns]) {
        let zero = [graph.zero(); 3];
        let identity = graph.identity();
        for (i, columns) in std::iter::zip(1.., columns) {
            let rotations = [Component::Spin, Component::Roll, Component::Pitch];
            for (component, moment) in std::iter::zip(rotations, columns.moments) {
                self.velocity(graph, i, [zero, identity.axes[motion(component).1]], moment);
            }
        }
    }

    /// States forms equal to the velocity of the tool point for a twist of frame i, given in its
    /// axes.
    fn velocity(&self, graph: &mut Graph, i: usize, [shift, turn]: [Vector; 2], known: Vector) {
        let crossed = |graph: &mut Graph, axes: &[Vector; 3], lever: Vector| {
            let [shift, turn] = [shift, turn].map(|vector| graph.turn(axes, vector));
            graph.add_cross(shift, turn, lever)
        };
        let lever = self.levers[i][i].expect("every frame's own is known");
        let axes = graph.identity().axes;
        let mut velocity = crossed(graph, &axes, lever);
        if let Some(pose) = self.pose(graph, 0, i) {
            let turned = graph.turn(&pose.axes, velocity);
            graph.equate_vectors(known, turned);
            if let Some(lever) = self.levers[i][0] {
                let crossed = crossed(graph, &pose.axes, lever);
                graph.equate_vectors(known, crossed);
            }
        }
        for j in (0..i).rev().take_while(|j| self.are_turns[*j]) {
            velocity = self.links.direction(graph, j, velocity);
            if let (Some(pose), Some(lever)) = (self.poses[j][i], self.levers[i][j]) {
                let crossed = crossed(graph, &pose.axes, lever);
                graph.equate_vectors(velocity, crossed);
            }
            if j == 0 {
                graph.equate_vectors(known, velocity);
            }
        }
    }

    /// States forms equal to the velocities of the tool point per unit of symbols that move only
    /// one transform.
    pub(super) fn twists(&self, graph: &mut Graph, spec: &Spec, symbols: &[Symbol], twists: &[[Vector; 2]]) {
        let factors: Vec<_> = spec.frames.iter().map(|frame| &frame.factors).chain([&spec.tool]).collect();
        let mut of_transform: IndexMap<Symbol, Vec<(usize, [Vector; 2])>> = IndexMap::new();
        let origin = [graph.zero(); 3];
        for (transform, factors) in factors.into_iter().enumerate() {
            let steps = Steps::of_transform(graph, factors);
            for symbol in steps.symbols() {
                let motion = twist(graph, &steps, symbol, origin);
                of_transform.entry(symbol).or_default().push((transform, motion));
            }
        }
        for (symbol, [velocity, _]) in std::iter::zip(symbols, twists) {
            if let Some([(transform, motion)]) = of_transform.get(symbol).map(Vec::as_slice) {
                self.velocity(graph, *transform, *motion, *velocity);
                if *transform < spec.frames.len() {
                    let twist = local_twist(graph, spec, *symbol, *transform);
                    self.velocity(graph, transform + 1, [twist.velocity, twist.rotation], *velocity);
                }
            }
        }
    }
}

/// Returns `true` if the axes of frame j are considered for frame k.
fn is_near(j: usize, k: usize) -> bool {
    j < FIRST || k < j + LAST
}

/// Returns the number of zeros in the axes of a frame.
fn zeros(graph: &mut Graph, frame: &Frame) -> usize {
    let zero = graph.zero();
    frame.axes.iter().flatten().filter(|node| **node == zero).count()
}

/// Returns `true` for a rotation about a coordinate axis, up to a permutation of axes.
fn is_turn(graph: &mut Graph, frame: &Frame) -> bool {
    zeros(graph, frame) >= 4
}

fn equate_frames(graph: &mut Graph, a: Frame, b: Frame) {
    for (a, b) in std::iter::zip(a.axes, b.axes) {
        graph.equate_vectors(a, b);
    }
    graph.equate_vectors(a.position, b.position);
}

/// States at every frame that both forms are equal, and proposes to switch from one to the other
/// there.
pub(super) fn equate_at_origin(graph: &mut Graph, links: &Links, errors: &[Six]) {
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
    let there = graph.add_cross(at_origin, at_tool.turn, lever);
    graph.equate_vectors(at_tool.shift, there);
    graph.propose_together([&origins[..], &there].concat());
}
