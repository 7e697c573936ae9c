//! Joint motion `d` that cancels the errors to first order: `J_q d = −J_e ε`.
//!
//! The solution is independent of the axes and the point in which both sides are expressed. The
//! frame in which d takes the fewest operations is used.

use abbe_spec::Spec;

use super::accumulate::Links;
use super::joint_columns::{
    JOINTS_OF_A_POINT, JOINTS_OF_A_POSE, at_origin, at_tool, errors_of_joints, units,
};
use super::minors::solve;
use crate::graph::{Graph, Node};

/// Effects of joints and errors on the tool, all at one frame and in its axes.
pub(super) struct Equations {
    /// One column per joint: three rows of the tool point, or six of the tool.
    joints: Vec<Vec<Node>>,
    /// Effect of the errors.
    errors: Vec<Node>,
}

/// Returns the joint motion `−J_q⁻¹ J_e ε` in the units of the joints. With redundant joints it is
/// the shortest one, measured in metres and radians. Returns `None` for fewer than three joints.
pub(super) fn joint_step(
    graph: &mut Graph,
    spec: &Spec,
    links: &Links,
    errors: &[[Node; 6]],
) -> Option<Vec<Node>> {
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
    fn at(
        graph: &mut Graph,
        links: &Links,
        joints: &[Vec<[Node; 6]>],
        errors: &[[Node; 6]],
        frame: usize,
    ) -> Self {
        let is_pose = joints.len() >= JOINTS_OF_A_POSE;
        let mut rows = |errors: &[[Node; 6]]| match is_pose {
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
