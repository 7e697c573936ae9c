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
    fn description(&self) -> Description<'_>;

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

    /// Pose, error Jacobian and effects of many configurations at once, configuration after configuration.
    ///
    /// `q`, `s`, `u` and the results hold one row per configuration; there are `poses.len()` of them. An
    /// error comes with the index of its configuration, and the results are then unspecified.
    fn error_models(
        &self,
        q: &[f64],
        s: &[f64],
        u: &[f64],
        poses: &mut [Pose],
        columns: &mut [[f64; 6]],
        effects: &mut [f64],
    ) -> Result<(), (usize, Error)> {
        let counts = self.description();
        let row = |values: usize, i: usize| i * values..(i + 1) * values;
        for (i, pose) in poses.iter_mut().enumerate() {
            let q = &q[row(counts.variables.len(), i)];
            let s = &s[row(counts.parameters.len(), i)];
            let u = &u[row(counts.inputs.len(), i)];
            let at = |error| (i, error);
            *pose = self.error_jacobian(q, s, &mut columns[row(6 * counts.frames.len(), i)]).map_err(at)?;
            self.effects(q, s, u, &mut effects[row(counts.effects.len(), i)]).map_err(at)?;
        }
        Ok(())
    }
}
