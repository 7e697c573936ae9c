//! Quantities that are generated for a manipulator, as nodes of one graph.
//!
//! `build` makes them from the kinematics of frames, `chain` or `tree`; `names` names their nodes.

mod build;
mod chain;
mod machine;
mod names;

use abbe_spec::Spec;

use super::{ClosedLoops, EffectNode, LocalTwist, inverse::Inverse};
use crate::graph::{Frame, Graph, Node, Six};

/// A Jacobian, or another matrix with the same six rows: columns, with rows 4–6 by the spec's
/// orientation.
#[derive(Clone, Debug)]
pub struct Jacobian {
    /// The columns.
    pub columns: Vec<Six>,
    /// `cos ρ` if the rows are Euler angles; they are undefined where it is 0.
    pub margin: Option<Node>,
}

/// Nodes of all quantities that are generated for a manipulator.
#[derive(Clone, Debug)]
pub struct Model {
    /// The graph of the nodes.
    pub graph: Graph,
    /// `A_1 … A_n` and the tool transform.
    pub transforms: Vec<Frame>,
    /// The poses of `F_1 … F_n` in `F_0`.
    pub frames: Vec<Frame>,
    /// Pose of the tool point in `F_0`: `A_T`.
    pub tool: Frame,
    /// `J_e`: six columns per frame.
    pub error_jacobian: Jacobian,
    /// Entries of `J_e` that are neither zero nor repeated; the same number for each frame.
    pub distinct: Vec<Vec<Node>>,
    /// `J_q`: one column per variable.
    pub joint_jacobian: Jacobian,
    /// `∂X_T/∂s`: one column per parameter.
    pub parameter_jacobian: Jacobian,
    /// Effects of the enabled sources, source by source.
    pub effects: Vec<EffectNode>,
    /// ε: sum of the enabled repeatable sources, six per frame.
    pub generalized_errors: Vec<Six>,
    /// `ΔX = J_e ε` for any ε: one column.
    pub displacement: Jacobian,
    /// `J_e diag(σ²) J_eᵀ` for any variances σ²: six columns.
    pub covariance: Jacobian,
    /// `J_e ε` of the enabled repeatable sources, one column: accumulated along the chain, and from
    /// the columns of `J_e`.
    pub predicted_displacement: [Jacobian; 2],
    /// `J_e ε` of each enabled source alone, one column per source, computed in the same two forms.
    pub source_displacements: [Jacobian; 2],
    /// Exact pose of the tool point with the errors of the enabled repeatable sources.
    pub real_pose: Frame,
    /// Exact pose of the tool point with the errors of all enabled sources, each times its
    /// magnitude.
    pub drawn_pose: Frame,
    /// Errors of every frame with which the nominal chain gives `real_pose`. Only for a long chain
    /// with errors other than those at the frames themselves.
    pub real_errors: Option<Vec<Six>>,
    /// Errors of every frame with which the nominal chain gives `drawn_pose`. Only for a long
    /// chain.
    pub drawn_errors: Vec<Six>,
    /// `J_q` with rotation-vector rows for any orientation of the spec.
    pub joint_twists: Vec<Six>,
    /// Twists of each transform per unit of the variables. Only for a long chain.
    pub joint_local_twists: Vec<LocalTwist>,
    /// Twists of each transform per unit of the parameters. Only for a long chain.
    pub parameter_local_twists: Vec<LocalTwist>,
    /// All solutions of inverse kinematics, if they have a closed form.
    pub(crate) inverse: Option<Inverse>,
    /// Newton's steps that close the loops, and the exact poses with errors. Only for a tree of
    /// frames.
    pub(crate) loops: Option<ClosedLoops>,
    /// Forces that close the loops, in N and N·m, one per equation.
    pub(crate) leg_forces: Vec<Node>,
}

impl Model {
    /// Returns the number of solutions that inverse kinematics has at most; 0 without a closed
    /// form.
    pub fn solutions(&self) -> usize {
        self.inverse.as_ref().map_or(0, |inverse| inverse.found.len())
    }
}

/// Largest number of frames for which straight-line code is generated. Beyond it, straight-line
/// code outgrows the instruction cache and takes minutes to compile where loops take seconds.
pub(super) const LONGEST_WITHOUT_LOOPS: usize = 30;

/// Returns `true` if the functions of the chain are loops over its frames.
pub(crate) fn is_long(spec: &Spec) -> bool {
    spec.is_serial() && spec.frames.len() > LONGEST_WITHOUT_LOOPS
}
