//! Words of a study file that stand for one of a few values.

use abbe::analysis::Measurand;

/// Kind of a figure.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Travel,
    Surface,
    Cloud,
    Histogram,
    Pareto,
    Manipulator,
}

pub(super) const KINDS: [(&str, Kind); 6] = [
    ("travel", Kind::Travel),
    ("surface", Kind::Surface),
    ("cloud", Kind::Cloud),
    ("histogram", Kind::Histogram),
    ("pareto", Kind::Pareto),
    ("manipulator", Kind::Manipulator),
];

pub(super) const UP_AXES: [(&str, usize); 3] = [("x", 0), ("y", 1), ("z", 2)];

pub(super) const MEASURANDS: [(&str, Measurand); 2] =
    [("position", Measurand::Position), ("orientation", Measurand::Orientation)];

/// Machine that a tolerance is held against.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum JudgedMachine {
    /// The machine as built: repeatable errors at their values.
    AsBuilt,
    /// The compensated machine: repeatable errors corrected.
    Compensated,
}

pub(super) const MACHINES: [(&str, JudgedMachine); 2] =
    [("as-built", JudgedMachine::AsBuilt), ("compensated", JudgedMachine::Compensated)];

/// Criterion by which a study judges a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Criterion {
    /// The largest error over all signs is within the tolerance.
    WorstCase,
    /// The norm of the repeatable errors + the root sum of squares of the others is within it: a
    /// convention, not a bound.
    #[serde(rename = "rss")]
    RootSumOfSquares,
    /// The error is within it with the required probability.
    Probability,
    /// The required share of machines keeps it at all configurations, each with that probability.
    Yield,
}

pub(super) const CRITERIA: [(&str, Criterion); 4] = [
    ("worst-case", Criterion::WorstCase),
    ("rss", Criterion::RootSumOfSquares),
    ("probability", Criterion::Probability),
    ("yield", Criterion::Yield),
];

/// Metric of a published figure of a single source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// Largest error.
    PlainMaximum,
    /// Half of the range of the error.
    HalfPeakToPeak,
    /// Largest difference from the error at home.
    RelativeToHome,
}

impl Metric {
    /// Metrics with their names in a study file.
    pub const ALL: [(&'static str, Self); 3] = [
        ("plain maximum", Self::PlainMaximum),
        ("half peak-to-peak", Self::HalfPeakToPeak),
        ("relative to home", Self::RelativeToHome),
    ];
}

/// Published figure of all sources together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CombinedFigure {
    /// Sum of the repeatable sources with their signs.
    Repeatable,
    /// Root sum of squares of the random sources.
    Random,
    /// Sum of the repeatable and the random norm.
    Both,
}

impl CombinedFigure {
    /// Figures with their names in a study file.
    pub const ALL: [(&'static str, Self); 3] =
        [("repeatable radius", Self::Repeatable), ("random radius", Self::Random), ("radius", Self::Both)];
}
