//! Manipulators that forward to another one.

use crate::{Description, Error, Manipulator, Pose};

/// [`Manipulator`] that forwards to another one, with a description of its own if it overrides
/// [`described`](Self::described).
///
/// ```
/// use abbe::{Delegate, Description, Manipulator};
/// struct Renamed<M>(M, Description);
///
/// impl<M: Manipulator> Delegate for Renamed<M> {
///     type Original = M;
///
///     fn original(&self) -> &M {
///         &self.0
///     }
///
///     fn described(&self) -> &Description {
///         &self.1
///     }
/// }
/// ```
pub trait Delegate: Sync {
    /// Type of the original.
    type Original: Manipulator + ?Sized;

    /// Returns the manipulator that everything is forwarded to.
    fn original(&self) -> &Self::Original;

    /// Returns the description; by default, that of the wrapped manipulator.
    fn described(&self) -> &Description {
        self.original().description()
    }
}

impl<D: Delegate> Manipulator for D {
    fn description(&self) -> &Description {
        self.described()
    }

    fn transforms(&self, q: &[f64], s: &[f64], transforms: &mut [Pose]) -> Result<(), Error> {
        self.original().transforms(q, s, transforms)
    }

    fn pose(&self, q: &[f64], s: &[f64]) -> Result<Pose, Error> {
        self.original().pose(q, s)
    }

    fn error_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        self.original().error_jacobian(q, s, columns)
    }

    fn joint_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        self.original().joint_jacobian(q, s, columns)
    }

    fn parameter_jacobian(&self, q: &[f64], s: &[f64], columns: &mut [[f64; 6]]) -> Result<Pose, Error> {
        self.original().parameter_jacobian(q, s, columns)
    }

    fn effects(&self, q: &[f64], s: &[f64], u: &[f64], effects: &mut [f64]) -> Result<(), Error> {
        self.original().effects(q, s, u, effects)
    }

    fn generalized_errors(
        &self,
        q: &[f64],
        s: &[f64],
        u: &[f64],
        errors: &mut [[f64; 6]],
    ) -> Result<(), Error> {
        self.original().generalized_errors(q, s, u, errors)
    }

    fn drawn_pose(&self, q: &[f64], s: &[f64], u: &[f64], magnitudes: &[f64]) -> Result<Option<Pose>, Error> {
        self.original().drawn_pose(q, s, u, magnitudes)
    }

    #[cfg(feature = "std")]
    fn displaced_pose(&self, q: &[f64], s: &[f64], errors: &[[f64; 6]]) -> Result<Pose, Error> {
        self.original().displaced_pose(q, s, errors)
    }

    fn passive(&self, q: &[f64], s: &[f64], passive: &mut [f64]) -> Result<(), Error> {
        self.original().passive(q, s, passive)
    }

    fn inverse(
        &self,
        q: &[f64],
        s: &[f64],
        target: &Pose,
        solutions: &mut [f64],
        found: &mut [f64],
    ) -> Result<(), Error> {
        self.original().inverse(q, s, target, solutions, found)
    }
}
