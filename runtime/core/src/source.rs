//! Error sources: their classes and distributions, and the generalized errors that they cause.

use crate::{Component, Text};

/// Class of an error: whether its value is known, and the same at each visit of a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Has a known value and sign: adds with sign, and can be compensated.
    Repeatable,
    /// Has one fixed value in each machine, which is unknown: as built it adds as a random one, but
    /// it can be compensated. Machines vary by the distribution.
    Tolerance(Distribution),
    /// Varies unpredictably: adds as root sum of squares, and cannot be compensated.
    Random(Distribution),
}

impl Class {
    /// Returns the distribution of an error whose value is unknown; `None` for a repeatable one.
    pub const fn distribution(self) -> Option<Distribution> {
        match self {
            Self::Repeatable => None,
            Self::Tolerance(distribution) | Self::Random(distribution) => Some(distribution),
        }
    }

    /// Returns whether the error has a bound. A repeatable error always has: its value.
    pub const fn is_bounded(self) -> bool {
        match self.distribution() {
            None => true,
            Some(distribution) => distribution.is_bounded(),
        }
    }

    /// Returns the bound of the error in multiples of its magnitude.
    pub const fn bound(self) -> f64 {
        match self.distribution() {
            None => 1.0,
            Some(distribution) => distribution.bound(),
        }
    }

    /// Returns whether the error stays the same, so that a calibration can find it and a controller
    /// can compensate it.
    pub const fn can_be_compensated(self) -> bool {
        !matches!(self, Self::Random(_))
    }
}

/// Distribution of an error whose value is unknown, which defines the meaning of its magnitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// The magnitude is the half-width.
    Uniform,
    /// The magnitude is the standard deviation.
    Normal,
    /// The magnitude is the half-width; the center is most likely.
    Triangular,
    /// The magnitude is the amplitude of a sine of unknown phase, such as an eccentricity; the ends
    /// are most likely.
    Arcsine,
    /// The magnitude is the semi-axis of an ellipsoid, or of an ellipse, in which the errors of all
    /// parts together are evenly distributed. One error has two or three parts, each a source: the
    /// first part is in its place, the others follow all errors of the file.
    Ball {
        /// Number of this part, from 0.
        part: u8,
        /// Number of parts, 2 or 3.
        parts: u8,
    },
}

impl Distribution {
    /// All distributions; the last is the first part of an error with two or three parts.
    pub const ALL: [Self; 6] = [
        Self::Uniform,
        Self::Normal,
        Self::Triangular,
        Self::Arcsine,
        Self::Ball { part: 0, parts: 2 },
        Self::Ball { part: 0, parts: 3 },
    ];

    /// Returns the name in a spec file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Normal => "normal",
            Self::Triangular => "triangular",
            Self::Arcsine => "arcsine",
            Self::Ball { parts: 2, .. } => "disc",
            Self::Ball { .. } => "ball",
        }
    }

    /// Returns whether no error exceeds [`bound`](Self::bound).
    pub const fn is_bounded(self) -> bool {
        !matches!(self, Self::Normal)
    }

    /// Returns the bound of an error in multiples of its magnitude: 3 for a normal error (3σ, which
    /// 0.27 % of the errors exceed), 1 for all others.
    pub const fn bound(self) -> f64 {
        if self.is_bounded() { 1.0 } else { 3.0 }
    }

    /// Returns the square of the [`divisor`](Self::divisor).
    pub const fn divisor_squared(self) -> f64 {
        match self {
            Self::Uniform => 3.0,
            Self::Normal => 1.0,
            Self::Triangular => 6.0,
            Self::Arcsine => 2.0,
            Self::Ball { parts, .. } => parts as f64 + 2.0,
        }
    }

    /// Returns the divisor of the magnitude that yields the standard uncertainty (GUM, 4.3.7 and
    /// 4.3.9): √3 for a uniform error, 1 for a normal, √6 for a triangular and √2 for an arcsine
    /// one, 2 and √5 along each semi-axis of a disc and of a ball.
    pub const fn divisor(self) -> f64 {
        match self {
            Self::Uniform => 1.732_050_807_568_877_2,
            Self::Normal => 1.0,
            Self::Triangular => 2.449_489_742_783_178,
            Self::Arcsine => core::f64::consts::SQRT_2,
            Self::Ball { parts: 2, .. } => 2.0,
            Self::Ball { .. } => 2.236_067_977_499_79,
        }
    }
}

/// Physical error source.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Name in the spec.
    pub name: Text,
    /// Repeatable, or a tolerance or random with a distribution.
    pub class: Class,
    /// Degrees of freedom of the standard deviation of a normal error estimated from few
    /// measurements (GUM, G.3). Infinite if the standard deviation is known.
    pub degrees_of_freedom: f64,
    /// Location of the error: `joint q2`, `parameter a2`, `dh of elbow`, `frame elbow`.
    pub at: Text,
    /// Reference for its values, such as a data sheet.
    pub reference: Text,
}

impl Source {
    /// Place of the independent parts of a calibration's uncertainty, which are one error.
    pub const CALIBRATION: &'static str = "calibration";

    /// Returns whether the source is a part of a calibration's uncertainty. Such sources are the
    /// last ones.
    pub fn is_calibration(&self) -> bool {
        &*self.at == Self::CALIBRATION
    }

    /// Creates a source with infinite degrees of freedom.
    pub const fn new(name: &'static str, class: Class, at: &'static str, reference: &'static str) -> Self {
        Self::estimated(name, class, f64::INFINITY, at, reference)
    }

    /// Creates a source from its fields.
    pub const fn estimated(
        name: &'static str,
        class: Class,
        degrees_of_freedom: f64,
        at: &'static str,
        reference: &'static str,
    ) -> Self {
        let (at, reference) = (Text::Constant(at), Text::Constant(reference));
        Self { name: Text::Constant(name), class, degrees_of_freedom, at, reference }
    }
}

/// Returns the index of the source of whose error source k is a part, given the class of each
/// source and whether it belongs to a calibration: the first part of the same ball or disc, or of
/// the calibration; all other sources are whole. Balls have their other parts in the order of the
/// first ones.
pub fn whole(k: usize, class: impl Fn(usize) -> Class, is_calibration: impl Fn(usize) -> bool) -> usize {
    let part = |i: usize| match class(i).distribution() {
        Some(Distribution::Ball { part, parts }) => Some((part, parts)),
        _ => None,
    };
    let first = if is_calibration(k) {
        (0..k).find(|i| is_calibration(*i))
    } else if part(k).is_some_and(|(part, _)| part > 0) {
        let is_last = |i: &usize| part(*i).is_some_and(|(part, parts)| part > 0 && part + 1 == parts);
        let is_first = |i: &usize| part(*i).is_some_and(|(part, _)| part == 0);
        (0..k).filter(is_first).nth((0..k).filter(is_last).count())
    } else {
        None
    };
    first.unwrap_or(k)
}

/// Generalized error that a source causes. The effects of one random source share one magnitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effect {
    /// Index of the source.
    pub source: usize,
    /// Index of the frame, 0 for `F_1`.
    pub frame: usize,
    /// Component among the frame's six errors.
    pub component: Component,
}

impl Effect {
    /// Creates an effect from its fields.
    pub const fn new(source: usize, frame: usize, component: Component) -> Self {
        Self { source, frame, component }
    }
}
