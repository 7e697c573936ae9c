//! Arrays that generated functions take and fill, as consecutive rows of a batch.

use crate::Scalar;
use crate::checks::Margin;

/// Array of numbers that occupies one row per number.
pub trait Rows<T>: Sized {
    /// Splits the array off the first rows of `rest`. Returns `None` if there are too few.
    fn take<'t>(rest: &mut &'t [T]) -> Option<&'t Self>;
    /// Splits a mutable array off the first rows of `rest`. Returns `None` if there are too few.
    fn fill<'t>(rest: &mut &'t mut [T]) -> Option<&'t mut Self>;
}

impl<T: Scalar, const N: usize> Rows<T> for [T; N] {
    #[inline(always)]
    fn take<'t>(rest: &mut &'t [T]) -> Option<&'t Self> {
        let (values, others) = rest.split_first_chunk()?;
        *rest = others;
        Some(values)
    }

    #[inline(always)]
    fn fill<'t>(rest: &mut &'t mut [T]) -> Option<&'t mut Self> {
        let (values, others) = core::mem::take(rest).split_first_chunk_mut()?;
        *rest = others;
        Some(values)
    }
}

impl<T: Scalar, const M: usize, const N: usize> Rows<T> for [[T; M]; N] {
    #[inline(always)]
    fn take<'t>(rest: &mut &'t [T]) -> Option<&'t Self> {
        let (values, others) = rest.split_at_checked(M * N)?;
        *rest = others;
        values.as_chunks().0.try_into().ok()
    }

    #[inline(always)]
    fn fill<'t>(rest: &mut &'t mut [T]) -> Option<&'t mut Self> {
        let (values, others) = core::mem::take(rest).split_at_mut_checked(M * N)?;
        *rest = others;
        values.as_chunks_mut().0.try_into().ok()
    }
}

impl<T: Scalar, const L: usize, const M: usize, const N: usize> Rows<T> for [[[T; L]; M]; N] {
    #[inline(always)]
    fn take<'t>(rest: &mut &'t [T]) -> Option<&'t Self> {
        let (values, others) = rest.split_at_checked(L * M * N)?;
        *rest = others;
        values.as_chunks::<L>().0.as_chunks().0.try_into().ok()
    }

    #[inline(always)]
    fn fill<'t>(rest: &mut &'t mut [T]) -> Option<&'t mut Self> {
        let (values, others) = core::mem::take(rest).split_at_mut_checked(L * M * N)?;
        *rest = others;
        values.as_chunks_mut::<L>().0.as_chunks_mut().0.try_into().ok()
    }
}

/// Writes the margin that a generated function returned behind its results, if it returned one.
#[inline(always)]
pub fn put_margin<T: Scalar, M: Margin<T>>(margin: M, rest: &mut [T]) -> Option<()> {
    if let Some(cosine) = margin.cosine() {
        *rest.first_mut()? = cosine;
    }
    Some(())
}
