//! The functions of long chains as loops over their frames.
//!
//! Straight-line code of long chains outgrows the instruction cache and takes its time to compile. The bodies of the
//! loops are built by what builds straight-line code, from the entries of any transform in place of those of one.
//! `sums` has the transforms as sums of few terms, `span` is what loops go over, `body` is the body of a loop, `draft` a routine made of such bodies;
//! `walk` goes along the frames, `functions` are the loops of the functions.

mod body;
mod draft;
mod functions;
mod span;
mod sums;
mod walk;

use abbe_core::Function;

use self::draft::Draft;
pub(super) use self::span::Loops;
use super::routine::{Array, Routine, Stage, Sums, Table};
use crate::chain::{Covariance, Displacement};

impl Loops<'_> {
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
