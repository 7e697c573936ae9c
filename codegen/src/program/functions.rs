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
    /// Pose, what of `J_e` is neither zero nor repeated, and the margin if rows are Euler angles.
    ErrorJacobianDistinct,
    /// `ΔX = J_e ε` for any ε, and the margin if rows are Euler angles.
    Displacement,
    /// `J_e diag(σ²) J_eᵀ` for any σ², column-major, and the margin if rows are Euler angles.
    Covariance,
    /// `J_e ε` of the repeatable sources, and the margin if rows are Euler angles.
    PredictedDisplacement,
    /// `J_e ε` of each source by itself, and the margin if rows are Euler angles.
    SourceDisplacements,
    /// The pose of the tool point with the errors of the repeatable sources: twelve numbers, column-major.
    RealPose,
    /// That pose and `J_q` with rotation-vector rows, column-major.
    CompensatorStep,
}

impl FunctionKind {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::Transforms,
        Self::Pose,
        Self::ErrorJacobian,
        Self::JointJacobian,
        Self::ParameterJacobian,
        Self::Effects,
        Self::GeneralizedErrors,
        Self::ErrorJacobianDistinct,
        Self::Displacement,
        Self::Covariance,
        Self::PredictedDisplacement,
        Self::SourceDisplacements,
        Self::RealPose,
        Self::CompensatorStep,
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
            Self::ErrorJacobianDistinct => "error_jacobian_distinct",
            Self::Displacement => "displacement",
            Self::Covariance => "covariance",
            Self::PredictedDisplacement => "predicted_displacement",
            Self::SourceDisplacements => "source_displacements",
            Self::RealPose => "real_pose",
            Self::CompensatorStep => "compensator_step",
        }
    }

    /// The program that computes it.
    pub fn program(self, model: &Model) -> Program {
        let pose = |frame: &Frame| -> Vec<Node> {
            frame.axes.iter().flatten().chain(&frame.position).copied().collect()
        };
        let fewest = |ways: &[Jacobian; 2]| -> Program {
            let programs = ways.each_ref().map(|way| Program::new(&model.graph, &with_jacobian(vec![], way)));
            let operations = |program: &Program| {
                let count = program.operations();
                count.mul + count.add + count.div + count.sincos
            };
            programs.into_iter().min_by_key(operations).expect("two ways")
        };
        let outputs = match self {
            Self::Transforms => model.transforms.iter().flat_map(pose).collect(),
            Self::Pose => pose(&model.tool),
            Self::ErrorJacobian => with_jacobian(pose(&model.tool), &model.error_jacobian),
            Self::JointJacobian => with_jacobian(pose(&model.tool), &model.joint_jacobian),
            Self::ParameterJacobian => with_jacobian(pose(&model.tool), &model.parameter_jacobian),
            Self::Effects => model.effects.iter().map(|effect| effect.value).collect(),
            Self::GeneralizedErrors => model.generalized_errors.concat(),
            Self::ErrorJacobianDistinct => {
                let mut outputs = pose(&model.tool);
                outputs.extend(model.distinct.iter().flatten());
                outputs.extend(model.error_jacobian.margin);
                outputs
            }
            Self::Displacement => with_jacobian(vec![], &model.displacement),
            Self::Covariance => with_jacobian(vec![], &model.covariance),
            Self::PredictedDisplacement => return fewest(&model.predicted_displacement),
            Self::SourceDisplacements => return fewest(&model.source_displacements),
            Self::RealPose => pose(&model.real_pose),
            Self::CompensatorStep => {
                let mut outputs = pose(&model.real_pose);
                outputs.extend(model.joint_twists.iter().flatten());
                outputs
            }
        };
        Program::new(&model.graph, &outputs)
    }
}

/// Columns after some first nodes, and the margin last.
fn with_jacobian(mut pose: Vec<Node>, jacobian: &Jacobian) -> Vec<Node> {
    pose.extend(jacobian.columns.iter().flatten());
    pose.extend(jacobian.margin);
    pose
}

/// All functions of a manipulator with their programs.
pub fn functions(model: &Model) -> Vec<(FunctionKind, Program)> {
    FunctionKind::ALL.into_iter().map(|kind| (kind, kind.program(model))).collect()
}
