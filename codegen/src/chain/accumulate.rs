//! Accumulates the effects of all frames' errors on the tool point from the tip to the base,
//! without the poses of the frames in `F_0`: `ΔX = J_e ε` without `J_e`.

use abbe_core::{Component, Orientation};
use abbe_spec::{Motion, Spec, motion};

use super::{Local, Rows};
use crate::graph::{Frame, Graph, Node, Six, Vector};

/// The chain as local motions.
pub(super) struct Links {
    frames: Vec<Vec<Local>>,
    tool: Vec<Local>,
}

/// A quantity accumulated from the tip, in the axes of the current frame.
pub(crate) trait Accumulated {
    /// Number of nodes that represent the quantity.
    const NUMBERS: usize;
    /// Rebuilds the quantity from its [`NUMBERS`](Self::NUMBERS) nodes.
    fn from_numbers(numbers: &[Node]) -> Self;
    /// Returns the nodes that represent the quantity.
    fn numbers(&self) -> Vec<Node>;
    /// Returns the quantity as columns of six rows.
    fn rows(&self, graph: &mut Graph, rows: &Rows) -> Vec<Six>;
    /// Adds the six errors of the current frame; `lever` is the tool point relative to it.
    fn add(&mut self, graph: &mut Graph, errors: Six, lever: Vector);
    /// Transforms the quantity to the axes before a motion.
    fn turn(&mut self, graph: &mut Graph, motion: &Local);
}

impl Links {
    pub(super) fn new(graph: &mut Graph, spec: &Spec) -> Self {
        let frames = spec.frames.iter().map(|frame| Local::motions(graph, &frame.factors)).collect();
        Self { frames, tool: Local::motions(graph, &spec.tool) }
    }

    /// Builds links from one rigid motion each; the last one is the tool.
    pub(super) fn from_frames(graph: &mut Graph, links: &[Frame]) -> Self {
        let mut frames: Vec<Vec<Local>> = links.iter().map(|link| Local::from_frame(graph, link)).collect();
        let tool = frames.pop().unwrap_or_default();
        Self { frames, tool }
    }

    /// Returns the motions of a link; the tool is the last link.
    pub(super) fn motions(&self, link: usize) -> &[Local] {
        self.frames.get(link).unwrap_or(&self.tool)
    }

    /// Returns the pose behind a link from the pose before it; the tool is the last link.
    pub(super) fn onwards(&self, graph: &mut Graph, link: usize, before: Frame) -> Frame {
        self.motions(link).iter().fold(before, |frame, motion| motion.behind(graph, &frame))
    }

    /// Transforms a pose from the axes behind a link to those before it.
    pub(super) fn before(&self, graph: &mut Graph, link: usize, pose: Frame) -> Frame {
        let axes = pose.axes.map(|axis| self.direction(graph, link, axis));
        Frame { axes, position: self.point(graph, link, pose.position) }
    }

    /// Transforms a direction from the axes behind a link to those before it.
    pub(super) fn direction(&self, graph: &mut Graph, link: usize, v: Vector) -> Vector {
        self.motions(link).iter().rev().fold(v, |v, motion| motion.direction(graph, v))
    }

    /// Transforms a point from the frame behind a link to the frame before it.
    pub(super) fn point(&self, graph: &mut Graph, link: usize, p: Vector) -> Vector {
        self.motions(link).iter().rev().fold(p, |p, motion| motion.point(graph, p))
    }

    /// Returns the vector from the origin before a link to the origin behind it, given the axes of
    /// the link.
    pub(super) fn shift(&self, graph: &mut Graph, link: usize, axes: &[Vector; 3]) -> Vector {
        let start = Frame { axes: *axes, position: [graph.zero(); 3] };
        self.onwards(graph, link, start).position
    }

    /// Accumulates from the tip to `F_0`, or to the axes behind the first `skipped` motions of
    /// `A_1`. At each frame i:
    ///
    /// ```text
    /// ρ = p_T − p_i        take in ε_i at ρ        ρ ← t_i + R_i ρ, and what is accumulated ← R_i of it
    /// ```
    pub(super) fn accumulate<A: Accumulated>(
        &self,
        graph: &mut Graph,
        errors: &[Six],
        skipped: usize,
        sum: A,
    ) -> A {
        let (mut sum, mut lever) = self.behind(graph, errors, 0, sum);
        let motions = self.frames.first().into_iter().flat_map(|motions| &motions[skipped..]);
        motions.rev().for_each(|motion| go_before(graph, motion, &mut sum, &mut lever));
        sum
    }

    /// Returns the number of leading translations and rotations about z of `A_1`. Magnitudes along
    /// z and across z are the same behind these as in `F_0` and do not depend on the angles of
    /// these rotations.
    pub(super) fn leading_turns(&self) -> usize {
        let keeps_z = |motion: &&Local| matches!(motion, Local::Shift(_) | Local::Turn { axis: 2, .. });
        self.frames.first().map_or(0, |motions| motions.iter().take_while(keeps_z).count())
    }

    /// Accumulates the effects of `frame` (from 0) and all frames behind it. Returns the
    /// accumulated quantity and the tool point, both in the axes of that frame. Behind the last
    /// frame the sum is unchanged.
    pub(super) fn behind<A: Accumulated>(
        &self,
        graph: &mut Graph,
        errors: &[Six],
        frame: usize,
        mut sum: A,
    ) -> (A, Vector) {
        let mut lever = [graph.zero(); 3];
        for motion in self.tool.iter().rev() {
            lever = motion.point(graph, lever);
        }
        for (i, (motions, errors)) in self.frames.iter().zip(errors).enumerate().skip(frame).rev() {
            sum.add(graph, *errors, lever);
            if i > frame {
                motions.iter().rev().for_each(|motion| go_before(graph, motion, &mut sum, &mut lever));
            }
        }
        (sum, lever)
    }

    /// Returns, in `F_0`, the axis of the tool about which the last of the Euler angles turns; the
    /// x axis for a rotation vector.
    pub(super) fn last_axis(&self, graph: &mut Graph, orientation: Orientation) -> Vector {
        let mut axis = [graph.zero(); 3];
        axis[orientation.last_axis().unwrap_or(0)] = graph.constant(1.0);
        let motions = self.frames.iter().chain([&self.tool]).flatten();
        motions.rev().fold(axis, |axis, motion| motion.direction(graph, axis))
    }
}

/// Transforms the sum and the lever to the axes before a motion.
fn go_before<A: Accumulated>(graph: &mut Graph, motion: &Local, sum: &mut A, lever: &mut Vector) {
    sum.turn(graph, motion);
    *lever = motion.point(graph, *lever);
}

/// Splits six values in the order of ε into translation and rotation, each x y z.
pub(super) fn vectors(six: Six) -> (Vector, Vector) {
    let (mut shift, mut turn) = ([six[0]; 3], [six[0]; 3]);
    for (component, node) in Component::ALL.into_iter().zip(six) {
        match motion(component) {
            (Motion::Translation, axis) => shift[axis] = node,
            (Motion::Rotation, axis) => turn[axis] = node,
        }
    }
    (shift, turn)
}

/// Combines translation and rotation to six values in the order of ε.
pub(super) fn six(shift: Vector, turn: Vector) -> Six {
    Component::ALL.map(|component| match motion(component) {
        (Motion::Translation, axis) => shift[axis],
        (Motion::Rotation, axis) => turn[axis],
    })
}

/// Displacement of the tool point caused by the frames from the tip to the current one:
///
/// ```text
/// δ ← R_i (δ + d_i + θ_i × ρ)        θ ← R_i (θ + θ_i)
/// ```
pub(crate) struct Displacement {
    /// Translation δ.
    pub(super) shift: Vector,
    /// Rotation θ.
    pub(super) turn: Vector,
}

impl Displacement {
    pub(super) fn none(graph: &mut Graph) -> Self {
        let zero = [graph.zero(); 3];
        Self { shift: zero, turn: zero }
    }

    /// Returns the six rows of ΔX.
    pub(super) fn column(&self, graph: &mut Graph, rows: &Rows) -> Six {
        rows.column(graph, self.shift, self.turn)
    }
}

impl Accumulated for Displacement {
    const NUMBERS: usize = 6;

    fn from_numbers(numbers: &[Node]) -> Self {
        let vector = |first: usize| [0, 1, 2].map(|i| numbers[first + i]);
        Self { shift: vector(0), turn: vector(3) }
    }

    fn numbers(&self) -> Vec<Node> {
        [self.shift, self.turn].concat()
    }

    /// Returns ΔX as the only column.
    fn rows(&self, graph: &mut Graph, rows: &Rows) -> Vec<Six> {
        vec![self.column(graph, rows)]
    }

    fn add(&mut self, graph: &mut Graph, errors: Six, lever: Vector) {
        let (shift, turn) = vectors(errors);
        let swing = graph.cross(turn, lever);
        self.shift = graph.add_vectors(self.shift, shift);
        self.shift = graph.add_vectors(self.shift, swing);
        self.turn = graph.add_vectors(self.turn, turn);
    }

    fn turn(&mut self, graph: &mut Graph, motion: &Local) {
        self.shift = motion.direction(graph, self.shift);
        self.turn = motion.direction(graph, self.turn);
    }
}
