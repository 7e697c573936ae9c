//! The functions that are generated for a manipulator.

use super::Program;
use crate::chain::{Jacobian, Model};
use crate::graph::{Frame, Node};

/// One of the generated functions: what it returns, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionKind {
    /// `A_1 … A_n` and the tool: twelve numbers each, column-major.
    Transforms,
    /// The pose of the tool point: twelve numbers, column-major.
    Pose,
    /// Pose and `J_e`, column-major, and the margin if rows are Euler angles.
    ErrorJacobian,
    /// Pose and `J_q`, column-major, and the margin if rows are Euler angles.
    JointJacobian,
    /// Pose and `∂X_T/∂s`, column-major, and the margin if rows are Euler angles.
    ParameterJacobian,
    /// One number per effect of the enabled sources.
    Effects,
    /// ε of the repeatable sources: six numbers per frame.
    GeneralizedErrors,
}

impl FunctionKind {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Transforms,
        Self::Pose,
        Self::ErrorJacobian,
        Self::JointJacobian,
        Self::ParameterJacobian,
        Self::Effects,
        Self::GeneralizedErrors,
    ];

    /// Its name in generated code.
    pub fn name(self) -> &'static str {
        match self {
            Self::Transforms => "transforms",
            Self::Pose => "pose",
            Self::ErrorJacobian => "error_jacobian",
            Self::JointJacobian => "joint_jacobian",
            Self::ParameterJacobian => "parameter_jacobian",
            Self::Effects => "effects",
            Self::GeneralizedErrors => "generalized_errors",
        }
    }

    /// The program that computes it.
    pub fn program(self, model: &Model) -> Program {
        let pose = |frame: &Frame| -> Vec<Node> {
            frame.axes.iter().flatten().chain(&frame.position).copied().collect()
        };
        let outputs = match self {
            Self::Transforms => model.transforms.iter().flat_map(pose).collect(),
            Self::Pose => pose(&model.tool),
            Self::ErrorJacobian => with_jacobian(pose(&model.tool), &model.error_jacobian),
            Self::JointJacobian => with_jacobian(pose(&model.tool), &model.joint_jacobian),
            Self::ParameterJacobian => with_jacobian(pose(&model.tool), &model.parameter_jacobian),
            Self::Effects => model.effects.iter().map(|effect| effect.value).collect(),
            Self::GeneralizedErrors => model.generalized_errors.concat(),
        };
        Program::new(&model.graph, &outputs)
    }
}

fn with_jacobian(mut pose: Vec<Node>, jacobian: &Jacobian) -> Vec<Node> {
    pose.extend(jacobian.columns.iter().flatten());
    pose.extend(jacobian.margin);
    pose
}

/// All functions of a manipulator with their programs.
pub fn functions(model: &Model) -> Vec<(FunctionKind, Program)> {
    FunctionKind::ALL.into_iter().map(|kind| (kind, kind.program(model))).collect()
}
