//! The functions of a manipulator that a workspace sweep evaluates in batches.

use crate::lanes::{Batches, Evaluate, OneByOne, Pose, SourceDisplacements, Tiles, run};
use crate::{Error, Function, Manipulator};

/// Manipulator that can be swept over a workspace: the two functions that sweeps need, in batches.
///
/// Generated manipulators implement it. The two functions are compiled for lanes only where a
/// `&dyn Sweepable` is made. Wrap any other [`Manipulator`] in [`OneByOne`].
///
/// Rows of arguments and results follow the [`Signature`](crate::function::Signature) of the
/// function. Errors as for [`run`].
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no code for several configurations at once",
    note = "a manipulator that is not generated is swept as `abbe::lanes::OneByOne(manipulator)`"
)]
pub trait Sweepable: Manipulator {
    /// Evaluates the pose of the tool point: [`Function::Pose`].
    fn poses(&self, arguments: &Tiles, poses: &mut Tiles) -> Result<(), Error>;

    /// Evaluates ΔX of every source by itself: [`Function::SourceDisplacements`].
    fn source_displacements(&self, arguments: &Tiles, displacements: &mut Tiles) -> Result<(), Error>;
}

impl<M: Evaluate<Pose> + Evaluate<SourceDisplacements>> Sweepable for M {
    fn poses(&self, arguments: &Tiles, poses: &mut Tiles) -> Result<(), Error> {
        run(self, Pose, arguments, poses)
    }

    fn source_displacements(&self, arguments: &Tiles, displacements: &mut Tiles) -> Result<(), Error> {
        run(self, SourceDisplacements, arguments, displacements)
    }
}

impl<M: Manipulator> Sweepable for OneByOne<M> {
    fn poses(&self, arguments: &Tiles, poses: &mut Tiles) -> Result<(), Error> {
        self.batch(Function::Pose, arguments, poses)
    }

    fn source_displacements(&self, arguments: &Tiles, displacements: &mut Tiles) -> Result<(), Error> {
        self.batch(Function::SourceDisplacements, arguments, displacements)
    }
}
