//! Many entries as sums of few terms.

use crate::Scalar;

/// Entries that begin as constants, and to each of them its factors times terms: (entry, term, factor).
#[inline(always)]
pub fn combine<T: Scalar>(
    constants: &[f64],
    factors: &[(usize, usize, f64)],
    terms: &[T],
    entries: &mut [T],
) {
    for (entry, constant) in entries.iter_mut().zip(constants) {
        *entry = T::constant(*constant);
    }
    for &(entry, term, factor) in factors {
        entries[entry] = terms[term].mul_add(T::constant(factor), entries[entry]);
    }
}
