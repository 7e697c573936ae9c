//! The interface of every manipulator, generated or interpreted.

#[cfg(feature = "std")]
use crate::open_pose;
use crate::{Description, Error, Pose, Quantity};

/// Manipulator: pure functions of the joint variables `q`, the structural parameters `s` and the
/// inputs `u`.
///
/// Lengths are in the manipulator's unit, angles in rad, coordinates in `F_0`. Jacobians are
/// column-major: one `[f64; 6]` per column, with rows as [`Description::orientation`] says. A slice
/// whose length differs from the [`Description`] is an [`Error::Count`]; an argument or result that
/// is not finite is an [`Error::NotFinite`]. The functions are pure and may be called from several
/// threads.
pub trait Manipulator: Sync {
    /// Returns names, units, limits and sources.
    fn description(&self) -> &Description;

    /// Computes `A_1 … A_n` and the tool `T`: `frames + 1` transforms.
    fn transforms(&self, q: &[f64], s: &[f64], transforms: &mut [Pose]) -> Result<(), Error>;

    /// Returns the pose of the tool point, equation (3).
    fn pose(&self, q: &[f64], s: &[f64]) -> Result<Pose, Error>;

    /// Returns the pose and computes the error Jacobian `J_e = ∂X_T/∂ε`, equation (9): `6 · frames`
    /// columns, frame 1 first.
    ///
    /// Returns [`Error::EulerSingularity`] where Euler rows are singular; rows 1–3 of the columns
    /// are computed there, too.
    fn error_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error>;

    /// Returns the pose and computes the joint Jacobian `J_q = ∂X_T/∂q`: one column per variable.
    /// Errors as for `J_e`.
    fn joint_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error>;

    /// Returns the pose and computes `∂X_T/∂s`: one column per structural parameter. Errors as for
    /// `J_e`.
    fn parameter_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error>;

    /// Computes the generalized errors that the sources cause, one value per
    /// [`Effect`](crate::Effect).
    ///
    /// The value is the error for a repeatable source, and the magnitude of the error for a random
    /// one. Returns [`Error::OutOfRange`] if an input is outside its range.
    fn effects(&self, q: &[f64], s: &[f64], u: &[f64], effects: &mut [f64]) -> Result<(), Error>;

    /// Computes ε, the sum of the repeatable sources: six errors per frame. Errors as for
    /// [`effects`](Self::effects).
    fn generalized_errors(
        &self,
        q: &[f64],
        s: &[f64],
        u: &[f64],
        errors: &mut [[f64; 6]],
    ) -> Result<(), Error>;

    /// Returns the exact pose of the tool point with the errors of every source times its
    /// magnitude. Errors as for [`effects`](Self::effects).
    ///
    /// The default returns `None`, for manipulators whose sources act only at frames: the chain
    /// with the values of [`effects`](Self::effects) is then exact.
    /// [`drawn_pose`](crate::drawn_pose) returns the pose in either case.
    fn drawn_pose(
        &self,
        _q: &[f64],
        _s: &[f64],
        _u: &[f64],
        _magnitudes: &[f64],
    ) -> Result<Option<Pose>, Error> {
        Ok(None)
    }

    /// Returns the exact pose of the tool point with given errors, six per frame: equation (6),
    /// with all loops closed.
    ///
    /// The default evaluates the tree of frames, for manipulators without loops.
    #[cfg(feature = "std")]
    fn displaced_pose(&self, q: &[f64], s: &[f64], errors: &[[f64; 6]]) -> Result<Pose, Error> {
        open_pose(self.description(), |transforms| self.transforms(q, s, transforms), errors)
    }

    /// Computes the passive variables, in the order of the frames that declare them, for which all
    /// loops close: the values that are reached continuously from home as `q` moves from home to
    /// its value. The default is for manipulators without loops.
    ///
    /// Returns [`Error::NotClosed`] if there are none.
    fn passive(&self, _q: &[f64], _s: &[f64], passive: &mut [f64]) -> Result<(), Error> {
        match passive.len() {
            0 => Ok(()),
            found => Err(Error::Count { quantity: Quantity::Passive, expected: 0, found }),
        }
    }

    /// Computes all joint variables that bring the tool point to a pose, in closed form: a row of
    /// `solutions` per solution, in the turns nearest to `q` that the limits permit.
    ///
    /// Where `found` is 0, the row is no solution. A joint that is free to move there stays as in
    /// `q`; within 10⁻⁹ rad of such a pose, but not at it, a solution may be missing. The default
    /// is for manipulators without a closed form, whose description has no solutions.
    fn inverse(
        &self,
        _q: &[f64],
        _s: &[f64],
        _target: &Pose,
        _solutions: &mut [f64],
        found: &mut [f64],
    ) -> Result<(), Error> {
        match found.len() {
            0 => Ok(()),
            found => Err(Error::Count { quantity: Quantity::Solutions, expected: 0, found }),
        }
    }
}
