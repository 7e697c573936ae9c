//! Test rows that were fitted: they cannot judge the fit.

use std::collections::HashSet;
use std::hash::{Hash, Hasher};

use abbe::identify::{Measurement, Observation};

use super::report::Report;
use crate::data::Data;

/// A row by its numbers: joints, inputs and what was measured.
struct Numbers<'a>(&'a Observation);

impl PartialEq for Numbers<'_> {
    fn eq(&self, other: &Self) -> bool {
        let (Self(own), Self(other)) = (self, other);
        own.q == other.q && own.u == other.u && own.measured == other.measured
    }
}

impl Eq for Numbers<'_> {}

impl Hash for Numbers<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        // No zero is another one by its sign.
        let mut add = |number: &f64| (number + 0.0).to_bits().hash(state);
        let Self(row) = self;
        row.q.iter().chain(&*row.u).for_each(&mut add);
        match &row.measured {
            Measurement::Points(points) => points.iter().flatten().flatten().for_each(add),
            Measurement::Pose(pose) => pose.0.as_flattened().iter().for_each(add),
            Measurement::Readings(readings) => readings.iter().flatten().for_each(add),
        }
    }
}

/// Counts the test rows that were fitted, digit by digit.
pub(super) fn train_test_overlap(fit: &Data, test: &Data) -> usize {
    let of_test: HashSet<Numbers<'_>> = test.observations.iter().map(Numbers).collect();
    let of_both = fit.observations.iter().map(Numbers).filter(|row| of_test.contains(row));
    let of_both: HashSet<Numbers<'_>> = of_both.collect();
    test.observations.iter().filter(|row| of_both.contains(&Numbers(row))).count()
}

/// Returns a sentence on them, if there are any.
pub(super) fn sentence(known: usize, rows: usize) -> Option<String> {
    let (are, them) = if known == 1 { ("is a row", "it") } else { ("are rows", "them") };
    (known > 0).then(|| {
        format!(
            "{known} of the {rows} test rows {are} of the fit, digit by digit: by {them} nothing is judged"
        )
    })
}

impl Report {
    /// Returns a sentence on test rows that were fitted, if there are any.
    pub fn on_train_test_overlap(&self) -> Option<String> {
        sentence(self.test_rows_of_the_fit, self.test.as_ref()?.rows)
    }
}
