//! What one source does alone over the workspace, in three metrics.

use super::enclosing_sphere::Sphere;
use super::peak::{self, Peak};
use abbe_core::lanes::{Lanes, Register};
use abbe_core::{Class, Scalar};

/// A figure per axis, and of the norm. Of positions along the axes of `F_0` in the length unit, of orientations rows 4–6 in
/// rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Figures {
    /// Along x.
    pub x: f64,
    /// Along y.
    pub y: f64,
    /// Along z.
    pub z: f64,
    /// Of the norm.
    pub norm: f64,
}

impl From<[f64; 4]> for Figures {
    fn from([x, y, z, norm]: [f64; 4]) -> Self {
        Self { x, y, z, norm }
    }
}

/// What one source does alone over the workspace.
///
/// ΔX(q) is the position error (or rows 4–6) of a repeatable source. Of a random one b(q) is the bound: what is drawn lies
/// anywhere between −b(q) and +b(q), all effects of the source together.
///
/// | metric | repeatable | random |
/// |---|---|---|
/// | plain maximum | max \|ΔX\|; max ‖ΔX‖ | max \|b\|; max ‖b‖ |
/// | half peak-to-peak | (max ΔX − min ΔX) / 2; radius of the smallest sphere around all ΔX | as plain: the interval is symmetric |
/// | relative to home | max \|ΔX(q) − ΔX(home)\|; max ‖ΔX(q) − ΔX(home)‖ | worst difference of two draws: max \|b(q)\| + \|b(home)\|; max ‖b(q) ± b(home)‖ |
///
/// All are zero for an empty workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourceErrors {
    /// Index of the source.
    pub source: usize,
    /// Repeatable or random.
    pub class: Class,
    /// The largest error.
    pub plain_max: Figures,
    /// Half of what the error varies by.
    pub half_peak_to_peak: Figures,
    /// The largest difference from the error at home.
    pub relative_to_home: Figures,
    /// The root mean square of the norm of the error over the configurations.
    pub rms: f64,
    /// Index of the configuration with the largest norm; none for an empty workspace.
    pub worst: Option<usize>,
}

/// What one source does over some configurations: [`SourceErrors`] without the last steps.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Tally {
    least: [f64; 3],
    largest: [f64; 4],
    worst: Option<usize>,
    relative: f64,
}

impl Tally {
    /// Of no configurations.
    pub(super) fn new() -> Self {
        // Finite, so that JSON can hold them.
        Self { least: [f64::MAX; 3], largest: [f64::MIN; 4], worst: None, relative: 0.0 }
    }

    /// Index of the configuration where the norm is largest.
    pub(super) fn worst(&self) -> Option<usize> {
        self.worst
    }

    /// Takes in what follows.
    pub(super) fn merge(&mut self, other: &Self) {
        if other.largest[3] > self.largest[3] {
            self.worst = other.worst;
        }
        for (least, other) in self.least.iter_mut().zip(other.least) {
            *least = least.min(other);
        }
        for (largest, other) in self.largest.iter_mut().zip(other.largest) {
            *largest = largest.max(other);
        }
        self.relative = self.relative.max(other.relative);
    }

    /// The errors of a source with this error (bound, if random) at home, this sphere around all and this mean square.
    pub(super) fn finish(
        self,
        source: usize,
        class: Class,
        home: [f64; 3],
        sphere: Sphere,
        mean_square: f64,
    ) -> SourceErrors {
        let Self { least, largest, worst, relative } = self;
        let none = Figures::default();
        let (plain_max, half_peak_to_peak, relative_to_home) = if worst.is_none() {
            (none, none, none)
        } else {
            // Never −0.
            let plain = |i: usize| largest[i].max(-least[i]).abs();
            let plain_max = Figures::from([plain(0), plain(1), plain(2), largest[3]]);
            let half = |i: usize| (largest[i] - least[i]) / 2.0;
            // The difference of two draws `t b(q) − t' b(home)` is worst where t and t' are ±1.
            let [x, y, z] = core::array::from_fn(|i| match class {
                Class::Repeatable => (largest[i] - home[i]).max(home[i] - least[i]).abs(),
                Class::Random(_) => plain(i) + home[i].abs(),
            });
            let half = match class {
                Class::Repeatable => [half(0), half(1), half(2), sphere.radius].into(),
                Class::Random(_) => plain_max,
            };
            (plain_max, half, [x, y, z, relative].into())
        };
        let rms = mean_square.sqrt();
        SourceErrors { source, class, plain_max, half_peak_to_peak, relative_to_home, rms, worst }
    }
}

/// Gathers a [`Tally`] in lanes.
pub(super) struct Lane<R: Register> {
    random: bool,
    home: [Lanes<R>; 3],
    least: [Lanes<R>; 3],
    largest: [Lanes<R>; 3],
    square: Peak<R>,
    squares: Lanes<R>,
    relative: Lanes<R>,
}

impl<R: Register> Lane<R> {
    /// Of a source with this error (bound, if random) at home.
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

    /// Takes in the rows of some tiles, with the places and the weights of their configurations.
    #[inline(always)]
    pub(super) fn add(&mut self, here: [Lanes<R>; 3], place: Lanes<R>, weight: Lanes<R>) {
        for (row, (least, largest)) in here.iter().zip(self.least.iter_mut().zip(&mut self.largest)) {
            *least = row.min(*least);
            *largest = row.max(*largest);
        }
        let square = peak::square(here);
        self.square.add(square, place);
        self.squares = square.mul_add(weight, self.squares);
        let differences = core::array::from_fn(|i| here[i] - self.home[i]);
        self.relative = peak::square(differences).max(self.relative);
        if self.random {
            let sums = core::array::from_fn(|i| here[i] + self.home[i]);
            self.relative = peak::square(sums).max(self.relative);
        }
    }

    /// What was gathered, with the index of the place that is worst; and the sum of the squares of the norm.
    pub(super) fn finish(self, index: impl Fn(usize) -> usize) -> (Tally, f64) {
        let Some((square, place)) = self.square.finish() else { return (Tally::new(), 0.0) };
        let [a, b, c] = self.largest.map(peak::largest);
        let root = |square: f64| square.max(0.0).sqrt();
        let tally = Tally {
            least: self.least.map(peak::least),
            largest: [a, b, c, root(square)],
            worst: Some(index(place)),
            relative: root(peak::largest(self.relative)),
        };
        (tally, peak::sum(self.squares))
    }
}
