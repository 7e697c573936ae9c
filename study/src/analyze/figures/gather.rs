//! Gathers what one figure shows.

use abbe::analysis::{Configuration, Row};
use abbe::{Class, Description, Source};

use super::errors::Errors;
use super::extremes::{Envelope, Grid};
use super::figure::Gathered;
use super::histogram::Histogram;
use super::points::Points;
use crate::study_file::{Content, Figure, Over};

/// What a figure shows.
#[derive(Clone, Debug)]
enum Data {
    Travel(Envelope),
    Surface(Grid),
    Cloud(Points),
    Histogram(Histogram),
    /// Nothing of single configurations.
    Whole,
}

/// A figure in the making.
#[derive(Clone, Debug)]
pub(super) struct Gather<'a> {
    pub(super) figure: &'a Figure,
    /// Index of its source; all together if there is none.
    pub(super) source: Option<usize>,
    /// Whether there are only bounds to show, of one random source or of many.
    pub(super) bounds: bool,
    /// Whether the source, if it is one, is random.
    random: bool,
    data: Data,
}

impl<'a> Gather<'a> {
    /// None if the source of the figure is switched off.
    pub(super) fn new(figure: &'a Figure, description: &Description) -> Option<Self> {
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
    pub(super) fn add(&mut self, row: &Row) {
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
                histogram.add(if self.bounds { errors.random } else { errors.repeatable });
            }
            _ => {}
        }
    }

    fn errors(&self, row: &Row) -> Errors {
        let rows = |deviation: &[f64; 6]| self.figure.measurand.rows(deviation);
        match self.source.map(|source| rows(&row.sources[source])) {
            None => Errors { repeatable: rows(&row.repeatable), random: rows(&row.random) },
            Some(random) if self.random => Errors { repeatable: [0.0; 3], random },
            Some(repeatable) => Errors { repeatable, random: [0.0; 3] },
        }
    }

    /// What was gathered.
    pub(super) fn finish(self) -> Gathered {
        match self.data {
            Data::Travel(mut envelope) => {
                envelope.finish();
                Gathered::Travel(envelope)
            }
            Data::Surface(grid) => Gathered::Surface(grid.mesh()),
            Data::Cloud(points) => Gathered::Cloud(points),
            Data::Histogram(mut histogram) => {
                histogram.finish();
                Gathered::Histogram(histogram)
            }
            Data::Whole => Gathered::Pareto,
        }
    }
}

fn value(over: Over, configuration: &Configuration) -> f64 {
    match over {
        Over::Variable(variable) => configuration.q[variable],
        Over::Parameter(parameter) => configuration.s[parameter],
        Over::Input(input) => configuration.u[input],
    }
}
