//! Characteristics of ISO 230-2 from the deviations of one axis.
//!
//! With the deviations `x_ij` of n approaches of the target position `P_i` in a direction ↑ or ↓:
//!
//! ```text
//! x̄_i↑ = Σ_j x_ij↑ / n            s_i↑ = √(Σ_j (x_ij↑ − x̄_i↑)² / (n − 1))
//! x̄_i  = (x̄_i↑ + x̄_i↓) / 2        B_i  = x̄_i↑ − x̄_i↓
//! R_i↑ = 4 s_i↑                   R_i  = max(2 s_i↑ + 2 s_i↓ + |B_i|, R_i↑, R_i↓)
//! B    = max |B_i|                B̄    = Σ_i B_i / m
//! R↑   = max R_i↑                 R    = max R_i
//! E↑   = max x̄_i↑ − min x̄_i↑      E    = max(x̄_i↑, x̄_i↓) − min(x̄_i↑, x̄_i↓)
//! M    = max x̄_i − min x̄_i
//! A↑   = max(x̄_i↑ + 2 s_i↑) − min(x̄_i↑ − 2 s_i↑)
//! A    = max(x̄_i↑ + 2 s_i↑, x̄_i↓ + 2 s_i↓) − min(x̄_i↑ − 2 s_i↑, x̄_i↓ − 2 s_i↓)
//! ```
//!
//! Every characteristic is a sum of means and standard deviations, with the places of its extremes.
//! Its uncertainty follows to first order from that of a reading, which is independent from reading
//! to reading, and from that of the scale of the instrument, which is common to all.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::data::TargetRuns;

/// Standard uncertainties of the instrument.
#[derive(Clone, Copy, Debug, Default)]
pub struct InstrumentUncertainty {
    /// Uncertainty of one reading, in the unit of the deviations.
    pub reading: f64,
    /// Uncertainty of the scale: unit of the deviations by unit of the positions.
    pub scale: f64,
}

/// Approaches of one target position in one direction. Values are in `unit`.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ApproachResult {
    /// Number of approaches.
    pub count: usize,
    /// Mean deviation `x̄_i↑` or `x̄_i↓`.
    pub mean: f64,
    /// Standard deviation `s_i↑` or `s_i↓`; none for a single approach.
    pub standard_deviation: Option<f64>,
    /// Repeatability `R_i↑` or `R_i↓`.
    pub repeatability: Option<f64>,
}

/// Results at one target position. Deviations are in `unit`.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct PositionResult {
    /// Target position `P_i`, in the `position_unit`.
    pub position: f64,
    /// Approaches from below, ↑; none if there are none.
    pub forward: Option<ApproachResult>,
    /// Approaches from above, ↓.
    pub reverse: Option<ApproachResult>,
    /// Mean bidirectional deviation `x̄_i`; none unless there are both directions.
    pub mean: Option<f64>,
    /// Reversal error `B_i`.
    pub reversal: Option<f64>,
    /// Bidirectional repeatability `R_i`.
    pub repeatability: Option<f64>,
}

/// Value of a characteristic, in `unit`.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Characteristic {
    /// Value.
    pub value: f64,
    /// Expanded uncertainty, k = 2, from that of the instrument; none if that is not stated.
    pub uncertainty: Option<f64>,
}

/// Characteristics of one direction.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Unidirectional {
    /// Accuracy `A↑` or `A↓`; none if a position has a single approach.
    pub accuracy: Option<Characteristic>,
    /// Systematic positioning error `E↑` or `E↓`.
    pub systematic: Characteristic,
    /// Repeatability `R↑` or `R↓`; none if a position has a single approach.
    pub repeatability: Option<Characteristic>,
}

/// Characteristics of both directions.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Bidirectional {
    /// Accuracy `A`; none if a position has a single approach.
    pub accuracy: Option<Characteristic>,
    /// Systematic positioning error `E`.
    pub systematic: Characteristic,
    /// Mean positioning error `M`.
    pub mean: Characteristic,
    /// Repeatability `R`; none if a position has a single approach.
    pub repeatability: Option<Characteristic>,
    /// Reversal error `B`.
    pub reversal: Characteristic,
    /// Mean reversal error `B̄`.
    pub mean_reversal: Characteristic,
}

/// Results of one axis or diagonal.
#[derive(Clone, Debug, Serialize)]
pub struct Evaluation {
    /// Results by position, ascending.
    pub positions: Vec<PositionResult>,
    /// Characteristics of the approaches from below; none unless every position has them.
    pub forward: Option<Unidirectional>,
    /// Characteristics of the approaches from above.
    pub reverse: Option<Unidirectional>,
    /// Characteristics of both directions.
    pub bidirectional: Option<Bidirectional>,
}

/// Sum of means and standard deviations: weight, index of the position, direction.
#[derive(Clone, Debug, Default)]
pub(super) struct Sum {
    pub(super) means: Vec<(f64, usize, usize)>,
    pub(super) deviations: Vec<(f64, usize, usize)>,
}

impl Sum {
    /// Returns `weight · x̄`.
    pub(super) fn mean(weight: f64, position: usize, direction: usize) -> Self {
        Self { means: vec![(weight, position, direction)], deviations: Vec::new() }
    }

    /// Returns `weight · s`.
    fn deviation(weight: f64, position: usize, direction: usize) -> Self {
        Self { means: Vec::new(), deviations: vec![(weight, position, direction)] }
    }

    pub(super) fn plus(mut self, other: Self) -> Self {
        self.means.extend(other.means);
        self.deviations.extend(other.deviations);
        self
    }

    pub(super) fn times(mut self, factor: f64) -> Self {
        self.means.iter_mut().chain(&mut self.deviations).for_each(|(weight, ..)| *weight *= factor);
        self
    }
}

/// Table of means and standard deviations.
pub(super) struct Statistics<'a> {
    pub(super) positions: &'a [PositionResult],
    pub(super) uncertainty: Option<InstrumentUncertainty>,
}

impl Statistics<'_> {
    pub(super) fn approach(&self, position: usize, direction: usize) -> Option<ApproachResult> {
        let position = &self.positions[position];
        if direction == 0 { position.forward } else { position.reverse }
    }

    /// Returns the value of a sum; `None` if a part of it is not known.
    pub(super) fn value(&self, sum: &Sum) -> Option<f64> {
        let means = sum.means.iter().map(|(weight, i, d)| Some(weight * self.approach(*i, *d)?.mean));
        let deviations = sum
            .deviations
            .iter()
            .map(|(weight, i, d)| Some(weight * self.approach(*i, *d)?.standard_deviation?));
        means.chain(deviations).sum()
    }

    /// Returns a characteristic with its uncertainty.
    ///
    /// A mean of n readings of uncertainty u has `u² / n`, their standard deviation `u² / (n − 1)`;
    /// the two are not correlated. The scale moves each mean in proportion to its position.
    pub(super) fn characteristic(&self, sum: &Sum) -> Option<Characteristic> {
        let value = self.value(sum)?;
        let uncertainty = self.uncertainty.map(|InstrumentUncertainty { reading, scale }| {
            let mut totals: BTreeMap<(usize, usize), [f64; 2]> = BTreeMap::new();
            for (part, list) in [&sum.means, &sum.deviations].into_iter().enumerate() {
                list.iter().for_each(|(weight, i, d)| totals.entry((*i, *d)).or_default()[part] += weight);
            }
            let mut variance = 0.0;
            for ((i, d), [mean, deviation]) in totals {
                let Some(ApproachResult { count, .. }) = self.approach(i, d) else { continue };
                let n = count as f64;
                variance += (mean * reading).powi(2) / n;
                variance += (deviation * reading).powi(2) / (n - 1.0).max(1.0);
            }
            let lever: f64 =
                sum.means.iter().map(|(weight, i, _)| weight * self.positions[*i].position).sum();
            2.0 * (variance + (scale * lever).powi(2)).sqrt()
        });
        Some(Characteristic { value: value + 0.0, uncertainty })
    }

    /// Returns the sum with the largest value; `None` if one of them is not known.
    pub(super) fn largest(&self, sums: impl IntoIterator<Item = Sum>) -> Option<Sum> {
        let mut found: Option<(f64, Sum)> = None;
        for sum in sums {
            let value = self.value(&sum)?;
            if found.as_ref().is_none_or(|(most, _)| value > *most) {
                found = Some((value, sum));
            }
        }
        found.map(|(_, sum)| sum)
    }

    /// Returns the characteristic of the largest minus the smallest of sums.
    fn span(&self, upper: Vec<Sum>, lower: Vec<Sum>) -> Option<Characteristic> {
        let most = self.largest(upper)?;
        let least = self.largest(lower.into_iter().map(|sum| sum.times(-1.0)))?;
        self.characteristic(&most.plus(least))
    }

    /// Returns the means, with `factor` standard deviations added, in some directions.
    fn means(&self, directions: &[usize], factor: f64) -> Vec<Sum> {
        let places = directions.iter().flat_map(|d| (0..self.positions.len()).map(move |i| (i, *d)));
        let one = |(i, d): (usize, usize)| match factor {
            0.0 => Sum::mean(1.0, i, d),
            factor => Sum::mean(1.0, i, d).plus(Sum::deviation(factor, i, d)),
        };
        places.map(one).collect()
    }

    fn unidirectional(&self, direction: usize) -> Option<Unidirectional> {
        let means = |factor: f64| self.means(&[direction], factor);
        let repeatability = (0..self.positions.len()).map(|i| Sum::deviation(4.0, i, direction));
        Some(Unidirectional {
            accuracy: self.span(means(2.0), means(-2.0)),
            systematic: self.span(means(0.0), means(0.0))?,
            repeatability: self.largest(repeatability).and_then(|sum| self.characteristic(&sum)),
        })
    }

    /// Returns `x̄_i↑ − x̄_i↓`, times `sign`.
    fn difference(i: usize, sign: f64) -> Sum {
        Sum::mean(sign, i, 0).plus(Sum::mean(-sign, i, 1))
    }

    /// Returns the reversal error: the largest difference of the means of the directions.
    pub(super) fn reversal(&self) -> Option<Characteristic> {
        let places = 0..self.positions.len();
        let both = places.flat_map(|i| [Self::difference(i, 1.0), Self::difference(i, -1.0)]);
        self.largest(both).and_then(|sum| self.characteristic(&sum))
    }

    fn bidirectional(&self) -> Option<Bidirectional> {
        let places = 0..self.positions.len();
        let both = |factor: f64| self.means(&[0, 1], factor);
        let middle = || -> Vec<Sum> {
            places.clone().map(|i| Sum::mean(0.5, i, 0).plus(Sum::mean(0.5, i, 1))).collect()
        };
        let spread = |i: usize, sign: f64| {
            Sum::deviation(2.0, i, 0).plus(Sum::deviation(2.0, i, 1)).plus(Self::difference(i, sign))
        };
        let repeatability = places.clone().flat_map(|i| {
            [spread(i, 1.0), spread(i, -1.0), Sum::deviation(4.0, i, 0), Sum::deviation(4.0, i, 1)]
        });
        let share = 1.0 / self.positions.len() as f64;
        let mean_reversal =
            places.clone().fold(Sum::default(), |sum, i| sum.plus(Self::difference(i, share)));
        Some(Bidirectional {
            accuracy: self.span(both(2.0), both(-2.0)),
            systematic: self.span(both(0.0), both(0.0))?,
            mean: self.span(middle(), middle())?,
            repeatability: self.largest(repeatability).and_then(|sum| self.characteristic(&sum)),
            reversal: self.reversal()?,
            mean_reversal: self.characteristic(&mean_reversal)?,
        })
    }
}

impl Evaluation {
    /// Evaluates the deviations at target positions, ascending.
    pub fn new(targets: &[TargetRuns], uncertainty: Option<InstrumentUncertainty>) -> Self {
        let Self { positions, .. } = Self::of_positions(targets);
        let statistics = Statistics { positions: &positions, uncertainty };
        let forward = statistics.unidirectional(0);
        let reverse = statistics.unidirectional(1);
        Self { forward, reverse, bidirectional: statistics.bidirectional(), positions }
    }

    /// Evaluates each position by itself.
    pub(super) fn of_positions(targets: &[TargetRuns]) -> Self {
        let positions = targets.iter().map(PositionResult::new).collect();
        Self { positions, forward: None, reverse: None, bidirectional: None }
    }
}

impl PositionResult {
    fn new(target: &TargetRuns) -> Self {
        let [forward, reverse] =
            [&target.deviations[0], &target.deviations[1]].map(|own| ApproachResult::new(own));
        let both = forward.zip(reverse);
        let reversal = both.map(|(up, down)| up.mean - down.mean + 0.0);
        let repeatability = both.and_then(|(up, down)| {
            let spread = 2.0 * up.standard_deviation? + 2.0 * down.standard_deviation?;
            Some((spread + reversal?.abs()).max(up.repeatability?).max(down.repeatability?))
        });
        let mean = both.map(|(up, down)| (up.mean + down.mean) / 2.0 + 0.0);
        Self { position: target.position, forward, reverse, mean, reversal, repeatability }
    }
}

impl ApproachResult {
    fn new(deviations: &[f64]) -> Option<Self> {
        let count = deviations.len();
        let mean = deviations.iter().sum::<f64>() / (count > 0).then_some(count as f64)? + 0.0;
        let squares = deviations.iter().map(|deviation| (deviation - mean).powi(2)).sum::<f64>();
        let standard_deviation = (count > 1).then(|| (squares / (count as f64 - 1.0)).sqrt());
        let repeatability = standard_deviation.map(|s| 4.0 * s);
        Some(Self { count, mean, standard_deviation, repeatability })
    }
}

#[cfg(test)]
mod tests;
