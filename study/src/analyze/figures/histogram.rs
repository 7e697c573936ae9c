//! How often which error occurs.

use serde::Serialize;

use super::bins::{Bins, Merge};
use super::errors::norm;

/// How often errors are in a bin: along x, y, z, and of the norm.
#[derive(Clone, Debug, Serialize)]
pub struct Histogram(pub [Bins<Count>; 4]);

/// How often.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Count(pub usize);

impl Merge for Count {
    fn merge(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl Default for Histogram {
    fn default() -> Self {
        // Finer than any error that matters, in m or mm.
        Self(std::array::from_fn(|_| Bins::new(-50, 1024)))
    }
}

impl Histogram {
    /// Takes in an error.
    pub(super) fn add(&mut self, error: [f64; 3]) {
        let [x, y, z] = error;
        let values = [x, y, z, norm(error)];
        self.0.iter_mut().zip(values).for_each(|(bins, value)| bins.at(value).0 += 1);
    }

    /// Ends the gathering: some twenty to forty bars.
    pub(super) fn finish(&mut self) {
        self.0.iter_mut().for_each(|bins| bins.span_at_most(40));
    }
}
