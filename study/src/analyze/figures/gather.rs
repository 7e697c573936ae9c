//! Gathers what one figure shows.

use abbe::analysis::{Configuration, Row};
use abbe::{Class, Description, Source};
use serde::{Deserialize, Serialize};

use super::bins::Bins;
use super::errors::Errors;
use super::extremes::{Envelope, Extremes, Grid};
use super::figure::Gathered;
use super::histogram::{Count, Histogram};
use super::points::Points;
use crate::study_file::{Content, Figure, Over};

/// What was gathered for a figure so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::analyze) enum Data {
    Travel(Bins<Extremes>),
    Surface(Grid),
    Cloud(Points),
    Histogram([Bins<Count>; 4]),
    /// Nothing of single configurations.
    Whole,
}

impl Data {
    /// Takes in what follows, which may come from a file; says whether it can follow.
    fn append(&mut self, other: Self) -> bool {
        match (self, other) {
            (Self::Travel(here), Self::Travel(other)) if here.accepts(&other) => here.merge(other),
            (Self::Surface(here), Self::Surface(other)) if here.accepts(&other) => here.merge(other),
            (Self::Cloud(here), Self::Cloud(other)) if here.accepts(&other) => here.append(other),
            (Self::Histogram(here), Self::Histogram(other))
                if here.iter().zip(&other).all(|(here, other)| here.accepts(other)) =>
            {
                here.iter_mut().zip(other).for_each(|(here, other)| here.merge(other));
            }
            (Self::Whole, Self::Whole) => {}
            _ => return false,
        }
        true
    }
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
            Content::Travel(_) => Data::Travel(Envelope::bins()),
            Content::Surface(_) => Data::Surface(Grid::default()),
            Content::Cloud => Data::Cloud(Points::default()),
            Content::Histogram => Data::Histogram(Histogram::bins()),
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
            (Data::Travel(bins), Content::Travel(over)) => {
                let travel = value(over, configuration);
                bins.at(travel).add(travel, &errors, configuration);
            }
            (Data::Surface(grid), Content::Surface([first, second])) => {
                let second = value(second, configuration);
                grid.at(value(first, configuration), second).add(second, &errors, configuration);
            }
            (Data::Cloud(points), _) => points.add(row.index, &errors, self.bounds, configuration),
            (Data::Histogram(all), _) => {
                Histogram::add(all, if self.bounds { errors.random } else { errors.repeatable });
            }
            _ => {}
        }
    }

    /// What was gathered so far.
    pub(super) fn data(self) -> Data {
        self.data
    }

    /// Takes in what follows; says whether it is of such a figure.
    pub(super) fn append(&mut self, other: Data) -> bool {
        self.data.append(other)
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
            Data::Travel(bins) => Gathered::Travel(Envelope::new(bins)),
            Data::Surface(grid) => Gathered::Surface(grid.mesh()),
            Data::Cloud(points) => Gathered::Cloud(points),
            Data::Histogram(all) => Gathered::Histogram(Histogram::new(all)),
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
