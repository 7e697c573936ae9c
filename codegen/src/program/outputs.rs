//! Which nodes of a model are the outputs of which function: told here, and nowhere else.

use abbe_core::Function;

use super::Program;
use super::select::Selections;
use crate::chain::{Jacobian, Model};
use crate::graph::{Frame, Node};

/// The nodes that a function gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Outputs {
    /// Those of each result, in the order of the signature.
    pub(super) results: Vec<Vec<Node>>,
    /// `cos ρ`, where rows are Euler angles.
    pub(super) margin: Option<Node>,
}

/// The straight-line program of a function: its results one after the other, the margin last.
pub fn straight_line(function: Function, model: &Model) -> Program {
    fewest(ways(function, model), model, &mut Selections::default()).1
}

/// The nodes of each result of a function, and those of the margin, in one of the ways to compute them.
pub fn results(function: Function, model: &Model) -> (Vec<Vec<Node>>, Option<Node>) {
    let Outputs { results, margin } = ways(function, model).swap_remove(0);
    (results, margin)
}

/// Of several ways to compute a function the outputs and the program with the fewest operations.
pub(super) fn fewest(ways: Vec<Outputs>, model: &Model, selections: &mut Selections) -> (Outputs, Program) {
    let ways = ways.into_iter().map(|outputs| {
        let nodes: Vec<Node> = outputs.results.iter().flatten().copied().chain(outputs.margin).collect();
        let program = Program::with(&model.graph, &nodes, selections);
        (outputs, program)
    });
    ways.min_by_key(|(_, program)| program.operations().weight()).expect("every function has outputs")
}

/// The outputs of a function, and where there are two ways to compute them, both.
pub(super) fn ways(function: Function, model: &Model) -> Vec<Outputs> {
    let plain = |results: Vec<Vec<Node>>| vec![Outputs { results, margin: None }];
    let rows = |first: Option<&Frame>, jacobian: &Jacobian| Outputs {
        results: first.map(pose).into_iter().chain([jacobian.columns.concat()]).collect(),
        margin: jacobian.margin,
    };
    let with_pose = |jacobian| vec![rows(Some(&model.tool), jacobian)];
    match function {
        Function::Transforms => plain(vec![model.transforms.iter().flat_map(pose).collect()]),
        Function::Pose => plain(vec![pose(&model.tool)]),
        Function::ErrorJacobian => with_pose(&model.error_jacobian),
        Function::JointJacobian => with_pose(&model.joint_jacobian),
        Function::ParameterJacobian => with_pose(&model.parameter_jacobian),
        Function::Effects => plain(vec![model.effects.iter().map(|effect| effect.value).collect()]),
        Function::GeneralizedErrors => plain(vec![model.generalized_errors.concat()]),
        Function::ErrorJacobianDistinct => {
            let results = vec![pose(&model.tool), model.distinct.concat()];
            vec![Outputs { results, margin: model.error_jacobian.margin }]
        }
        Function::Displacement => vec![rows(None, &model.displacement)],
        Function::Covariance => vec![rows(None, &model.covariance)],
        Function::PredictedDisplacement => {
            model.predicted_displacement.iter().map(|way| rows(None, way)).collect()
        }
        Function::SourceDisplacements => {
            model.source_displacements.iter().map(|way| rows(None, way)).collect()
        }
        Function::RealPose => plain(vec![pose(&model.real_pose)]),
        Function::DrawnPose => plain(vec![pose(&model.drawn_pose)]),
        Function::CompensatorStep => plain(vec![pose(&model.real_pose), model.joint_twists.concat()]),
    }
}

/// A pose by columns.
fn pose(frame: &Frame) -> Vec<Node> {
    frame.axes.iter().flatten().chain(&frame.position).copied().collect()
}
