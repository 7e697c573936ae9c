//! The functions of long chains as loops over their frames.
//!
//! Straight-line code of long chains outgrows the instruction cache and takes long to compile. The
//! same builders generate the bodies of the loops, with symbols in place of the entries of one
//! transform. `sums` expresses the transforms as sums of few terms, `span` collects the data of the
//! loops, `body` builds a loop body, `draft` builds a routine from such bodies, `walk` follows the
//! frames, and `functions` has the loops of each function.

mod functions;
mod routine_builder;
mod sums;
mod walk;

use abbe_core::Function;

use self::routine_builder::{Body, POSE, RoutineBuilder, RowsArray};
pub(super) use self::sums::FrameLoops;
use super::{Array, Routine, Stage, Sums, Table};
use crate::chain::{Covariance, Displacement};

impl FrameLoops<'_> {
    /// Returns the helper routines, tables and sums.
    pub(super) fn finish(self) -> (Vec<Routine>, Vec<Table>, Vec<Sums>) {
        (walk::helpers(&self), self.tables, self.sums)
    }

    /// Returns the stages of a function and adds the arrays that they need. Returns `None` for a
    /// function without loops.
    pub(super) fn stages(&mut self, function: Function, arrays: &mut Vec<Array>) -> Option<Vec<Stage>> {
        let model = self.model;
        let mut draft = RoutineBuilder::new(self, arrays);
        match function {
            // The last four are no functions of long chains.
            Function::Effects
            | Function::GeneralizedErrors
            | Function::Passive
            | Function::DisplacedPose
            | Function::LegForces
            | Function::Inverse => return None,
            Function::Transforms => draft.transforms(),
            Function::Pose => draft.pose(),
            Function::ErrorJacobian => draft.error_jacobian(false),
            Function::ErrorJacobianDistinct => draft.error_jacobian(true),
            Function::JointJacobian => draft.symbol_jacobian(false),
            Function::ParameterJacobian => draft.symbol_jacobian(true),
            Function::Displacement => draft.accumulate::<Displacement>("errors", "displacement"),
            Function::PredictedDisplacement => draft.predicted_displacement(),
            Function::Covariance => draft.accumulate::<Covariance>("variances", "covariance"),
            Function::SourceDisplacements => draft.by_source(),
            Function::RealPose => draft.real_pose(model.real_errors.as_deref()),
            Function::DrawnPose => draft.real_pose(Some(&model.drawn_errors)),
            Function::CompensatorStep => draft.compensator_step(),
        }
        Some(draft.stages)
    }
}
