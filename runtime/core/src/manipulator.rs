//! What every manipulator can do, generated or interpreted.

use crate::{Description, Error, Pose};

/// A manipulator: pure functions of the joint variables `q`, the structural parameters `s` and the inputs `u`.
///
/// Lengths are in the manipulator's unit, angles in rad; everything is in `F_0`. Jacobians are column-major:
/// one `[f64; 6]` per column, rows as [`Description::orientation`] says. Slices have exactly as many entries
/// as the [`Description`] says, or the answer is [`Error::Count`]; values that are not finite are
/// [`Error::NotFinite`], whether they come in or would go out. Being pure, it may be asked from several threads.
pub trait Manipulator: Sync {
    /// Names, units, limits, sources.
    fn description(&self) -> &Description;

    /// `A_1 … A_n` and the tool `T`, one after the other: `frames + 1` of them.
    fn transforms(&self, q: &[f64], s: &[f64], transforms: &mut [Pose]) -> Result<(), Error>;

    /// The pose of the tool point, equation (3).
    fn pose(&self, q: &[f64], s: &[f64]) -> Result<Pose, Error>;

    /// Pose and error Jacobian `J_e = ∂X_T/∂ε`, equation (9): `6 · frames` columns, frame 1 first.
    ///
    /// [`Error::EulerSingularity`] where Euler rows do not exist.
    fn error_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error>;

    /// Pose and joint Jacobian `J_q = ∂X_T/∂q`: one column per variable, errors as for `J_e`.
    fn joint_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error>;

    /// Pose and `∂X_T/∂s`: one column per structural parameter, errors as for `J_e`.
    fn parameter_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error>;

    /// The generalized errors that the sources cause, one value per [`Effect`](crate::Effect).
    ///
    /// Of a repeatable source it is the error, of a random one its magnitude. [`Error::OutOfRange`] where an
    /// input is outside its range.
    fn effects(&self, q: &[f64], s: &[f64], u: &[f64], effects: &mut [f64]) -> Result<(), Error>;

    /// ε: the sum of the repeatable sources, six errors per frame; errors as for [`effects`](Self::effects).
    fn generalized_errors(
        &self,
        q: &[f64],
        s: &[f64],
        u: &[f64],
        errors: &mut [[f64; 6]],
    ) -> Result<(), Error>;

    /// The pose of the tool point with the errors of every source times its magnitude, exactly; errors as for
    /// [`effects`](Self::effects).
    ///
    /// None, as provided, where all errors of sources are those of frames: the chain with [`effects`](Self::effects) as
    /// they are is then exact. [`drawn_pose`](crate::drawn_pose) has the pose in either case.
    fn drawn_pose(
        &self,
        _q: &[f64],
        _s: &[f64],
        _u: &[f64],
        _magnitudes: &[f64],
    ) -> Result<Option<Pose>, Error> {
        Ok(None)
    }
}
