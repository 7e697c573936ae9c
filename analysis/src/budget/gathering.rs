//! What is gathered of one measurand: position, or orientation.

use core::ops::Range;

use super::aligned_sums::AlignedSums;
use super::combined::{self, PartialCombined};
use super::gains::{self, Gains};
use super::least_likely::{self, LeastLikely};
use super::outline::{self, Outline, View};
use super::source_errors::{self, Tally};
use super::sums::Sums;
use super::{Combined, Ellipsoid, SourceErrors, covariance};
use crate::{Measurand, Row};
use abbe_core::lanes::{Lanes, Register};
use abbe_core::{Class, Scalar, Source};

/// What configurations from everywhere say, before all are looked at.
pub(super) struct Scattered {
    measurand: Measurand,
    points: Vec<[f64; 3]>,
    alone: Vec<Vec<[f64; 3]>>,
    ellipsoid: Ellipsoid,
}

impl Scattered {
    pub(super) fn new(measurand: Measurand, sources: &[Source]) -> Self {
        let alone = vec![Vec::new(); sources.len()];
        Self { measurand, points: Vec::new(), alone, ellipsoid: Ellipsoid::default() }
    }

    /// Takes in a configuration.
    pub(super) fn add(&mut self, sources: &[Source], row: &Row) {
        self.points.push(self.measurand.rows(&row.repeatable));
        for (points, error) in self.alone.iter_mut().zip(row.sources) {
            points.push(self.measurand.rows(error));
        }
        let other = Ellipsoid::new(covariance(sources, row.sources, self.measurand), row.index);
        if other.principal.deviations[0] > self.ellipsoid.principal.deviations[0] {
            self.ellipsoid = other;
        }
    }

    /// What every chunk begins with.
    pub(super) fn finish(self, classes: &[Class], home: &[[f64; 6]], tolerance: Option<f64>) -> Beginning {
        let Self { measurand, points, alone, ellipsoid } = self;
        // A little less, for the sweep to find where it is.
        let mut ellipsoid = Ellipsoid { principal: ellipsoid.principal, ..Ellipsoid::default() };
        ellipsoid.principal.deviations = ellipsoid.principal.deviations.map(|axis| axis * (1.0 - 1e-6));
        Beginning {
            measurand,
            tolerance,
            classes: classes.to_vec(),
            home: home.iter().map(|error| measurand.rows(error)).collect(),
            ellipsoid,
            view: View::of(&points),
            views: alone.iter().map(|points| View::of(points)).collect(),
            points,
            alone,
        }
    }
}

/// What every chunk begins with.
pub(super) struct Beginning {
    measurand: Measurand,
    tolerance: Option<f64>,
    classes: Vec<Class>,
    home: Vec<[f64; 3]>,
    ellipsoid: Ellipsoid,
    /// Errors from everywhere, of all sources together and of each alone, and from where their outlines are seen.
    points: Vec<[f64; 3]>,
    alone: Vec<Vec<[f64; 3]>>,
    view: View,
    views: Vec<View>,
}

/// What some configurations came to.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Gathering {
    tallies: Vec<Tally>,
    outlines: Vec<Outline>,
    combined: PartialCombined,
    /// Of the norm of each source, then of the three norms of all together.
    squares: AlignedSums,
    gains: Gains,
    least_likely: LeastLikely,
}

impl Gathering {
    /// Of no configurations.
    pub(super) fn new(sources: usize) -> Self {
        Self {
            tallies: vec![Tally::new(); sources],
            outlines: vec![Outline::default(); sources],
            combined: PartialCombined::new(Ellipsoid::default()),
            squares: AlignedSums::default(),
            gains: Gains::new(sources),
            least_likely: LeastLikely::default(),
        }
    }

    /// Takes in what follows.
    pub(super) fn append(&mut self, other: Self) {
        for (tally, other) in self.tallies.iter_mut().zip(&other.tallies) {
            tally.merge(other);
        }
        for (outline, other) in self.outlines.iter_mut().zip(&other.outlines) {
            outline.merge(other);
        }
        self.combined.merge(&other.combined);
        self.squares.append(other.squares);
        self.gains.merge(&other.gains);
        self.least_likely.merge(&other.least_likely);
    }

    /// The figures of so many configurations: of every source, of all together, the gains, and where a tolerance is least
    /// likely met.
    pub(super) fn finish(
        self,
        beginning: &Beginning,
        count: usize,
    ) -> (Vec<SourceErrors>, Combined, Vec<f64>, Vec<usize>) {
        let mut squares = self.squares.total();
        squares.resize(beginning.classes.len() + 3, 0.0);
        let (alone, together) = squares.split_at(beginning.classes.len());
        let sources = self.tallies.into_iter().zip(self.outlines).enumerate();
        let sources = sources.map(|(i, (tally, outline))| {
            let (class, home) = (beginning.classes[i], beginning.home[i]);
            let sphere = outline.sphere(&beginning.views[i], &beginning.alone[i]);
            tally.finish(i, class, home, sphere, alone[i] / count.max(1) as f64)
        });
        let sources = sources.collect();
        let together = core::array::from_fn(|i| together[i]);
        let combined = self.combined.finish(count, together, &beginning.view, &beginning.points);
        let gains = self.gains.gains(combined.radius.value);
        (sources, combined, gains, self.least_likely.finish())
    }

    /// Whether it, which may come from a file, can be of so many sources over these chunks.
    pub(super) fn is_of(&self, sources: usize, chunks: Range<usize>) -> bool {
        let sound = self.outlines.iter().chain([self.combined.outline()]).all(Outline::is_sound);
        sound
            && self.tallies.len() == sources
            && self.outlines.len() == sources
            && self.gains.len() == sources
            && self.squares.is_of(chunks, sources + 3)
    }

    /// Indices of the configurations that it names.
    pub(super) fn indices(&self) -> impl Iterator<Item = usize> {
        let worst = self.tallies.iter().filter_map(Tally::worst);
        worst.chain(self.combined.indices()).chain(self.least_likely.indices())
    }
}

/// Gathers a [`Gathering`] in lanes.
pub(super) struct Lane<R: Register> {
    measurand: Measurand,
    singles: Vec<source_errors::Lane<R>>,
    outlines: Vec<Option<outline::Lane<R>>>,
    all: combined::Lane<R>,
    shrunk: gains::Lane<R>,
    least_likely: Option<least_likely::Lane>,
    /// The norm of each source in the tile that was added last.
    pub(super) norm_of: Vec<Lanes<R>>,
}

impl<R: Register> Lane<R> {
    pub(super) fn new(beginning: &Beginning) -> Self {
        let Beginning { measurand, tolerance, classes, home, ellipsoid, view, views, .. } = beginning;
        let singles = classes.iter().zip(home).map(|(class, home)| source_errors::Lane::new(*class, *home));
        let repeatable = |class: &Class| *class == Class::Repeatable;
        let outlines = classes.iter().zip(views);
        Self {
            measurand: *measurand,
            singles: singles.collect(),
            outlines: outlines
                .map(|(class, view)| repeatable(class).then(|| outline::Lane::new(*view)))
                .collect(),
            all: combined::Lane::new(*ellipsoid, *view),
            shrunk: gains::Lane::new(classes.len()),
            least_likely: tolerance.map(least_likely::Lane::new),
            norm_of: vec![Lanes::constant(0.0); classes.len()],
        }
    }

    /// Takes in the rows of source k in a tile, with the places and the weights of its configurations.
    #[inline(always)]
    pub(super) fn add_source(&mut self, k: usize, rows: &[Lanes<R>], place: Lanes<R>, weight: Lanes<R>) {
        let first = 6 * k + self.measurand.first();
        let here = [rows[first], rows[first + 1], rows[first + 2]];
        self.singles[k].add(here, place, weight);
        if let Some(outline) = &mut self.outlines[k] {
            outline.add(here, weight);
        }
    }

    /// Takes in what all sources do in a tile. `index` says which configurations those at its places are.
    #[inline(always)]
    pub(super) fn add_sums(
        &mut self,
        classes: &[Class],
        rows: &[Lanes<R>],
        place: Lanes<R>,
        weight: Lanes<R>,
        index: impl Fn(usize) -> usize,
    ) -> Sums<R> {
        // Without sources there are no rows.
        let rows = rows.get(self.measurand.first()..).unwrap_or_default();
        let sums = Sums::new(classes, rows, &mut self.norm_of, place, weight);
        self.all.add(&sums, &index);
        if let Some(least_likely) = &mut self.least_likely {
            least_likely.add(&sums, index);
        }
        self.shrunk.add(classes, rows, &self.norm_of, &sums);
        sums
    }

    /// What was gathered in the chunk of that number.
    pub(super) fn finish(self, chunk: usize, index: impl Fn(usize) -> usize + Copy) -> Gathering {
        let outlines = self.outlines.into_iter();
        let outlines = outlines.map(|outline| outline.map(outline::Lane::finish).unwrap_or_default());
        let singles = self.singles.into_iter().map(|single| single.finish(index));
        let (tallies, mut squares): (Vec<_>, Vec<_>) = singles.unzip();
        let (combined, together) = self.all.finish(index);
        squares.extend(together);
        Gathering {
            tallies,
            outlines: outlines.collect(),
            combined,
            squares: AlignedSums::of(chunk, squares),
            gains: self.shrunk.finish(),
            least_likely: self.least_likely.map(least_likely::Lane::finish).unwrap_or_default(),
        }
    }
}
