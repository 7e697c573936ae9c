//! The least and the largest errors within a bin, and where they are worst.

use abbe::analysis::Configuration;
use serde::{Deserialize, Serialize};

use super::bins::{Bins, Merge, listed};
use super::errors::{Errors, Place};

/// The narrowest bins: a micrometre or a microradian.
const FINEST: i32 = -20;

/// From the least to the largest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// The lower end.
    pub least: f64,
    /// The upper end.
    pub largest: f64,
}

impl Default for Range {
    fn default() -> Self {
        Self { least: f64::INFINITY, largest: f64::NEG_INFINITY }
    }
}

impl Range {
    /// Takes in a value.
    pub fn add(&mut self, value: f64) {
        self.least = self.least.min(value);
        self.largest = self.largest.max(value);
    }

    /// Takes in another range.
    pub fn join(&mut self, other: Self) {
        self.add(other.least);
        self.add(other.largest);
    }

    /// Half way between the ends.
    pub fn middle(self) -> f64 {
        f64::midpoint(self.least, self.largest)
    }

    /// The end that is farther from zero, with its sign.
    pub fn farther(self) -> f64 {
        if -self.least > self.largest { self.least } else { self.largest }
    }
}

/// A largest norm, and where.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Worst {
    /// In the length unit.
    pub norm: f64,
    /// Where.
    #[serde(with = "Place")]
    pub configuration: Configuration,
}

/// What happens within a bin.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Extremes {
    /// Which values of the travel fell into it.
    pub travel: Range,
    /// Along x, y and z.
    pub errors: [Range; 3],
    /// The largest norm, and where.
    pub worst: Option<Worst>,
}

impl Extremes {
    /// Takes in the errors at a configuration.
    pub(super) fn add(&mut self, travel: f64, errors: &Errors, configuration: &Configuration) {
        self.travel.add(travel);
        let parts = errors.repeatable.into_iter().zip(errors.random);
        for (range, (repeatable, random)) in self.errors.iter_mut().zip(parts) {
            range.add(repeatable - random);
            range.add(repeatable + random);
        }
        let norm = errors.norm();
        if self.worst.as_ref().is_none_or(|worst| norm > worst.norm) {
            self.worst = Some(Worst { norm, configuration: configuration.clone() });
        }
    }
}

impl Merge for Extremes {
    fn merge(&mut self, other: Self) {
        self.travel.join(other.travel);
        for (range, other) in self.errors.iter_mut().zip(other.errors) {
            range.join(other);
        }
        let norm = |worst: &Option<Worst>| worst.as_ref().map(|worst| worst.norm);
        if norm(&other.worst) > norm(&self.worst) {
            self.worst = other.worst;
        }
    }
}

/// The errors along a travel.
#[derive(Clone, Debug, Serialize)]
pub struct Envelope(#[serde(serialize_with = "listed")] pub Bins<Extremes>);

impl Envelope {
    /// So many different values are drawn as they are.
    const APART: usize = 512;
    /// Where there are more, so many bins of them.
    const TOGETHER: i64 = 48;

    /// Begins the gathering.
    pub(super) fn bins() -> Bins<Extremes> {
        Bins::new(FINEST, Self::APART)
    }

    /// Ends the gathering.
    pub(super) fn new(mut bins: Bins<Extremes>) -> Self {
        if bins.are_wide() {
            bins.span_at_most(Self::TOGETHER);
        }
        Self(bins)
    }
}

/// The errors over two travels: lines of bins, all of the same width in the end.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::analyze) struct Grid(Bins<Line>);

#[derive(Clone, Debug, Serialize, Deserialize)]
struct Line {
    travel: Range,
    bins: Bins<Extremes>,
}

impl Grid {
    /// The most lines, and bins in a line.
    const MOST: usize = 64;

    /// The bin of two values.
    pub(super) fn at(&mut self, first: f64, second: f64) -> &mut Extremes {
        let line = self.0.at(first);
        line.travel.add(first);
        line.bins.at(second)
    }

    /// Whether another one, which may come from a file, can be merged with this one.
    pub(super) fn accepts(&self, other: &Self) -> bool {
        let line = Line::default();
        self.0.accepts(&other.0) && other.0.iter().all(|(_, other)| line.bins.accepts(&other.bins))
    }

    /// Takes in another one.
    pub(super) fn merge(&mut self, other: Self) {
        self.0.merge(other.0);
    }

    /// The values of both travels, and what happens there, line by line; nothing where nothing fell.
    pub(super) fn mesh(self) -> Mesh {
        let exponents = self.0.iter().map(|(_, line)| line.bins.exponent());
        let exponent = exponents.max().unwrap_or(FINEST);
        let mut columns = Bins::<Range>::new(FINEST, usize::MAX);
        columns.widen(exponent);
        let lines = self.0.into_contents().map(|mut line| {
            line.bins.widen(exponent);
            line.bins.iter().for_each(|(_, cell)| columns.at(cell.travel.least).join(cell.travel));
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

/// Errors over two travels.
#[derive(Clone, Debug, Serialize)]
pub struct Mesh {
    /// The values of the first travel.
    pub first: Vec<f64>,
    /// The values of the second.
    pub second: Vec<f64>,
    /// One line for each value of the first.
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
        self.travel.join(other.travel);
        self.bins.merge(other.bins);
    }
}

impl Merge for Range {
    fn merge(&mut self, other: Self) {
        self.join(other);
    }
}
