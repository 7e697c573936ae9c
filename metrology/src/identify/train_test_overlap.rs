//! Detects test rows that were also fitted and therefore cannot assess the fit.

use std::collections::HashSet;

use crate::data::{Data, hash};

/// Counts the test rows whose values are identical to those of a fitted row.
pub(super) fn train_test_overlap(fit: &Data, test: &Data) -> usize {
    let tested: HashSet<u64> = test.observations.iter().map(hash).collect();
    let common: HashSet<u64> = fit.observations.iter().map(hash).filter(|row| tested.contains(row)).collect();
    test.observations.iter().filter(|row| common.contains(&hash(row))).count()
}

/// Returns a warning about `overlap` of `rows` test rows that were fitted, if there are any.
pub fn overlap_warning(overlap: usize, rows: usize) -> Option<String> {
    let (are, they) = if overlap == 1 { ("is a row", "it") } else { ("are rows", "they") };
    (overlap > 0).then(|| {
        format!("{overlap} of the {rows} test rows {are} of the fit: {they} cannot validate the model")
    })
}
