//! From the tip to the base: what the errors of all frames do to the tool point, without any frame's pose in `F_0`.

use abbe_spec::Spec;

use super::local::Local;
use super::rows::Rows;
use crate::graph::{Frame, Graph, Node, Vector};

/// The chain as local motions.
pub(super) struct Links {
    frames: Vec<Vec<Local>>,
    tool: Vec<Local>,
}

/// What is accumulated, in the axes of the frame that has been reached.
pub(crate) trait Accumulated {
    /// How many numbers it is.
    const NUMBERS: usize;
    /// What so many numbers are.
    fn from_numbers(numbers: &[Node]) -> Self;
    /// Its numbers.
    fn numbers(&self) -> Vec<Node>;
    /// Columns of six rows.
    fn rows(&self, graph: &mut Graph, rows: &Rows) -> Vec<[Node; 6]>;
    /// Takes in the six errors of the frame; `lever` is the tool point as seen from it.
    fn add(&mut self, graph: &mut Graph, errors: [Node; 6], lever: Vector);
    /// Goes over to the axes before a motion.
    fn turn(&mut self, graph: &mut Graph, motion: &Local);
}

impl Links {
    pub(super) fn new(graph: &mut Graph, spec: &Spec) -> Self {
        let frames = spec.frames.iter().map(|frame| Local::motions(graph, &frame.factors)).collect();
        Self { frames, tool: Local::motions(graph, &spec.tool) }
    }

    /// Links of which each is known as a whole, the tool the last.
    pub(super) fn of(graph: &mut Graph, links: &[Frame]) -> Self {
        let mut frames: Vec<Vec<Local>> = links.iter().map(|link| Local::of(graph, link)).collect();
        let tool = frames.pop().unwrap_or_default();
        Self { frames, tool }
    }

    /// The motions of a link; the tool is the last.
    pub(super) fn motions(&self, link: usize) -> &[Local] {
        self.frames.get(link).unwrap_or(&self.tool)
    }

    /// The pose behind a link, the tool being the last, from that before it.
    pub(super) fn onwards(&self, graph: &mut Graph, link: usize, before: Frame) -> Frame {
        self.motions(link).iter().fold(before, |frame, motion| motion.behind(graph, &frame))
    }

    /// A pose in the axes before a link from that in those behind it.
    pub(super) fn before(&self, graph: &mut Graph, link: usize, pose: Frame) -> Frame {
        Frame {
            axes: pose.axes.map(|axis| self.direction(graph, link, axis)),
            position: self.point(graph, link, pose.position),
        }
    }

    /// A direction in the axes before a link.
    pub(super) fn direction(&self, graph: &mut Graph, link: usize, v: Vector) -> Vector {
        self.motions(link).iter().rev().fold(v, |v, motion| motion.direction(graph, v))
    }

    /// A point in the axes before a link, from their origin.
    pub(super) fn point(&self, graph: &mut Graph, link: usize, p: Vector) -> Vector {
        self.motions(link).iter().rev().fold(p, |p, motion| motion.point(graph, p))
    }

    /// From the origin before a link to that behind it, where the link's axes are these.
    pub(super) fn shift(&self, graph: &mut Graph, link: usize, axes: &[Vector; 3]) -> Vector {
        let start = Frame { axes: *axes, position: [graph.zero(); 3] };
        self.onwards(graph, link, start).position
    }

    /// Accumulates from the tip to `F_0`:
    ///
    /// ```text
    /// ρ = p_T − p_i        take in ε_i at ρ        ρ ← t_i + R_i ρ, and what is accumulated ← R_i of it
    /// ```
    pub(super) fn accumulate<A: Accumulated>(&self, graph: &mut Graph, errors: &[[Node; 6]], sum: A) -> A {
        self.accumulate_past(graph, errors, 0, sum)
    }

    /// The same, but behind the shifts and turns about z that `A_1` begins with: what is along z and across z is as large as in
    /// `F_0`, and does not depend on the angles of these turns.
    pub(super) fn accumulate_behind_turns<A: Accumulated>(
        &self,
        graph: &mut Graph,
        errors: &[[Node; 6]],
        sum: A,
    ) -> A {
        let keeps_z = |motion: &&Local| matches!(motion, Local::Shift(_) | Local::Turn { axis: 2, .. });
        let turns = self.frames.first().map_or(0, |motions| motions.iter().take_while(keeps_z).count());
        self.accumulate_past(graph, errors, turns, sum)
    }

    /// The same in the axes behind the first so many motions of `A_1`.
    fn accumulate_past<A: Accumulated>(
        &self,
        graph: &mut Graph,
        errors: &[[Node; 6]],
        skipped: usize,
        sum: A,
    ) -> A {
        let (mut sum, mut lever) = self.behind(graph, errors, 0, sum);
        let motions = self.frames.first().into_iter().flat_map(|motions| &motions[skipped..]);
        motions.rev().for_each(|motion| go_before(graph, motion, &mut sum, &mut lever));
        sum
    }

    /// The same in the axes of a frame, from 0: what it and all behind it do; nothing behind the last one.
    pub(super) fn accumulate_to<A: Accumulated>(
        &self,
        graph: &mut Graph,
        errors: &[[Node; 6]],
        frame: usize,
        sum: A,
    ) -> A {
        self.behind(graph, errors, frame, sum).0
    }

    /// The same, and the tool point, in the axes of a frame.
    fn behind<A: Accumulated>(
        &self,
        graph: &mut Graph,
        errors: &[[Node; 6]],
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

    /// The x axis of the tool in `F_0`.
    pub(super) fn first_axis(&self, graph: &mut Graph) -> Vector {
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        let motions = self.frames.iter().chain([&self.tool]).flatten();
        motions.rev().fold([one, zero, zero], |axis, motion| motion.direction(graph, axis))
    }
}

/// Goes over to the axes before a motion.
fn go_before<A: Accumulated>(graph: &mut Graph, motion: &Local, sum: &mut A, lever: &mut Vector) {
    sum.turn(graph, motion);
    *lever = motion.point(graph, *lever);
}
