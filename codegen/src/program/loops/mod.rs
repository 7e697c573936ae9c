//! The functions of long chains as loops over their frames.
//!
//! Straight-line code of long chains outgrows the instruction cache and takes its time to compile. The bodies of the
//! loops are built by what builds straight-line code, from the entries of any transform in place of those of one.
//! `sums` has the transforms as sums of few terms, `body` is the body of a loop, `draft` a routine made of such bodies;
//! `walk` goes along the frames, `functions` are the loops of the functions.

mod body;
mod draft;
mod functions;
mod sums;
mod walk;

use abbe_core::{Function, Orientation};
use abbe_spec::Spec;

use self::draft::Draft;
use self::sums::{Sum, Twists};
use super::routine::{Array, Routine, Stage, Sums, Table};
use crate::chain::{Covariance, Displacement, Model};
use crate::graph::Node;

/// What loops go over, and what helps them.
pub(super) struct Loops<'m> {
    model: &'m Model,
    orientation: Orientation,
    motions: usize,
    joints: Twists,
    parameters: Twists,
    terms: Vec<Node>,
    sums: Vec<Sums>,
    tables: Vec<Table>,
}

impl<'m> Loops<'m> {
    pub(super) fn new(spec: &Spec, model: &'m Model) -> Self {
        let mut sum = Sum::new(&model.graph);
        let motions = sum.motions(&model.transforms);
        let joints = sum.twists(["JOINT_TWISTS", "JOINT_TWIST"], &model.joint_local_twists);
        let parameters = sum.twists(["PARAMETER_TWISTS", "PARAMETER_TWIST"], &model.parameter_local_twists);
        let Sum { terms, sums, mut tables, .. } = sum;
        let by_source =
            model.effects.iter().map(|effect| [6 * effect.frame + effect.component as usize, effect.source]);
        let rows = by_source.collect();
        tables.push(Table {
            name: "EFFECT_COLUMNS",
            documentation: "Column of `J_e` and source of every effect.",
            rows,
        });
        let mut terms: Vec<Node> = terms.into_iter().collect();
        if terms.is_empty() {
            // Nothing moves: there is an array of terms all the same.
            terms.extend(model.transforms.first().map(|first| first.position[0]));
        }
        Self { model, orientation: spec.orientation, motions, joints, parameters, terms, sums, tables }
    }

    /// The helpers, tables and sums.
    pub(super) fn finish(self) -> (Vec<Routine>, Vec<Table>, Vec<Sums>) {
        (walk::helpers(&self), self.tables, self.sums)
    }

    /// The stages of a function, and the arrays that they need; none if it has no loop.
    pub(super) fn stages(&mut self, function: Function, arrays: &mut Vec<Array>) -> Option<Vec<Stage>> {
        let mut draft = Draft::new(self, arrays);
        match function {
            Function::Effects | Function::GeneralizedErrors => return None,
            Function::Transforms => draft.transforms(),
            Function::Pose => draft.pose(),
            Function::ErrorJacobian => draft.error_jacobian(false),
            Function::ErrorJacobianDistinct => draft.error_jacobian(true),
            Function::JointJacobian => draft.symbol_jacobian(false),
            Function::ParameterJacobian => draft.symbol_jacobian(true),
            Function::Displacement => {
                let errors = draft.array("errors");
                draft.accumulate::<Displacement>(errors, "displacement");
            }
            Function::PredictedDisplacement => draft.predicted_displacement(),
            Function::Covariance => {
                let variances = draft.array("variances");
                draft.accumulate::<Covariance>(variances, "covariance");
            }
            Function::SourceDisplacements => draft.by_source(),
            Function::RealPose => {
                let model = draft.loops.model;
                draft.real_pose(model.real_errors.as_deref());
            }
            Function::DrawnPose => {
                let model = draft.loops.model;
                draft.real_pose(Some(&model.drawn_errors));
            }
            Function::CompensatorStep => draft.compensator_step(),
        }
        Some(draft.stages)
    }
}
