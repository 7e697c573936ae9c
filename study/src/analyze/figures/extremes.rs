//! Smallest and largest errors in a bin, and the worst configuration.

use abbe::analysis::{Configuration, comparable};
use serde::{Deserialize, Serialize};

use super::bins::{Bins, Merge, listed};
use super::errors::Errors;

/// Exponent of the smallest bin width, 2^-20: about a micrometre or a microradian.
const FINEST: i32 = -20;

/// Closed interval of values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// Lower end.
    pub least: f64,
    /// Upper end.
    pub largest: f64,
}

impl Default for Range {
    fn default() -> Self {
        Self { least: f64::INFINITY, largest: f64::NEG_INFINITY }
    }
}

impl Range {
    /// Extends the range to a value.
    pub fn add(&mut self, value: f64) {
        self.least = self.least.min(value);
        self.largest = self.largest.max(value);
    }

    /// Returns the midpoint.
    pub fn middle(self) -> f64 {
        f64::midpoint(self.least, self.largest)
    }

    /// Returns the end that is farther from zero, with its sign.
    pub fn farther(self) -> f64 {
        if -self.least > self.largest { self.least } else { self.largest }
    }
}

/// Largest norm, and its configuration.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Worst {
    /// Norm of the error: the length unit, or rad.
    pub norm: f64,
    /// Configuration with this norm.
    pub configuration: Configuration,
}

/// Extremes of the errors in a bin.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Extremes {
    /// Range of the travel values in the bin.
    pub travel: Range,
    /// Ranges of the errors in three rows, random bounds included.
    pub errors: [Range; 3],
    /// Largest norm; `None` if the bin is empty.
    pub worst: Option<Worst>,
}

impl Extremes {
    /// Adds the errors at a configuration.
    pub(super) fn add(&mut self, travel: f64, errors: &Errors, configuration: &Configuration) {
        self.travel.add(travel);
        let parts = errors.repeatable.into_iter().zip(errors.random);
        for (range, (repeatable, random)) in self.errors.iter_mut().zip(parts) {
            range.add(repeatable - random);
            range.add(repeatable + random);
        }
        let norm = errors.norm();
        if self.worst.as_ref().is_none_or(|worst| comparable(norm) > comparable(worst.norm)) {
            self.worst = Some(Worst { norm, configuration: configuration.clone() });
        }
    }
}

impl Merge for Extremes {
    fn merge(&mut self, other: Self) {
        self.travel.merge(other.travel);
        for (range, other) in self.errors.iter_mut().zip(other.errors) {
            range.merge(other);
        }
        let norm = |worst: &Option<Worst>| worst.as_ref().map(|worst| comparable(worst.norm));
        if norm(&other.worst) > norm(&self.worst) {
            self.worst = other.worst;
        }
    }
}

/// Errors over a travel, in bins.
#[derive(Clone, Debug, Serialize)]
pub struct Envelope(#[serde(serialize_with = "listed")] pub Bins<Extremes>);

impl Envelope {
    /// Number of distinct values up to which each is drawn separately.
    const APART: usize = 512;
    /// Number of bins if there are more distinct values.
    const TOGETHER: i64 = 48;

    /// Creates the empty bins.
    pub(super) fn bins() -> Bins<Extremes> {
        Bins::new(FINEST, Self::APART)
    }

    /// Creates the envelope from the filled bins.
    pub(super) fn new(mut bins: Bins<Extremes>) -> Self {
        // Wide bins may hold several values.
        if bins.exponent > FINEST {
            bins.span_at_most(Self::TOGETHER);
        }
        Self(bins)
    }
}

/// Errors over two travels: a line of bins for each bin of the first travel, all of the same final
/// width.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::analyze) struct Grid(Bins<Line>);

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Line {
    travel: Range,
    bins: Bins<Extremes>,
}

impl Grid {
    /// Largest number of lines, and of bins in a line.
    const MOST: usize = 64;

    /// Returns the bin for the values of both travels.
    pub(super) fn bin_mut(&mut self, first: f64, second: f64) -> &mut Extremes {
        let line = self.0.bin_mut(first);
        line.travel.add(first);
        line.bins.bin_mut(second)
    }

    /// Returns true if another grid can be merged with this one. Checks untrusted data from a file.
    pub(super) fn accepts(&self, other: &Self) -> bool {
        let line = Line::default();
        self.0.accepts(&other.0) && other.0.iter().all(|(_, other)| line.bins.accepts(&other.bins))
    }

    /// Merges another grid.
    pub(super) fn merge(&mut self, other: Self) {
        self.0.merge(other.0);
    }

    /// Returns the mesh of both travels; a cell is `None` where no configuration fell.
    pub(super) fn mesh(self) -> Mesh {
        let exponent = self.0.iter().map(|(_, line)| line.bins.exponent).max().unwrap_or(FINEST);
        let mut columns = Bins::<Range>::new(FINEST, usize::MAX);
        columns.widen(exponent);
        let lines = self.0.into_contents().map(|mut line| {
            line.bins.widen(exponent);
            line.bins.iter().for_each(|(_, cell)| columns.bin_mut(cell.travel.least).merge(cell.travel));
            line
        });
        let lines = lines.collect::<Vec<_>>();
        let cell = |line: &Line, key: i64| line.bins.get(key).cloned();
        Mesh {
            first: lines.iter().map(|line| line.travel.middle()).collect(),
            second: columns.iter().map(|(_, travel)| travel.middle()).collect(),
            cells: lines
                .iter()
                .map(|line| columns.iter().map(|(key, _)| cell(line, key)).collect())
                .collect(),
        }
    }
}

/// Errors over a mesh of two travels.
#[derive(Clone, Debug, Serialize)]
pub struct Mesh {
    /// Values of the first travel.
    pub first: Vec<f64>,
    /// Values of the second travel.
    pub second: Vec<f64>,
    /// Extremes, one row per value of the first travel and one column per value of the second.
    pub cells: Vec<Vec<Option<Extremes>>>,
}

impl Default for Grid {
    fn default() -> Self {
        Self(Bins::new(FINEST, Self::MOST))
    }
}

impl Default for Line {
    fn default() -> Self {
        Self { travel: Range::default(), bins: Bins::new(FINEST, Grid::MOST) }
    }
}

impl Merge for Line {
    fn merge(&mut self, other: Self) {
        self.travel.merge(other.travel);
        self.bins.merge(other.bins);
    }
}

impl Merge for Range {
    fn merge(&mut self, other: Self) {
        self.add(other.least);
        self.add(other.largest);
    }
}
