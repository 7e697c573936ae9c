//! Rows in blocks of a fixed size, one per thread.

use super::Failure;
use abbe_analysis::in_order;

/// Number of rows in a block: fixed, so that results do not depend on the number of threads.
const ROWS: usize = 512;

/// Computes `make(first, rows)` for each block in parallel, with the index of its first row, and
/// takes the results in order.
pub(super) fn by_blocks<R: Sync, T: Send>(
    rows: &[R],
    make: impl Fn(usize, &[R]) -> Result<T, Failure> + Sync,
    take: impl FnMut(T),
) -> Result<(), Failure> {
    let block = |block| {
        let first = block * ROWS;
        make(first, &rows[first..rows.len().min(first + ROWS)])
    };
    in_order(rows.len().div_ceil(ROWS), block, take)
}
