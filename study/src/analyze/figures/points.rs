//! A part of the configurations, spread evenly over all of them.

use abbe::analysis::Configuration;
use serde::Serialize;

use super::errors::{Errors, Place};

/// An error in space.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// Along x, y and z.
    pub error: [f64; 3],
    /// Where.
    #[serde(with = "Place")]
    pub configuration: Configuration,
}

/// Every so many configurations, and the worst of all.
#[derive(Clone, Debug, Serialize)]
pub struct Points {
    #[serde(skip)]
    stride: usize,
    seen: usize,
    /// Those that are kept.
    pub kept: Vec<Point>,
    /// The worst of all, with the norm of both parts, added.
    pub worst: Option<(f64, Point)>,
}

impl Points {
    /// The most points that are kept.
    const MOST: usize = 5000;

    /// Takes in the errors at the next configuration.
    ///
    /// What is kept are the repeatable errors, or the bounds of the random ones.
    pub(super) fn add(&mut self, errors: &Errors, bounds: bool, configuration: &Configuration) {
        let error = if bounds { errors.random } else { errors.repeatable };
        let point = || Point { error, configuration: configuration.clone() };
        if self.seen.is_multiple_of(self.stride) {
            if self.kept.len() >= Self::MOST {
                // Every other one of those that are there, and half as many of those to come.
                let mut even = [true, false].into_iter().cycle();
                self.kept.retain(|_| even.next().unwrap_or_default());
                self.stride *= 2;
            }
            if self.seen.is_multiple_of(self.stride) {
                self.kept.push(point());
            }
        }
        self.seen += 1;
        let norm = errors.norm();
        if self.worst.as_ref().is_none_or(|(worst, _)| norm > *worst) {
            self.worst = Some((norm, point()));
        }
    }

    /// How many configurations there were.
    pub fn seen(&self) -> usize {
        self.seen
    }
}

impl Default for Points {
    fn default() -> Self {
        Self { stride: 1, seen: 0, kept: Vec::new(), worst: None }
    }
}

#[cfg(test)]
mod tests {
    use abbe::analysis::Configuration;

    use super::super::errors::Errors;
    use super::Points;

    #[test]
    fn they_are_few_and_evenly_spread() {
        let mut points = Points::default();
        let configuration = Configuration { q: Vec::new(), s: Vec::new(), u: Vec::new() };
        for i in 0..54_321 {
            let repeatable = [f64::from(i), 0.0, 0.0];
            points.add(&Errors { repeatable, random: [0.0; 3] }, false, &configuration);
        }
        assert!((2500..=5000).contains(&points.kept.len()), "{}", points.kept.len());
        for pair in points.kept.windows(2) {
            assert_eq!(pair[1].error[0] - pair[0].error[0], 16.0);
        }
        assert_eq!(points.worst.map(|(norm, _)| norm), Some(54_320.0));
    }
}
