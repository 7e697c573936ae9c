//! A function of a manipulator, run over tiles.

use super::{Kernel, Named, Register, Tiles};
use crate::{Description, Error, Function, Manipulator, Quantity, Scalar};

/// A manipulator whose function `F` is compiled for any scalar: lanes, too. Generated ones have all functions so.
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no code for lanes",
    note = "a manipulator that is not generated is evaluated as `abbe::lanes::OneByOne(manipulator)`"
)]
pub trait Evaluate<F: Named>: Manipulator {
    /// Fills the results of one configuration, or of one in each lane: rows as the function's
    /// [`Signature`](crate::function::Signature) says. None if there are not enough rows.
    ///
    /// Everything in it must be `#[inline(always)]`, as in any [`Kernel`].
    fn evaluate<T: Scalar>(&self, arguments: &[T], results: &mut [T]) -> Option<()>;
}

/// Evaluates a function in all configurations, in the lanes of the instruction set that the tiles are laid out for.
///
/// Rows of arguments and results are as the function's [`Signature`](crate::function::Signature) says. This is compiled
/// where it is called, for this function of this manipulator and for every instruction set. Nothing but counts is
/// checked ([`Error::Count`]): what is not finite, or not defined, stays so in its configuration.
pub fn run<M: Evaluate<F> + ?Sized, F: Named>(
    manipulator: &M,
    _function: F,
    arguments: &Tiles,
    results: &mut Tiles,
) -> Result<(), Error> {
    check(F::FUNCTION, manipulator.description(), arguments, results)?;
    arguments.instruction_set().run(Over {
        manipulator,
        arguments,
        results,
        function: core::marker::PhantomData::<F>,
    });
    Ok(())
}

/// A function and what it works on.
struct Over<'a, M: ?Sized, F> {
    manipulator: &'a M,
    arguments: &'a Tiles,
    results: &'a mut Tiles,
    function: core::marker::PhantomData<F>,
}

impl<M: Evaluate<F> + ?Sized, F: Named> Kernel for Over<'_, M, F> {
    type Output = ();

    #[inline(always)]
    fn run<R: Register>(self) {
        for tile in 0..self.arguments.tiles() {
            self.manipulator.evaluate(self.arguments.tile::<R>(tile), self.results.tile_mut::<R>(tile));
        }
    }
}

/// [`Error::Count`] unless arguments and results have the rows of this function, as many configurations as each
/// other, and the layout of one instruction set.
pub fn check(
    function: Function,
    description: &Description,
    arguments: &Tiles,
    results: &Tiles,
) -> Result<(), Error> {
    let signature = function.signature();
    for (quantity, expected, found) in [
        (Quantity::Arguments, signature.arguments_len(description), arguments.rows()),
        (Quantity::Results, signature.results_len(description), results.rows()),
        (Quantity::Configurations, arguments.count(), results.count()),
        (Quantity::Lanes, arguments.instruction_set().width(), results.instruction_set().width()),
    ] {
        if expected != found {
            return Err(Error::Count { quantity, expected, found });
        }
    }
    Ok(())
}
