//! Columns of `J_q`, and effects of errors, at any frame of the chain and in its axes.
//!
//! With these, the joint motion `d` cancels the errors to first order: `J_q d = −J_e ε`. The
//! solution is independent of the axes and the point in which both sides are expressed. The frame
//! in which d takes the fewest operations is used.

use abbe_core::VariableKind;
use abbe_spec::{ChainNumber, Spec};

use super::{Accumulated, Displacement, Links, Local, frame_twists, minors::solve, six};
use crate::graph::{Graph, Node, Six, Vector};

/// Number of joints that control the full pose. With fewer, only the tool point is considered.
pub(super) const JOINTS_OF_A_POSE: usize = 6;
/// Number of joints that control the tool point.
pub(super) const JOINTS_OF_A_POINT: usize = 3;

/// Returns the effect of a unit of each joint, as errors of all frames.
pub(super) fn errors_of_joints(graph: &mut Graph, spec: &Spec) -> Vec<Vec<Six>> {
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
pub(super) fn at_tool(graph: &mut Graph, links: &Links, errors: &[Six], frame: usize) -> Displacement {
    let origin = [graph.zero(); 3];
    let lever = (frame + 1..=errors.len()).rev().fold(origin, |point, link| links.point(graph, link, point));
    let there = at_origin(graph, links, errors, frame);
    Displacement { shift: moved(graph, &there, lever, 1.0), ..there }
}

/// Returns the effect of errors of all frames on the point of the tool at the origin of a frame, in
/// its axes.
pub(super) fn at_origin(graph: &mut Graph, links: &Links, errors: &[Six], frame: usize) -> Displacement {
    let take_in = |graph: &mut Graph, sum: &mut Displacement, errors: &Six| {
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
    let shift = graph.add_vectors(inner.shift, outer.shift);
    Displacement { shift, turn: graph.add_vectors(inner.turn, outer.turn) }
}

/// Returns the velocity of the point at (or, with a negative sign, before) a given offset.
fn moved(graph: &mut Graph, sum: &Displacement, shift: Vector, sign: f64) -> Vector {
    let swing = graph.cross(sum.turn, shift);
    if sign > 0.0 { graph.add_vectors(sum.shift, swing) } else { graph.sub_vectors(sum.shift, swing) }
}

/// Effects of joints and errors on the tool, all at one frame and in its axes.
pub(super) struct Equations {
    /// One column per joint: three rows of the tool point, or six of the tool.
    joints: Vec<Vec<Node>>,
    /// Effect of the errors.
    errors: Vec<Node>,
}

/// Returns the joint motion `−J_q⁻¹ J_e ε` in the units of the joints. With redundant joints it is
/// the shortest one, measured in metres and radians. Returns `None` for fewer than three joints.
pub(super) fn joint_step(graph: &mut Graph, spec: &Spec, links: &Links, errors: &[Six]) -> Option<Vec<Node>> {
    if spec.variables.len() < JOINTS_OF_A_POINT {
        return None;
    }
    let joints = errors_of_joints(graph, spec);
    let steps = (0..spec.frames.len()).map(|frame| {
        let equations = Equations::at(graph, links, &joints, errors, frame);
        equations.step(graph, spec)
    });
    let steps: Vec<Vec<Node>> = steps.collect();
    steps.into_iter().min_by_key(|step| graph.size(step))
}

impl Equations {
    fn at(graph: &mut Graph, links: &Links, joints: &[Vec<Six>], errors: &[Six], frame: usize) -> Self {
        let is_pose = joints.len() >= JOINTS_OF_A_POSE;
        let mut rows = |errors: &[Six]| match is_pose {
            true => {
                let there = at_origin(graph, links, errors, frame);
                [there.shift, there.turn].concat()
            }
            false => at_tool(graph, links, errors, frame).shift.to_vec(),
        };
        Self { joints: joints.iter().map(|errors| rows(errors)).collect(), errors: rows(errors) }
    }

    fn step(&self, graph: &mut Graph, spec: &Spec) -> Vec<Node> {
        let back: Vec<Node> = self.errors.iter().map(|row| graph.neg(*row)).collect();
        let count = back.len();
        if self.joints.len() == count {
            let rows: Vec<Vec<Node>> =
                (0..count).map(|i| self.joints.iter().map(|column| column[i]).collect()).collect();
            return solve(graph, &rows, &back);
        }
        // d = U² Jᵀ (J U² Jᵀ)⁻¹ (−J_e ε), where U holds the units of the joints.
        let weighted: Vec<Vec<Node>> = self
            .joints
            .iter()
            .zip(units(spec))
            .map(|(column, unit)| {
                let square = graph.constant(unit * unit);
                column.iter().map(|entry| graph.mul(square, *entry)).collect()
            })
            .collect();
        let row =
            |columns: &[Vec<Node>], i: usize| columns.iter().map(|column| column[i]).collect::<Vec<_>>();
        let rows: Vec<Vec<Node>> = (0..count)
            .map(|i| {
                let own = row(&self.joints, i);
                (0..count).map(|k| graph.products(&own, &row(&weighted, k))).collect()
            })
            .collect();
        let multipliers = solve(graph, &rows, &back);
        weighted.iter().map(|column| graph.products(column, &multipliers)).collect()
    }
}
