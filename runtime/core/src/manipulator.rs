//! The interface of every manipulator, generated or interpreted.

use bytemuck::TransparentWrapper;

#[cfg(feature = "std")]
use crate::open_pose;
use crate::{Description, Error, Function, Pose, Quantity, Result, checks};

/// Manipulator: pure functions of the joint variables `q`, the structural parameters `s` and the
/// inputs `u`.
///
/// A type implements [`description`](Self::description) and [`evaluate`](Self::evaluate); the other
/// methods are views of these. Lengths are in the manipulator's unit, angles in rad, coordinates in
/// `F_0`. Jacobians are column-major: one `[f64; 6]` per column, with rows as
/// [`Description::orientation`] says. A slice whose length differs from the [`Description`] is an
/// [`Error::Count`]; an argument or result that is not finite is an [`Error::NotFinite`]. The
/// functions are pure and may be called from several threads.
pub trait Manipulator: Sync {
    /// Returns names, units, limits and sources.
    fn description(&self) -> &Description;

    /// Evaluates a function. `arguments` and `results` have a slice for each array of its
    /// [`Signature`](crate::function::Signature), with the numbers of the array in memory order, in
    /// the units that it states; further slices are not looked at.
    ///
    /// Returns [`Error::Count`] for a slice that is missing or has another length,
    /// [`Error::NotFinite`] and [`Error::OutOfRange`] for its values, [`Error::NotClosed`] if loops
    /// do not close, and [`Error::NoFunction`] for a function that the manipulator does not have.
    /// Where Euler rows are singular, it returns [`Error::EulerSingularity`]; rows 1–3 are computed
    /// there, too.
    fn evaluate(&self, function: Function, arguments: &[&[f64]], results: &mut [&mut [f64]]) -> Result<()>;

    /// Computes `A_1 … A_n` and the tool `T`: `frames + 1` transforms.
    fn transforms(&self, q: &[f64], s: &[f64], transforms: &mut [Pose]) -> Result<()> {
        let transforms = <Pose as TransparentWrapper<_>>::peel_slice_mut(transforms);
        let transforms = transforms.as_flattened_mut().as_flattened_mut();
        self.evaluate(Function::Transforms, &[q, s], &mut [transforms])
    }

    /// Returns the pose of the tool point, equation (3).
    fn pose(&self, q: &[f64], s: &[f64]) -> Result<Pose> {
        single_pose(self, Function::Pose, &[q, s])
    }

    /// Returns the pose and computes the error Jacobian `J_e = ∂X_T/∂ε`, equation (9): `6 · frames`
    /// columns, frame 1 first.
    ///
    /// Returns [`Error::EulerSingularity`] where Euler rows are singular; rows 1–3 of the columns
    /// are computed there, too.
    fn error_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose> {
        jacobian(self, Function::ErrorJacobian, [q, s], columns)
    }

    /// Returns the pose and computes the joint Jacobian `J_q = ∂X_T/∂q`: one column per variable.
    /// Errors as for `J_e`.
    fn joint_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose> {
        jacobian(self, Function::JointJacobian, [q, s], columns)
    }

    /// Returns the pose and computes `∂X_T/∂s`: one column per structural parameter. Errors as for
    /// `J_e`.
    fn parameter_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose> {
        jacobian(self, Function::ParameterJacobian, [q, s], columns)
    }

    /// Computes the generalized errors that the sources cause, one value per
    /// [`Effect`](crate::Effect).
    ///
    /// The value is the error for a repeatable source, and the magnitude of the error for a random
    /// one. Returns [`Error::OutOfRange`] if an input is outside its range.
    fn effects(&self, q: &[f64], s: &[f64], u: &[f64], effects: &mut [f64]) -> Result<()> {
        self.evaluate(Function::Effects, &[q, s, u], &mut [effects])
    }

    /// Computes ε, the sum of the repeatable sources: six errors per frame. Errors as for
    /// [`effects`](Self::effects).
    fn generalized_errors(&self, q: &[f64], s: &[f64], u: &[f64], errors: &mut [[f64; 6]]) -> Result<()> {
        self.evaluate(Function::GeneralizedErrors, &[q, s, u], &mut [errors.as_flattened_mut()])
    }

    /// Returns the exact pose of the tool point with the errors of every source times its
    /// magnitude. Errors as for [`effects`](Self::effects).
    ///
    /// Returns `None` for manipulators without the function, whose sources act only at frames: the
    /// chain with the values of [`effects`](Self::effects) is then exact.
    /// [`drawn_pose`](crate::drawn_pose) returns the pose in either case.
    fn drawn_pose(&self, q: &[f64], s: &[f64], u: &[f64], magnitudes: &[f64]) -> Result<Option<Pose>> {
        match single_pose(self, Function::DrawnPose, &[q, s, u, magnitudes]) {
            Err(Error::NoFunction(_)) => Ok(None),
            pose => pose.map(Some),
        }
    }

    /// Returns the exact pose of the tool point with given errors, six per frame: equation (6),
    /// with all loops closed.
    #[cfg(feature = "std")]
    fn displaced_pose(&self, q: &[f64], s: &[f64], errors: &[[f64; 6]]) -> Result<Pose> {
        let description = self.description();
        if description.has_loops() {
            return single_pose(self, Function::DisplacedPose, &[q, s, errors.as_flattened()]);
        }
        open_pose(description, |transforms| self.transforms(q, s, transforms), errors)
    }

    /// Computes the passive variables, in the order of the frames that declare them, for which all
    /// loops close: the values that are reached continuously from home as `q` moves from home to
    /// its value. Manipulators without loops have none.
    ///
    /// Returns [`Error::NotClosed`] if there are none.
    fn passive(&self, q: &[f64], s: &[f64], passive: &mut [f64]) -> Result<()> {
        match self.description().has_loops() {
            true => self.evaluate(Function::Passive, &[q, s], &mut [passive]),
            false => checks::length(Quantity::Passive, [0, 1], passive.len()),
        }
    }

    /// Computes the forces λ that close the loops under the loads, in N and N·m, one per equation
    /// of the loops; the force of a leg is positive if it presses its ends apart. Manipulators
    /// without loops have none.
    fn leg_forces(&self, q: &[f64], s: &[f64], u: &[f64], forces: &mut [f64]) -> Result<()> {
        match self.description().has_loops() {
            true => self.evaluate(Function::LegForces, &[q, s, u], &mut [forces]),
            false => Ok(()),
        }
    }

    /// Computes all joint variables that bring the tool point to a pose, in closed form: a row of
    /// `solutions` per solution, in the turns nearest to `q` that the limits permit.
    ///
    /// Where `found` is 0, the row is no solution. A joint that is free to move there stays as in
    /// `q`; within 10⁻⁹ rad of such a pose, but not at it, a solution may be missing. With loops, a
    /// row has the joint variables at the pose, but `pose` of the row may be that of another
    /// assembly mode. A manipulator without a closed form has no solutions in its description.
    fn inverse(
        &self,
        q: &[f64],
        s: &[f64],
        target: &Pose,
        solutions: &mut [f64],
        found: &mut [f64],
    ) -> Result<()> {
        if self.description().solutions > 0 {
            let arguments = [q, s, target.0.as_flattened()];
            return self.evaluate(Function::Inverse, &arguments, &mut [solutions, found]);
        }
        checks::length(Quantity::Solutions, [0, 1], found.len())
    }
}

/// Returns the pose that a function computes alone.
fn single_pose(
    manipulator: &(impl Manipulator + ?Sized),
    function: Function,
    arguments: &[&[f64]],
) -> Result<Pose> {
    let mut pose = Pose([[0.0; 3]; 4]);
    manipulator.evaluate(function, arguments, &mut [pose.0.as_flattened_mut()])?;
    Ok(pose)
}

/// Fills the columns of a Jacobian and returns the pose.
fn jacobian(
    manipulator: &(impl Manipulator + ?Sized),
    function: Function,
    [q, s]: [&[f64]; 2],
    columns: &mut [[f64; 6]],
) -> Result<Pose> {
    let mut pose = Pose([[0.0; 3]; 4]);
    manipulator.evaluate(function, &[q, s], &mut [pose.0.as_flattened_mut(), columns.as_flattened_mut()])?;
    Ok(pose)
}
