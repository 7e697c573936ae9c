//! Gathers what one figure shows.

use abbe::analysis::{Configuration, Row};
use abbe::{Class, Description, Source};

use super::bins::{Bins, Merge};
use super::extremes::{Envelope, Grid, Mesh};
use super::points::Points;
use abbe_study::study_file::{Content, Figure, Over};

/// The error of the tool point: the repeatable part, and the bound of the random one, plus or minus.
#[derive(Clone, Copy, Debug)]
pub(in crate::report) struct Errors {
    pub(in crate::report) repeatable: [f64; 3],
    pub(in crate::report) random: [f64; 3],
}

impl Errors {
    /// Both norms, added: as the radius of all sources together.
    pub(in crate::report) fn norm(&self) -> f64 {
        norm(self.repeatable) + norm(self.random)
    }
}

pub(in crate::report) fn norm(vector: [f64; 3]) -> f64 {
    vector.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// How often errors are in a bin: along x, y, z, and of the norm.
#[derive(Clone, Debug)]
pub(in crate::report) struct Histogram(pub(in crate::report) [Bins<Count>; 4]);

/// How often.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::report) struct Count(pub(in crate::report) usize);

impl Merge for Count {
    fn merge(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl Default for Histogram {
    fn default() -> Self {
        // Finer than any error that matters, in m or mm.
        Self(std::array::from_fn(|_| Bins::new(-50, 1024)))
    }
}

/// What a figure shows.
#[derive(Clone, Debug)]
pub(in crate::report) enum Data {
    Travel(Envelope),
    Surface(Grid),
    Cloud(Points),
    Histogram(Histogram),
    /// Nothing of single configurations.
    Whole,
}

/// A figure in the making.
#[derive(Clone, Debug)]
pub(in crate::report) struct Gather<'a> {
    pub(in crate::report) figure: &'a Figure,
    /// Index of its source; all together if there is none.
    pub(in crate::report) source: Option<usize>,
    /// Whether there are only bounds to show, of one random source or of many.
    pub(in crate::report) bounds: bool,
    /// Whether the source, if it is one, is random.
    random: bool,
    pub(in crate::report) data: Data,
}

impl<'a> Gather<'a> {
    /// None if the source of the figure is switched off.
    pub(in crate::report) fn new(figure: &'a Figure, description: &Description) -> Option<Self> {
        let source = match &figure.source {
            Some(name) => Some(description.sources.iter().position(|source| source.name == name)?),
            None => None,
        };
        let data = match figure.content {
            Content::Travel(_) => Data::Travel(Envelope::default()),
            Content::Surface(_) => Data::Surface(Grid::default()),
            Content::Cloud => Data::Cloud(Points::default()),
            Content::Histogram => Data::Histogram(Histogram::default()),
            Content::Pareto | Content::Manipulator(_) => Data::Whole,
        };
        let is_random = |source: &Source| source.class != Class::Repeatable;
        let random = source.is_some_and(|source| is_random(&description.sources[source]));
        let bounds = random || source.is_none() && description.sources.iter().all(is_random);
        Some(Self { figure, source, bounds, random, data })
    }

    /// Takes in a configuration.
    pub(in crate::report) fn add(&mut self, row: &Row) {
        let errors = self.errors(row);
        let configuration = row.configuration;
        match (&mut self.data, self.figure.content) {
            (Data::Travel(envelope), Content::Travel(over)) => {
                let travel = value(over, configuration);
                envelope.0.at(travel).add(travel, &errors, configuration);
            }
            (Data::Surface(grid), Content::Surface([first, second])) => {
                let second = value(second, configuration);
                grid.at(value(first, configuration), second).add(second, &errors, configuration);
            }
            (Data::Cloud(points), _) => points.add(&errors, self.bounds, configuration),
            (Data::Histogram(histogram), _) => {
                let shown = if self.bounds { errors.random } else { errors.repeatable };
                let [x, y, z] = shown;
                let values = [x, y, z, norm(shown)];
                histogram.0.iter_mut().zip(values).for_each(|(bins, value)| bins.at(value).0 += 1);
            }
            _ => {}
        }
    }

    fn errors(&self, row: &Row) -> Errors {
        let position = |[x, y, z, ..]: [f64; 6]| [x, y, z];
        match self.source.map(|source| position(row.sources[source])) {
            None => Errors { repeatable: position(row.repeatable), random: position(row.random) },
            Some(random) if self.random => Errors { repeatable: [0.0; 3], random },
            Some(repeatable) => Errors { repeatable, random: [0.0; 3] },
        }
    }

    /// What was gathered.
    pub(in crate::report) fn finish(self) -> Gathered {
        match self.data {
            Data::Travel(mut envelope) => {
                envelope.finish();
                Gathered::Travel(envelope)
            }
            Data::Surface(grid) => Gathered::Surface(grid.mesh()),
            Data::Cloud(points) => Gathered::Cloud(points),
            Data::Histogram(mut histogram) => {
                // Some twenty to forty bars.
                histogram.0.iter_mut().for_each(|bins| bins.span_at_most(40));
                Gathered::Histogram(histogram)
            }
            Data::Whole => Gathered::Whole,
        }
    }
}

/// What a figure shows, gathered.
#[derive(Clone, Debug)]
pub(in crate::report) enum Gathered {
    Travel(Envelope),
    Surface(Mesh),
    Cloud(Points),
    Histogram(Histogram),
    Whole,
}

fn value(over: Over, configuration: &Configuration) -> f64 {
    match over {
        Over::Variable(variable) => configuration.q[variable],
        Over::Parameter(parameter) => configuration.s[parameter],
    }
}
