//! The joint motion that takes the errors back to first order: `d` with `J_q d = −J_e ε`.
//!
//! d is the same in whatever axes and at whatever point both sides are taken; so both are taken at the frame where d needs
//! the fewest operations.

use super::accumulate::{Accumulated, Links};
use super::deviation::frame_twists;
use super::displacement::Displacement;
use super::local::Local;
use super::minors::solve;
use super::six::six;
use crate::graph::{Graph, Node, Vector};
use crate::spec::{ChainNumber, Spec, VariableKind};

/// How many joints move the tool in all ways; those of fewer are asked for the tool point alone.
pub(super) const JOINTS_OF_A_POSE: usize = 6;
/// How many joints a tool point takes.
const JOINTS_OF_A_POINT: usize = 3;

/// What joints and errors do to the tool, all at one frame and in its axes.
pub(super) struct Equations {
    /// Columns of each joint: three rows of the tool point, or six of the tool.
    joints: Vec<Vec<Node>>,
    /// What the errors do.
    errors: Vec<Node>,
}

/// The joint motion in the units of the joints, `−J_q⁻¹ J_e ε`; of more joints than needed the shortest, in metres and rad. None
/// of fewer than three joints.
pub(super) fn joint_step(
    graph: &mut Graph,
    spec: &Spec,
    links: &Links,
    errors: &[[Node; 6]],
) -> Option<Vec<Node>> {
    if spec.variables.len() < JOINTS_OF_A_POINT {
        return None;
    }
    let joints: Vec<Vec<[Node; 6]>> =
        (0..spec.variables.len()).map(|joint| errors_of_joint(graph, spec, joint)).collect();
    let steps = (0..spec.frames.len()).map(|frame| {
        let equations = Equations::at(graph, links, &joints, errors, frame);
        equations.step(graph, spec)
    });
    let steps: Vec<Vec<Node>> = steps.collect();
    steps.into_iter().min_by_key(|step| graph.size(step))
}

/// What a unit of a joint does, as errors of all frames.
fn errors_of_joint(graph: &mut Graph, spec: &Spec, joint: usize) -> Vec<[Node; 6]> {
    let mut errors = vec![[graph.zero(); 6]; spec.frames.len()];
    for twist in frame_twists(graph, spec, ChainNumber::Joint(joint)) {
        errors[twist.frame] = six(twist.velocity, twist.rotation);
    }
    errors
}

impl Equations {
    fn at(
        graph: &mut Graph,
        links: &Links,
        joints: &[Vec<[Node; 6]>],
        errors: &[[Node; 6]],
        frame: usize,
    ) -> Self {
        let is_pose = joints.len() >= JOINTS_OF_A_POSE;
        let tool =
            (frame + 1..=errors.len()).rev().fold([graph.zero(); 3], |p, link| links.point(graph, link, p));
        let mut rows = |errors: &[[Node; 6]]| {
            let Displacement { shift, turn } = at_frame(graph, links, errors, frame);
            if is_pose {
                return [shift, turn].concat();
            }
            let swing = graph.cross(turn, tool);
            graph.add_vectors(shift, swing).to_vec()
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
        // d = U² Jᵀ (J U² Jᵀ)⁻¹ (−J_e ε), with U the units of the joints.
        let squares: Vec<Node> = spec
            .variables
            .iter()
            .map(|variable| {
                let unit = match variable.kind {
                    VariableKind::Revolute => 1.0,
                    VariableKind::Prismatic => 1.0 / spec.length.in_metres(),
                };
                graph.constant(unit * unit)
            })
            .collect();
        let weighted: Vec<Vec<Node>> = self
            .joints
            .iter()
            .zip(&squares)
            .map(|(column, square)| column.iter().map(|entry| graph.mul(*square, *entry)).collect())
            .collect();
        let sum = |graph: &mut Graph, products: &mut dyn Iterator<Item = (Node, Node)>| {
            products.fold(graph.zero(), |sum, (a, b)| {
                let product = graph.mul(a, b);
                graph.add(sum, product)
            })
        };
        let rows: Vec<Vec<Node>> = (0..count)
            .map(|i| {
                let entry = |k: usize| {
                    let mut pairs = self.joints.iter().zip(&weighted).map(|(a, b)| (a[i], b[k]));
                    sum(graph, &mut pairs)
                };
                (0..count).map(entry).collect()
            })
            .collect();
        let multipliers = solve(graph, &rows, &back);
        weighted
            .iter()
            .map(|column| sum(graph, &mut column.iter().copied().zip(multipliers.iter().copied())))
            .collect()
    }
}

/// What errors of all frames do to the point of the tool at the origin of one, in its axes.
fn at_frame(graph: &mut Graph, links: &Links, errors: &[[Node; 6]], frame: usize) -> Displacement {
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

/// What the point does that is further by a shift, or before it.
fn moved(graph: &mut Graph, sum: &Displacement, shift: Vector, sign: f64) -> Vector {
    let swing = graph.cross(sum.turn, shift);
    if sign > 0.0 { graph.add_vectors(sum.shift, swing) } else { graph.sub_vectors(sum.shift, swing) }
}
