//! The nodes of a model that each function returns. No other file states this.

use abbe_core::Function;

use super::{Program, select::Selections};
use crate::chain::{Jacobian, Model};
use crate::graph::{Frame, Node};

/// Nodes that a function returns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Outputs {
    /// Nodes of each result, in the order of the signature.
    pub(super) results: Vec<Vec<Node>>,
    /// `cos ρ`, if rows are Euler angles.
    pub(super) margin: Option<Node>,
}

/// Returns the straight-line program of a function: its results in order, the margin last.
pub fn straight_line(function: Function, model: &Model) -> Program {
    fewest(alternatives(function, model), model, &mut Selections::default()).1
}

/// Returns the nodes of each result of a function and of its margin, in the first of its
/// alternative forms.
pub fn results(function: Function, model: &Model) -> (Vec<Vec<Node>>, Option<Node>) {
    let Outputs { results, margin } = alternatives(function, model).swap_remove(0);
    (results, margin)
}

/// Returns the outputs and the program with the fewest operations among alternative forms.
pub(super) fn fewest(
    alternatives: Vec<Outputs>,
    model: &Model,
    selections: &mut Selections,
) -> (Outputs, Program) {
    let alternatives = alternatives.into_iter().map(|outputs| {
        let nodes: Vec<Node> = outputs.results.iter().flatten().copied().chain(outputs.margin).collect();
        let program = Program::with(&model.graph, &nodes, selections);
        (outputs, program)
    });
    alternatives.min_by_key(|(_, program)| program.operations().weight()).expect("every function has outputs")
}

/// Returns the outputs of a function, in all alternative forms.
pub(super) fn alternatives(function: Function, model: &Model) -> Vec<Outputs> {
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
            model.predicted_displacement.iter().map(|jacobian| rows(None, jacobian)).collect()
        }
        Function::SourceDisplacements => {
            model.source_displacements.iter().map(|jacobian| rows(None, jacobian)).collect()
        }
        Function::RealPose => plain(vec![pose(&model.real_pose)]),
        Function::DrawnPose => plain(vec![pose(&model.drawn_pose)]),
        // In terms of passive variables that `tree` finds.
        Function::Passive => plain(vec![model.loops.iter().flat_map(|tree| tree.passive.clone()).collect()]),
        Function::DisplacedPose => plain(model.loops.iter().map(|tree| pose(&tree.displaced.pose)).collect()),
        Function::LegForces => plain(vec![model.leg_forces.clone()]),
        Function::Inverse => model
            .inverse
            .iter()
            .map(|inverse| Outputs {
                results: vec![inverse.solutions.concat(), inverse.found.clone()],
                margin: None,
            })
            .collect(),
        Function::CompensatorStep => plain(vec![pose(&model.real_pose), model.joint_twists.concat()]),
    }
}

/// Returns the entries of a pose by columns.
fn pose(frame: &Frame) -> Vec<Node> {
    frame.axes.iter().flatten().chain(&frame.position).copied().collect()
}
