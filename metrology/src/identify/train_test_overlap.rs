//! Detects test rows that were also fitted and therefore cannot assess the fit.

use std::collections::HashSet;
use std::hash::{Hash, Hasher};

use abbe::identify::Observation;

use crate::data::{Data, for_each_number, is_same};

/// Row compared by its values: joints, inputs and measurement.
struct RowKey<'a>(&'a Observation);

impl PartialEq for RowKey<'_> {
    fn eq(&self, other: &Self) -> bool {
        is_same(self.0, other.0)
    }
}

impl Eq for RowKey<'_> {}

impl Hash for RowKey<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        // Adding 0 turns −0 into +0, so that both have the same hash.
        for_each_number(self.0, |number| number.map(|number| (number + 0.0).to_bits()).hash(state));
    }
}

/// Counts the test rows whose values are identical to those of a fitted row.
pub(super) fn train_test_overlap(fit: &Data, test: &Data) -> usize {
    let test_keys: HashSet<RowKey<'_>> = test.observations.iter().map(RowKey).collect();
    let common = fit.observations.iter().map(RowKey).filter(|row| test_keys.contains(row));
    let common: HashSet<RowKey<'_>> = common.collect();
    test.observations.iter().filter(|row| common.contains(&RowKey(row))).count()
}

/// Returns a warning about `overlap` of `rows` test rows that were fitted, if there are any.
pub fn overlap_warning(overlap: usize, rows: usize) -> Option<String> {
    let (are, they) = if overlap == 1 { ("is a row", "it") } else { ("are rows", "they") };
    (overlap > 0).then(|| {
        format!("{overlap} of the {rows} test rows {are} of the fit: {they} cannot validate the model")
    })
}
