//! Subset of the configurations, spread evenly over the workspace.

use abbe::analysis::Configuration;
use serde::{Deserialize, Serialize};

use super::errors::Errors;

/// Error at one configuration.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Point {
    /// Index of the configuration in the workspace.
    pub index: usize,
    /// Error along x, y and z of `F_0`, in the length unit; of orientations, rows 4–6 in rad.
    pub error: [f64; 3],
    /// The configuration.
    pub configuration: Configuration,
}

/// Errors at every n-th configuration of the workspace, and the worst of all.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Points {
    /// Spacing of the kept indices: the smallest power of 2 that keeps the limit.
    stride: usize,
    /// Number of configurations that were seen.
    pub seen: usize,
    /// Kept points.
    pub kept: Vec<Point>,
    /// Worst configuration of all, with its norm: repeatable + random.
    pub worst: Option<(f64, Point)>,
}

impl Points {
    /// Largest number of kept points.
    const MOST: usize = 5000;

    /// Adds the errors at the configuration with this index.
    ///
    /// Keeps the repeatable errors, or with `bounds` those of the random bounds.
    pub(super) fn add(&mut self, index: usize, errors: &Errors, bounds: bool, configuration: &Configuration) {
        let error = if bounds { errors.random } else { errors.repeatable };
        let point = || Point { index, error, configuration: configuration.clone() };
        if index.is_multiple_of(self.stride) {
            self.kept.push(point());
            self.thin();
        }
        self.seen += 1;
        let norm = errors.norm();
        if self.worst.as_ref().is_none_or(|(worst, _)| norm > *worst) {
            self.worst = Some((norm, point()));
        }
    }

    /// Returns true if other points can follow these. Checks untrusted data from a file.
    pub(super) fn accepts(&self, other: &Self) -> bool {
        let indices = self.kept.last().into_iter().chain(&other.kept).map(|point| point.index);
        other.stride.is_power_of_two() && other.kept.len() <= Self::MOST && indices.is_sorted_by(|a, b| a < b)
    }

    /// Appends the points that follow.
    pub(super) fn append(&mut self, other: Self) {
        self.stride = self.stride.max(other.stride);
        self.kept.extend(other.kept);
        self.kept.retain(|point| point.index.is_multiple_of(self.stride));
        self.thin();
        self.seen = self.seen.saturating_add(other.seen);
        let norm = |worst: &Option<(f64, Point)>| worst.as_ref().map(|(norm, _)| *norm);
        if norm(&other.worst) > norm(&self.worst) {
            self.worst = other.worst;
        }
    }

    fn thin(&mut self) {
        while self.kept.len() > Self::MOST {
            self.stride *= 2;
            self.kept.retain(|point| point.index.is_multiple_of(self.stride));
        }
    }
}

impl Default for Points {
    fn default() -> Self {
        Self { stride: 1, seen: 0, kept: Vec::new(), worst: None }
    }
}

#[cfg(test)]
mod tests;
