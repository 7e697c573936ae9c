//! A function of rows, run over tiles.

use super::{Kernel, Register, Tiles};
use crate::Scalar;

/// A function from rows of arguments to rows of results, for any scalar. Generated code has one per [`Path`](super::Path).
pub trait Function {
    /// Fills the results of one configuration, or of one in each lane. None if there are not enough rows.
    fn evaluate<T: Scalar>(arguments: &[T], results: &mut [T]) -> Option<()>;
}

/// Evaluates a function in all tiles.
///
/// # Panics
///
/// If arguments and results are laid out for different instruction sets.
pub fn run<F: Function>(arguments: &Tiles, results: &mut Tiles) {
    /// A function and what it works on.
    struct Over<'t, F>(&'t Tiles, &'t mut Tiles, core::marker::PhantomData<F>);

    impl<F: Function> Kernel for Over<'_, F> {
        type Output = ();

        #[inline(always)]
        fn run<R: Register>(self) {
            for tile in 0..self.0.tiles() {
                F::evaluate(self.0.tile::<R>(tile), self.1.tile_mut::<R>(tile));
            }
        }
    }

    arguments.instruction_set().run(Over::<F>(arguments, results, core::marker::PhantomData));
}

/// The next N values, to be filled.
#[inline(always)]
pub fn fill<'t, T, const N: usize>(rest: &mut &'t mut [T]) -> Option<&'t mut [T; N]> {
    let (values, others) = core::mem::take(rest).split_first_chunk_mut()?;
    *rest = others;
    Some(values)
}

/// The next M columns of N values, to be filled.
#[inline(always)]
pub fn fill_columns<'t, T, const N: usize, const M: usize>(
    rest: &mut &'t mut [T],
) -> Option<&'t mut [[T; N]; M]> {
    let (values, others) = core::mem::take(rest).split_at_mut_checked(N * M)?;
    *rest = others;
    values.as_chunks_mut().0.try_into().ok()
}

/// The next N groups of M vectors, to be filled.
#[inline(always)]
pub fn fill_vectors<'t, T, const M: usize, const N: usize>(
    rest: &mut &'t mut [T],
) -> Option<&'t mut [[[T; 3]; M]; N]> {
    let (values, others) = core::mem::take(rest).split_at_mut_checked(3 * M * N)?;
    *rest = others;
    values.as_chunks_mut::<3>().0.as_chunks_mut::<M>().0.try_into().ok()
}

/// What a raw function returns: `cos ρ` where rows are Euler angles, nothing otherwise.
pub trait Margin<T> {
    /// Writes it behind the other results.
    fn put(self, rest: &mut [T]) -> Option<()>;
}

impl<T> Margin<T> for () {
    #[inline(always)]
    fn put(self, _: &mut [T]) -> Option<()> {
        Some(())
    }
}

impl<T: Scalar> Margin<T> for T {
    #[inline(always)]
    fn put(self, rest: &mut [T]) -> Option<()> {
        *rest.first_mut()? = self;
        Some(())
    }
}
