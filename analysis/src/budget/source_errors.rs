//! Errors of a single source over the workspace, in three metrics.

use super::extreme::Extreme;
use super::peak::{self, Peak};
use abbe_core::lanes::{Lanes, Register};
use abbe_core::{Class, Scalar};
use abbe_kinematics::sampling::norm;

/// Figure per axis, and of the norm: positions along the axes of `F_0` in the length unit, or
/// orientations (rows 4–6) in rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Figures {
    /// Figure along x.
    pub x: f64,
    /// Figure along y.
    pub y: f64,
    /// Figure along z.
    pub z: f64,
    /// Norm.
    pub norm: f64,
}

impl From<[f64; 4]> for Figures {
    fn from([x, y, z, norm]: [f64; 4]) -> Self {
        Self { x, y, z, norm }
    }
}

/// Errors of a single source over the workspace.
///
/// ΔX(q) is the position error (or rows 4–6) of a repeatable source. For a random source b(q) is
/// the bound: its error lies between −b(q) and +b(q), with all effects of the source fully
/// correlated.
///
/// | metric | repeatable | random |
/// |---|---|---|
/// | plain maximum | max \|ΔX\|; max ‖ΔX‖ | max \|b\|; max ‖b‖ |
/// | half peak-to-peak | (max ΔX − min ΔX) / 2; norm of these halves | equal to the plain maximum: the interval is symmetric |
/// | relative to home | max \|ΔX(q) − ΔX(home)\|; max ‖ΔX(q) − ΔX(home)‖ | worst difference of two draws: max \|b(q)\| + \|b(home)\|; max ‖b(q) ± b(home)‖ |
///
/// All figures are zero for an empty workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourceErrors {
    /// Index of the source.
    pub source: usize,
    /// Repeatable, a tolerance, or random.
    pub class: Class,
    /// Largest error.
    pub plain_max: Figures,
    /// Half the range of the error.
    pub half_peak_to_peak: Figures,
    /// Largest difference from the error at home.
    pub relative_to_home: Figures,
    /// Root mean square of the norm of the error over the configurations.
    pub rms: f64,
    /// Index of the configuration with the largest norm. `None` for an empty workspace.
    pub worst: Option<usize>,
}

/// Partial result over some configurations: [`SourceErrors`] before the final steps.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct PartialSourceErrors {
    least: [f64; 3],
    largest: [f64; 3],
    pub(super) norm: Extreme,
    relative: f64,
}

impl PartialSourceErrors {
    /// Creates the result of no configurations.
    pub(super) fn new() -> Self {
        // Finite, so that JSON can represent them.
        Self { least: [f64::MAX; 3], largest: [f64::MIN; 3], norm: Extreme::default(), relative: 0.0 }
    }

    /// Merges the result of the following configurations.
    pub(super) fn merge(&mut self, other: &Self) {
        self.norm.merge(&other.norm);
        for (least, other) in self.least.iter_mut().zip(other.least) {
            *least = least.min(other);
        }
        for (largest, other) in self.largest.iter_mut().zip(other.largest) {
            *largest = largest.max(other);
        }
        self.relative = self.relative.max(other.relative);
    }

    /// Completes the figures of a source, given its error (or bound) at home and their mean
    /// square.
    pub(super) fn finish(self, source: usize, class: Class, home: [f64; 3], square: f64) -> SourceErrors {
        let Self { least, largest, norm: Extreme { value, configuration: worst }, relative } = self;
        let none = Figures::default();
        let (plain_max, half_peak_to_peak, relative_to_home) = if worst.is_none() {
            (none, none, none)
        } else {
            // The absolute value avoids −0.
            let plain = |i: usize| largest[i].max(-least[i]).abs();
            let plain_max = Figures::from([plain(0), plain(1), plain(2), value]);
            let half = |i: usize| (largest[i] - least[i]) / 2.0;
            // The difference of two draws `t b(q) − t' b(home)` is largest for t and t' = ±1.
            let [x, y, z] = core::array::from_fn(|i| match class {
                Class::Repeatable => (largest[i] - home[i]).max(home[i] - least[i]).abs(),
                _ => plain(i) + home[i].abs(),
            });
            let half = match class {
                Class::Repeatable => {
                    let [x, y, z] = [half(0), half(1), half(2)];
                    [x, y, z, norm([x, y, z])].into()
                }
                _ => plain_max,
            };
            (plain_max, half, [x, y, z, relative].into())
        };
        let rms = square.sqrt();
        SourceErrors { source, class, plain_max, half_peak_to_peak, relative_to_home, rms, worst }
    }
}

/// Accumulates a [`PartialSourceErrors`] in lanes.
pub(super) struct SourceErrorsAccumulator<R: Register> {
    random: bool,
    home: [Lanes<R>; 3],
    least: [Lanes<R>; 3],
    largest: [Lanes<R>; 3],
    square: Peak<R>,
    squares: Lanes<R>,
    relative: Lanes<R>,
}

impl<R: Register> SourceErrorsAccumulator<R> {
    /// Initializes the accumulation for a source with this error (or bound) at home.
    pub(super) fn new(class: Class, home: [f64; 3]) -> Self {
        let (zero, infinite) = (Lanes::constant(0.0), Lanes::constant(f64::INFINITY));
        Self {
            random: class != Class::Repeatable,
            home: home.map(Lanes::constant),
            least: [infinite; 3],
            largest: [-infinite; 3],
            square: Peak::none(),
            squares: zero,
            relative: zero,
        }
    }

    /// Adds the rows of a tile, with the places and the weights of their configurations.
    #[inline(always)]
    pub(super) fn add(&mut self, here: [Lanes<R>; 3], place: Lanes<R>, weight: Lanes<R>) {
        for (row, (least, largest)) in here.iter().zip(self.least.iter_mut().zip(&mut self.largest)) {
            *least = row.min(*least);
            *largest = row.max(*largest);
        }
        let square = peak::square(here);
        self.square.add(square, square, place);
        self.squares = square.mul_add(weight, self.squares);
        let differences = core::array::from_fn(|i| here[i] - self.home[i]);
        self.relative = peak::square(differences).max(self.relative);
        if self.random {
            let sums = core::array::from_fn(|i| here[i] + self.home[i]);
            self.relative = peak::square(sums).max(self.relative);
        }
    }

    /// Returns the partial result, with the index of the worst configuration, and the sum of the
    /// squared norms.
    pub(super) fn finish(self, index: impl Fn(usize) -> usize) -> (PartialSourceErrors, f64) {
        let norm = self.square.finish(index).root();
        if norm.configuration.is_none() {
            return (PartialSourceErrors::new(), 0.0);
        }
        let tally = PartialSourceErrors {
            least: self.least.map(peak::least),
            largest: self.largest.map(peak::largest),
            norm,
            relative: peak::largest(self.relative).sqrt(),
        };
        (tally, peak::sum(self.squares))
    }
}
