//! Many entries as sums of few terms.

use crate::Scalar;

/// Adds to each entry its factors times terms: (entry, term, factor).
#[inline(always)]
pub fn combine<T: Scalar>(factors: &[(usize, usize, f64)], terms: &[T], entries: &mut [T]) {
    for &(entry, term, factor) in factors {
        entries[entry] = terms[term].mul_add(T::constant(factor), entries[entry]);
    }
}
