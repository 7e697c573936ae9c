//! Histograms of errors.

use serde::{Deserialize, Serialize, Serializer};

use super::bins::{Bins, Merge, listed};
use abbe::analysis::sampling::norm;

/// Histograms of the errors in x, y, z and of their norm.
#[derive(Clone, Debug, Serialize)]
pub struct Histogram(#[serde(serialize_with = "all_listed")] pub [Bins<Count>; 4]);

fn all_listed<S: Serializer>(all: &[Bins<Count>; 4], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Listed<'a>(#[serde(serialize_with = "one_listed")] &'a Bins<Count>);

    fn one_listed<S: Serializer>(bins: &&Bins<Count>, serializer: S) -> Result<S::Ok, S::Error> {
        listed(bins, serializer)
    }

    serializer.collect_seq(all.iter().map(Listed))
}

/// Number of configurations in a bin.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Count(pub usize);

impl Merge for Count {
    fn merge(&mut self, other: Self) {
        self.0 = self.0.saturating_add(other.0);
    }
}

impl Histogram {
    /// Creates the empty bins.
    pub(super) fn bins() -> [Bins<Count>; 4] {
        // The width 2^-50 is finer than any relevant error in m or mm.
        std::array::from_fn(|_| Bins::new(-50, 1024))
    }

    /// Counts an error.
    pub(super) fn add(all: &mut [Bins<Count>; 4], error: [f64; 3]) {
        let [x, y, z] = error;
        let values = [x, y, z, norm(error)];
        all.iter_mut().zip(values).for_each(|(bins, value)| bins.bin_mut(value).0 += 1);
    }

    /// Creates the histogram, with at most 40 bars per component.
    pub(super) fn new(mut all: [Bins<Count>; 4]) -> Self {
        all.iter_mut().for_each(|bins| bins.span_at_most(40));
        Self(all)
    }
}
