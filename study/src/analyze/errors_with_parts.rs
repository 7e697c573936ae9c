//! Largest errors of balls, discs and a calibration over a workspace: their parts as one source.

use abbe::analysis::{Budget, ErrorParts, Extreme, Figures, Measurand, Row, SourceErrors};
use serde::{Deserialize, Serialize};

/// Largest errors of each error with several parts over some configurations, of position and
/// orientation.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct LargestWithParts(Vec<[Largest; 2]>);

/// Largest absolute values along three rows, the largest norm, and its configuration.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Largest {
    rows: [f64; 3],
    norm: Extreme,
}

impl LargestWithParts {
    /// Creates the errors of no configurations.
    pub(super) fn new(parts: &ErrorParts) -> Self {
        Self(parts.with_parts().map(|_| Default::default()).collect())
    }

    /// Returns whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds a configuration.
    pub(super) fn add(&mut self, row: &Row, parts: &ErrorParts) {
        for (largest, own) in self.0.iter_mut().zip(parts.with_parts()) {
            for (measurand, largest) in Measurand::ALL.into_iter().zip(largest) {
                if measurand == Measurand::Position || row.oriented {
                    let (rows, norm) = parts.largest(own[0], row.sources, measurand);
                    let norm = Extreme { value: norm, configuration: Some(row.index) };
                    largest.merge(&Largest { rows, norm });
                }
            }
        }
    }

    /// Appends the following configurations.
    pub(super) fn append(&mut self, next: &Self) {
        let both = self.0.as_flattened_mut().iter_mut().zip(next.0.as_flattened());
        both.for_each(|(largest, next)| largest.merge(next));
    }

    /// Returns whether the errors can belong to these parts and a workspace of this size. They may
    /// come from a file.
    pub(super) fn fits(&self, parts: &ErrorParts, configurations: usize) -> bool {
        let in_workspace =
            |largest: &Largest| largest.norm.configuration.is_none_or(|index| index < configurations);
        self.0.len() == parts.with_parts().count() && self.0.as_flattened().iter().all(in_workspace)
    }

    /// Replaces the parts in a budget by the whole errors.
    pub(super) fn replace_parts(&self, budget: &mut Budget, parts: &ErrorParts) {
        for (measurand, sources) in
            Measurand::ALL.into_iter().zip([&mut budget.sources, &mut budget.orientation.sources])
        {
            for (largest, own) in self.0.iter().zip(parts.with_parts()) {
                sources[own[0]] = largest[measurand as usize].whole(own, sources);
            }
            sources.retain(|errors| !parts.parts_of(errors.source).is_empty());
        }
    }
}

impl Largest {
    fn merge(&mut self, other: &Self) {
        self.norm.merge(&other.norm);
        self.rows = std::array::from_fn(|i| self.rows[i].max(other.rows[i]));
    }

    fn whole(&self, parts: &[usize], sources: &[SourceErrors]) -> SourceErrors {
        let root = |figure: &dyn Fn(&SourceErrors) -> f64| {
            parts.iter().map(|part| figure(&sources[*part]).powi(2)).sum::<f64>().sqrt()
        };
        let [x, y, z] = self.rows;
        let plain_max = Figures { x, y, z, norm: self.norm.value };
        SourceErrors {
            plain_max,
            half_peak_to_peak: plain_max,
            // An upper bound: the parts may be largest at different configurations.
            relative_to_home: Figures {
                x: root(&|part| part.relative_to_home.x),
                y: root(&|part| part.relative_to_home.y),
                z: root(&|part| part.relative_to_home.z),
                norm: root(&|part| part.relative_to_home.norm),
            },
            rms: root(&|part| part.rms).min(self.norm.value),
            worst: self.norm.configuration,
            ..sources[parts[0]]
        }
    }
}
