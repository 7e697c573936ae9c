//! Evaluation of a function of a manipulator over tiles.

use super::{Kernel, Register, Tiles};
use crate::checks::{self, Margin};
use crate::{Description, Error, Function, Manipulator, Quantity, Scalar};

/// [`Function`] as a type, so that [`run`] compiles this function
/// only.
pub trait Named {
    /// The function.
    const FUNCTION: Function;
}

/// Manipulator whose function `F` is compiled for any scalar type, including lanes. Generated
/// manipulators implement it for all functions.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no code for several configurations at once",
    note = "a manipulator that is not generated is evaluated as `abbe::lanes::OneByOne(manipulator)`"
)]
pub trait Evaluate<F: Named>: Manipulator {
    /// Fills the results of one configuration, or of one configuration per lane. Rows follow the
    /// function's [`Signature`](crate::function::Signature). Returns `None` if a slice has too few
    /// rows.
    ///
    /// Everything it calls must be `#[inline(always)]`, as in any [`Kernel`].
    fn evaluate_lanes<T: Scalar>(&self, arguments: &[T], results: &mut [T]) -> Option<()>;
}

/// Evaluates a function at all configurations, in the lanes of the instruction set of the tiles.
///
/// Rows of arguments and results follow the function's [`Signature`](crate::function::Signature).
/// The function is compiled here, for this manipulator and for every instruction set. Only counts
/// are checked ([`Error::Count`]): values that are not finite or not defined propagate to the
/// results of their configuration.
pub fn run<M: Evaluate<F> + ?Sized, F: Named>(
    manipulator: &M,
    _function: F,
    arguments: &Tiles,
    results: &mut Tiles,
) -> Result<(), Error> {
    check(F::FUNCTION, manipulator.description(), arguments, results)?;
    arguments.instruction_set().run(Over { manipulator, arguments, results, _function });
    Ok(())
}

/// Function with its arguments and results.
struct Over<'a, M: ?Sized, F> {
    manipulator: &'a M,
    arguments: &'a Tiles,
    results: &'a mut Tiles,
    _function: F,
}

impl<M: Evaluate<F> + ?Sized, F: Named> Kernel for Over<'_, M, F> {
    type Output = ();

    #[inline(always)]
    fn run<R: Register>(self) {
        for tile in 0..self.arguments.tiles() {
            self.manipulator.evaluate_lanes(self.arguments.tile::<R>(tile), self.results.tile_mut::<R>(tile));
        }
    }
}

/// Returns [`Error::Count`] unless arguments and results have the rows of this function, equal
/// numbers of configurations, and the layout of one instruction set.
pub fn check(
    function: Function,
    description: &Description,
    arguments: &Tiles,
    results: &Tiles,
) -> Result<(), Error> {
    let signature = function.signature();
    let width = |tiles: &Tiles| tiles.instruction_set().width();
    checks::length(Quantity::Arguments, [signature.arguments_len(description), 1], arguments.rows())?;
    checks::length(Quantity::Results, [signature.results_len(description), 1], results.rows())?;
    checks::length(Quantity::Configurations, [arguments.count(), 1], results.count())?;
    checks::length(Quantity::Lanes, [width(arguments), 1], width(results))
}

/// Writes the margin that a generated function returned behind its results, if it returned one.
#[inline(always)]
pub fn put_margin<T: Scalar, M: Margin<T>>(margin: M, rest: &mut [T]) -> Option<()> {
    if let Some(cosine) = margin.cosine() {
        *rest.first_mut()? = cosine;
    }
    Some(())
}
