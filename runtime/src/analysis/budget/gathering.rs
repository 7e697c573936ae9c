//! What is gathered of one measurand: position, or orientation.

use super::cloud::{self, Cloud};
use super::combined::{self, Gathered};
use super::enclosing_sphere::{Enclosing, Shell};
use super::gains::{self, Gains};
use super::least_likely::{self, LeastLikely};
use super::source_errors::{self, Tally};
use super::sums::Sums;
use super::{Combined, Ellipsoid, SourceErrors, covariance};
use crate::analysis::{Measurand, Row};
use crate::lanes::{Lanes, Register};
use crate::{Class, Scalar, Source};

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

    /// What every chunk begins with, and the spheres that grow.
    pub(super) fn finish(
        self,
        classes: &[Class],
        home: &[[f64; 6]],
        tolerance: Option<f64>,
    ) -> (Beginning, Spheres) {
        let Self { measurand, points, alone, ellipsoid } = self;
        // A little less, for the sweep to find where it is.
        let mut ellipsoid = Ellipsoid { principal: ellipsoid.principal, ..Ellipsoid::default() };
        ellipsoid.principal.deviations = ellipsoid.principal.deviations.map(|axis| axis * (1.0 - 1e-6));
        let enclosing = |points: Vec<[f64; 3]>| Enclosing::new(points.into_iter());
        let spheres = Spheres { all: enclosing(points), alone: alone.into_iter().map(enclosing).collect() };
        let beginning = Beginning {
            measurand,
            tolerance,
            classes: classes.to_vec(),
            home: home.iter().map(|error| measurand.rows(error)).collect(),
            ellipsoid,
            shell: spheres.all.shell(),
            shells: spheres.alone.iter().map(Enclosing::shell).collect(),
        };
        (beginning, spheres)
    }
}

/// The smallest spheres around all errors, and around those of each source.
pub(super) struct Spheres {
    all: Enclosing,
    alone: Vec<Enclosing>,
}

/// What every chunk begins with.
pub(super) struct Beginning {
    measurand: Measurand,
    tolerance: Option<f64>,
    classes: Vec<Class>,
    home: Vec<[f64; 3]>,
    ellipsoid: Ellipsoid,
    shell: Shell,
    shells: Vec<Shell>,
}

/// What some configurations came to.
pub(super) struct Gathering {
    tallies: Vec<Tally>,
    clouds: Vec<Cloud>,
    gathered: Gathered,
    gains: Gains,
    least_likely: LeastLikely,
}

impl Gathering {
    /// Of no configurations.
    pub(super) fn new(sources: usize) -> Self {
        Self {
            tallies: vec![Tally::new(); sources],
            clouds: Vec::new(),
            gathered: Gathered::new(Ellipsoid::default()),
            gains: Gains::new(sources),
            least_likely: LeastLikely::default(),
        }
    }

    /// Takes in what follows. The spheres are grown as it comes.
    pub(super) fn merge(&mut self, other: &Self, spheres: &mut Spheres) {
        for (tally, other) in self.tallies.iter_mut().zip(&other.tallies) {
            tally.merge(other);
        }
        for (cloud, sphere) in other.clouds.iter().zip(&mut spheres.alone) {
            cloud.enclose(sphere);
        }
        self.gathered.merge(&other.gathered, &mut spheres.all);
        self.gains.merge(&other.gains);
        self.least_likely.merge(&other.least_likely);
    }

    /// The figures of so many configurations: of every source, of all together, the gains, and where a tolerance is least
    /// likely met.
    pub(super) fn finish(
        self,
        beginning: &Beginning,
        spheres: Spheres,
        count: usize,
    ) -> (Vec<SourceErrors>, Combined, Vec<f64>, Vec<usize>) {
        let sources = self.tallies.into_iter().zip(spheres.alone).enumerate();
        let sources = sources.map(|(i, (tally, sphere))| {
            let (class, home) = (beginning.classes[i], beginning.home[i]);
            tally.finish(i, class, home, sphere, count)
        });
        let sources = sources.collect();
        let combined = self.gathered.finish(count, spheres.all);
        let gains = self.gains.gains(combined.radius.value);
        (sources, combined, gains, self.least_likely.finish())
    }
}

/// Gathers a [`Gathering`] in lanes.
pub(super) struct Lane<R: Register> {
    measurand: Measurand,
    singles: Vec<source_errors::Lane<R>>,
    clouds: Vec<Option<cloud::Lane<R>>>,
    all: combined::Lane<R>,
    shrunk: gains::Lane<R>,
    least_likely: Option<least_likely::Lane>,
    /// The norm of each source in the tile that was added last.
    pub(super) norm_of: Vec<Lanes<R>>,
}

impl<R: Register> Lane<R> {
    pub(super) fn new(beginning: &Beginning) -> Self {
        let Beginning { measurand, tolerance, classes, home, ellipsoid, shell, shells } = beginning;
        let singles = classes.iter().zip(home).map(|(class, home)| source_errors::Lane::new(*class, *home));
        let repeatable = |class: &Class| *class == Class::Repeatable;
        let clouds = classes.iter().zip(shells);
        Self {
            measurand: *measurand,
            singles: singles.collect(),
            clouds: clouds
                .map(|(class, shell)| repeatable(class).then(|| cloud::Lane::new(*shell)))
                .collect(),
            all: combined::Lane::new(*ellipsoid, *shell),
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
        if let Some(cloud) = &mut self.clouds[k] {
            cloud.add(here, weight);
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

    pub(super) fn finish(self, index: impl Fn(usize) -> usize + Copy) -> Gathering {
        let clouds = self.clouds.into_iter().map(|cloud| cloud.map(cloud::Lane::finish).unwrap_or_default());
        Gathering {
            tallies: self.singles.into_iter().map(|single| single.finish(index)).collect(),
            clouds: clouds.collect(),
            gathered: self.all.finish(index),
            gains: self.shrunk.finish(),
            least_likely: self.least_likely.map(least_likely::Lane::finish).unwrap_or_default(),
        }
    }
}
