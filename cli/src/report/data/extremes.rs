//! The least and the largest errors within a bin, and where they are worst.

use abbe::analysis::Configuration;

use super::bins::{Bins, Merge};
use super::gather::Errors;

/// The narrowest bins: a micrometre or a microradian.
const FINEST: i32 = -20;

/// From the least to the largest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::report) struct Range {
    pub(in crate::report) least: f64,
    pub(in crate::report) largest: f64,
}

impl Default for Range {
    fn default() -> Self {
        Self { least: f64::INFINITY, largest: f64::NEG_INFINITY }
    }
}

impl Range {
    /// Takes in a value.
    pub(in crate::report) fn add(&mut self, value: f64) {
        self.least = self.least.min(value);
        self.largest = self.largest.max(value);
    }

    /// Takes in another range.
    pub(in crate::report) fn join(&mut self, other: Self) {
        self.add(other.least);
        self.add(other.largest);
    }

    pub(in crate::report) fn middle(self) -> f64 {
        f64::midpoint(self.least, self.largest)
    }

    /// The end that is farther from zero, with its sign.
    pub(in crate::report) fn farther(self) -> f64 {
        if -self.least > self.largest { self.least } else { self.largest }
    }
}

/// What happens within a bin.
#[derive(Clone, Debug, Default)]
pub(in crate::report) struct Extremes {
    /// Which values of the travel fell into it.
    pub(in crate::report) travel: Range,
    /// Along x, y and z.
    pub(in crate::report) errors: [Range; 3],
    /// The largest norm, and where.
    pub(in crate::report) worst: Option<(f64, Configuration)>,
}

impl Extremes {
    /// Takes in the errors at a configuration.
    pub(in crate::report) fn add(&mut self, travel: f64, errors: &Errors, configuration: &Configuration) {
        self.travel.add(travel);
        let parts = errors.repeatable.into_iter().zip(errors.random);
        for (range, (repeatable, random)) in self.errors.iter_mut().zip(parts) {
            range.add(repeatable - random);
            range.add(repeatable + random);
        }
        let norm = errors.norm();
        if self.worst.as_ref().is_none_or(|(worst, _)| norm > *worst) {
            self.worst = Some((norm, configuration.clone()));
        }
    }
}

impl Merge for Extremes {
    fn merge(&mut self, other: Self) {
        self.travel.join(other.travel);
        for (range, other) in self.errors.iter_mut().zip(other.errors) {
            range.join(other);
        }
        let norm = |worst: &Option<(f64, _)>| worst.as_ref().map(|(norm, _)| *norm);
        if norm(&other.worst) > norm(&self.worst) {
            self.worst = other.worst;
        }
    }
}

/// The errors along a travel.
#[derive(Clone, Debug)]
pub(in crate::report) struct Envelope(pub(in crate::report) Bins<Extremes>);

impl Envelope {
    /// So many different values are drawn as they are.
    const APART: usize = 512;
    /// Where there are more, so many bins of them.
    const TOGETHER: i64 = 48;

    /// Ends the gathering.
    pub(in crate::report) fn finish(&mut self) {
        if self.0.are_wide() {
            self.0.span_at_most(Self::TOGETHER);
        }
    }
}

impl Default for Envelope {
    fn default() -> Self {
        Self(Bins::new(FINEST, Self::APART))
    }
}

/// The errors over two travels: lines of bins, all of the same width in the end.
#[derive(Clone, Debug)]
pub(in crate::report) struct Grid(Bins<Line>);

#[derive(Clone, Debug)]
struct Line {
    travel: Range,
    bins: Bins<Extremes>,
}

impl Grid {
    /// The most lines, and bins in a line.
    const MOST: usize = 64;

    /// The bin of two values.
    pub(in crate::report) fn at(&mut self, first: f64, second: f64) -> &mut Extremes {
        let line = self.0.at(first);
        line.travel.add(first);
        line.bins.at(second)
    }

    /// The values of both travels, and what happens there, line by line; nothing where nothing fell.
    pub(in crate::report) fn mesh(self) -> Mesh {
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
#[derive(Clone, Debug)]
pub(in crate::report) struct Mesh {
    pub(in crate::report) first: Vec<f64>,
    pub(in crate::report) second: Vec<f64>,
    /// One line for each value of the first.
    pub(in crate::report) cells: Vec<Vec<Option<Extremes>>>,
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
