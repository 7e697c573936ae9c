//! Accumulation of the figures of one measurand: position, or orientation.

use core::ops::Range;

use super::aligned_sums::AlignedSums;
use super::least_likely::{self, LeastLikely};
use super::source_errors::{self, PartialSourceErrors};
use super::sums::{SourceKinds, Sums};
use super::{Combined, Ellipsoid, SourceErrors, combined, covariance};
use crate::{Measurand, Row};
use abbe_core::lanes::{Lanes, Register, Tiles};
use abbe_core::{Scalar, Source};

/// Figures of a sample of configurations, before the sweep over all of them.
pub(super) struct SampleErrors {
    measurand: Measurand,
    ellipsoid: Ellipsoid,
}

impl SampleErrors {
    pub(super) fn new(measurand: Measurand) -> Self {
        Self { measurand, ellipsoid: Ellipsoid::default() }
    }

    /// Adds a configuration, if its rows of the measurand exist.
    pub(super) fn add(&mut self, sources: &[Source], row: &Row) {
        if self.measurand == Measurand::Orientation && !row.oriented {
            return;
        }
        let other = Ellipsoid::new(covariance(sources, row.sources, self.measurand), row.index);
        self.ellipsoid.add(&other);
    }

    /// Returns the initial values of every chunk of a workspace.
    pub(super) fn finish(
        self,
        kinds: &SourceKinds,
        home: &[[f64; 6]],
        tolerance: Option<f64>,
    ) -> InitialErrors {
        let Self { measurand, ellipsoid } = self;
        // Slightly smaller, so that the sweep finds its configuration.
        let mut ellipsoid = Ellipsoid { principal: ellipsoid.principal, ..Ellipsoid::default() };
        ellipsoid.principal.deviations = ellipsoid.principal.deviations.map(|axis| axis * (1.0 - 1e-6));
        InitialErrors {
            measurand,
            tolerance,
            kinds: kinds.clone(),
            home: home.iter().map(|error| measurand.rows(error)).collect(),
            ellipsoid,
        }
    }
}

/// Initial values of every chunk.
pub(super) struct InitialErrors {
    measurand: Measurand,
    tolerance: Option<f64>,
    kinds: SourceKinds,
    home: Vec<[f64; 3]>,
    ellipsoid: Ellipsoid,
}

/// Partial result over some configurations.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct PartialErrors {
    tallies: Vec<PartialSourceErrors>,
    combined: Combined,
    /// Squares of the norm of each source, followed by those of the three combined norms.
    squares: AlignedSums,
    least_likely: LeastLikely,
}

impl PartialErrors {
    /// Creates the result of no configurations.
    pub(super) fn new(sources: usize) -> Self {
        Self {
            tallies: vec![PartialSourceErrors::new(); sources],
            combined: Combined::default(),
            squares: AlignedSums::default(),
            least_likely: LeastLikely::default(),
        }
    }

    /// Appends the result of the following configurations.
    pub(super) fn append(&mut self, other: Self) {
        for (errors, other) in self.tallies.iter_mut().zip(&other.tallies) {
            errors.merge(other);
        }
        self.combined.merge(&other.combined);
        self.squares.append(other.squares);
        self.least_likely.merge(&other.least_likely);
    }

    /// Returns the figures of `count` configurations: of each source, of all together, and the
    /// configurations least likely to meet a tolerance.
    pub(super) fn finish(
        self,
        initial: &InitialErrors,
        count: usize,
    ) -> (Vec<SourceErrors>, Combined, Vec<usize>) {
        let mut squares = self.squares.total();
        squares.resize(initial.kinds.classes.len() + 3, 0.0);
        let (alone, together) = squares.split_at(initial.kinds.classes.len());
        let sources = self.tallies.into_iter().enumerate().map(|(i, errors)| {
            let (class, home) = (initial.kinds.classes[i], initial.home[i]);
            errors.finish(i, class, home, alone[i] / count.max(1) as f64)
        });
        let rms = |i: usize| (together[i] / count.max(1) as f64).sqrt();
        let combined = Combined { rms: core::array::from_fn(rms), ..self.combined };
        (sources.collect(), combined, self.least_likely.finish())
    }

    /// Returns whether the result is valid for this number of sources and these chunks. It may come
    /// from a file.
    pub(super) fn is_valid_for(&self, sources: usize, chunks: Range<usize>) -> bool {
        self.tallies.len() == sources && self.squares.is_valid_for(chunks, sources + 3)
    }

    /// Returns the indices of the configurations in the result.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        let worst = self.tallies.iter().filter_map(|errors| errors.norm.configuration);
        worst.chain(self.combined.indices()).chain(self.least_likely.indices())
    }
}

/// Accumulates a [`PartialErrors`] in lanes.
pub(super) struct ErrorsAccumulator<R: Register> {
    measurand: Measurand,
    singles: Vec<source_errors::SourceErrorsAccumulator<R>>,
    all: combined::CombinedAccumulator<R>,
    least_likely: Option<least_likely::LeastLikelyAccumulator<R>>,
}

impl<R: Register> ErrorsAccumulator<R> {
    pub(super) fn new(initial: &InitialErrors) -> Self {
        let InitialErrors { measurand, tolerance, kinds, home, ellipsoid } = initial;
        let singles = kinds
            .classes
            .iter()
            .zip(home)
            .map(|(class, home)| source_errors::SourceErrorsAccumulator::new(*class, *home));
        Self {
            measurand: *measurand,
            singles: singles.collect(),
            all: combined::CombinedAccumulator::new(*ellipsoid, kinds),
            least_likely: tolerance.map(least_likely::LeastLikelyAccumulator::new),
        }
    }

    /// Adds a block, whose first configuration has the place `before` in its chunk. `index` maps
    /// places to indices of configurations.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        initial: &InitialErrors,
        displacements: &Tiles,
        before: usize,
        index: impl Fn(usize) -> usize,
    ) {
        for k in 0..self.singles.len() {
            let first = 6 * k + self.measurand.first();
            for tile in 0..displacements.tiles() {
                let (place, weight) = (place(before, tile), weight(displacements.count(), tile));
                let rows = displacements.tile::<R>(tile);
                let here = [rows[first], rows[first + 1], rows[first + 2]];
                self.singles[k].add(here, place, weight);
            }
        }
        for tile in 0..displacements.tiles() {
            let (place, weight) = (place(before, tile), weight(displacements.count(), tile));
            let rows = displacements.tile::<R>(tile);
            // Without sources there are no rows.
            let rows = rows.get(self.measurand.first()..).unwrap_or_default();
            let sums = Sums::new(&initial.kinds, rows, place, weight);
            self.all.add(&sums, rows, &index);
            if let Some(least_likely) = &mut self.least_likely {
                least_likely.add(&sums, &index);
            }
        }
    }

    /// Returns the partial result of chunk number `chunk`.
    pub(super) fn finish(self, chunk: usize, index: impl Fn(usize) -> usize + Copy) -> PartialErrors {
        let singles = self.singles.into_iter().map(|single| single.finish(index));
        let (tallies, mut squares): (Vec<_>, Vec<_>) = singles.unzip();
        let (combined, together) = self.all.finish(index);
        squares.extend(together);
        PartialErrors {
            tallies,
            combined,
            squares: AlignedSums::from_chunk(chunk, squares),
            least_likely: self
                .least_likely
                .map(|least_likely| least_likely.finish(index))
                .unwrap_or_default(),
        }
    }
}

/// Returns the places in their chunk of the configurations of a tile.
#[inline(always)]
fn place<R: Register>(before: usize, tile: usize) -> Lanes<R> {
    let lane = Lanes::<R>::from_fn(|lane| lane as f64);
    lane + Lanes::constant((before + tile * R::WIDTH) as f64)
}

/// Returns the weights of the configurations of a tile: 1, or 0 in lanes that repeat the last one.
#[inline(always)]
fn weight<R: Register>(count: usize, tile: usize) -> Lanes<R> {
    match count - tile * R::WIDTH {
        left if left < R::WIDTH => Lanes::from_fn(|lane| f64::from(u8::from(lane < left))),
        _ => Lanes::constant(1.0),
    }
}
