//! Uncertainty of a calibration over a workspace: its independent parts as one source.
//!
//! With the displacements b_k of the parts at their bounds, the calibration has along each axis
//! `√(Σ b_k²)`, as the random sources are added.

use abbe::Class;
use abbe::analysis::{Budget, Figures, Measurand, Row, SourceErrors};
use serde::{Deserialize, Serialize};

/// Largest errors of a calibration over some configurations, of position and orientation.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct LargestCalibrationErrors([Largest; 2]);

/// Largest absolute values along three rows, the largest norm, and its configuration.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Largest {
    rows: [f64; 3],
    norm: f64,
    worst: Option<usize>,
}

impl LargestCalibrationErrors {
    /// Creates the errors of no configurations.
    pub(super) fn new() -> Self {
        Self(Default::default())
    }

    /// Adds a configuration. The parts are the sources from `first` on.
    pub(super) fn add(&mut self, row: &Row, first: usize) {
        for (measurand, largest) in Measurand::ALL.into_iter().zip(&mut self.0) {
            if measurand == Measurand::Orientation && !row.oriented {
                continue;
            }
            let mut squares = [0.0; 3];
            for part in &row.sources[first..] {
                let part = measurand.rows(part);
                squares = std::array::from_fn(|i| squares[i] + part[i] * part[i]);
            }
            let here = Largest {
                rows: squares.map(f64::sqrt),
                norm: squares.iter().sum::<f64>().sqrt(),
                worst: Some(row.index),
            };
            largest.merge(&here);
        }
    }

    /// Appends the following configurations.
    pub(super) fn append(&mut self, next: &Self) {
        self.0.iter_mut().zip(&next.0).for_each(|(largest, next)| largest.merge(next));
    }

    /// Returns whether the errors can belong to a workspace of this size. They may come from a
    /// file.
    pub(super) fn fits(&self, configurations: usize) -> bool {
        self.0.iter().all(|largest| largest.worst.is_none_or(|index| index < configurations))
    }

    /// Replaces the parts in a budget, the sources from `first` on, by the calibration.
    pub(super) fn replace_parts(&self, budget: &mut Budget, first: usize) {
        let [position, turn] = &self.0;
        position.replace_parts(&mut budget.sources, first);
        turn.replace_parts(&mut budget.orientation.sources, first);
    }
}

impl Largest {
    fn merge(&mut self, other: &Self) {
        if self.worst.is_none() || other.norm > self.norm {
            (self.norm, self.worst) = (other.norm, other.worst.or(self.worst));
        }
        self.rows = std::array::from_fn(|i| self.rows[i].max(other.rows[i]));
    }

    fn replace_parts(&self, sources: &mut Vec<SourceErrors>, first: usize) {
        let Some(class) = sources.get(first).map(|part| part.class) else { return };
        debug_assert!(class != Class::Repeatable, "a calibration is uncertain");
        let parts = sources.split_off(first);
        let root = |figure: &dyn Fn(&SourceErrors) -> f64| {
            parts.iter().map(|part| figure(part).powi(2)).sum::<f64>().sqrt()
        };
        let [x, y, z] = self.rows;
        let plain_max = Figures { x, y, z, norm: self.norm };
        sources.push(SourceErrors {
            source: first,
            class,
            plain_max,
            half_peak_to_peak: plain_max,
            // An upper bound: the parts may be largest at different configurations.
            relative_to_home: Figures {
                x: root(&|part| part.relative_to_home.x),
                y: root(&|part| part.relative_to_home.y),
                z: root(&|part| part.relative_to_home.z),
                norm: root(&|part| part.relative_to_home.norm),
            },
            rms: root(&|part| part.rms),
            worst: self.worst,
        });
    }
}
