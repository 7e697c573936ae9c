//! Data of one figure while it is gathered.

use abbe::analysis::{Configuration, ErrorParts, Measurand, Row};
use abbe::{Class, Description, Source};
use serde::{Deserialize, Serialize};

use super::errors::Errors;
use super::extremes::{Envelope, Extremes, Grid};
use super::{Bins, Count, FigureData, Histogram, Points};
use crate::study_file::{Content, Figure, Over};

/// Data gathered so far for a figure.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::analyze) enum PartialFigure {
    Travel(Bins<Extremes>),
    Surface(Grid),
    Cloud(Points),
    Histogram([Bins<Count>; 4]),
    /// No data per configuration.
    Whole,
}

impl PartialFigure {
    /// Appends the data of the configurations that follow, possibly from a file. Returns false if
    /// they do not fit.
    pub(super) fn append(&mut self, other: Self) -> bool {
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

/// A figure while its data are gathered.
#[derive(Clone, Debug)]
pub(super) struct FigureBuilder<'a> {
    pub(super) figure: &'a Figure,
    /// Index of its source; `None` combines all sources.
    pub(super) source: Option<usize>,
    /// Shows error bounds instead of signed errors: every source that contributes is random.
    pub(super) bounds: bool,
    /// The figure shows a single random source.
    random: bool,
    parts: ErrorParts,
    pub(super) data: PartialFigure,
}

impl<'a> FigureBuilder<'a> {
    /// Creates the figure; returns `None` if its source is switched off.
    pub(super) fn new(figure: &'a Figure, description: &Description) -> Option<Self> {
        let source = match &figure.source {
            Some(name) => Some(description.sources.iter().position(|source| source.name == name)?),
            None => None,
        };
        let data = match figure.content {
            Content::Travel(_) => PartialFigure::Travel(Envelope::bins()),
            Content::Surface(_) => PartialFigure::Surface(Grid::default()),
            Content::Cloud => PartialFigure::Cloud(Points::default()),
            Content::Histogram => PartialFigure::Histogram(Histogram::bins()),
            Content::Pareto | Content::Manipulator(_) => PartialFigure::Whole,
        };
        let is_random = |source: &Source| source.class != Class::Repeatable;
        let random = source.is_some_and(|source| is_random(&description.sources[source]));
        let bounds = random || source.is_none() && description.sources.iter().all(is_random);
        Some(Self { figure, source, bounds, random, parts: ErrorParts::new(description), data })
    }

    /// Adds a configuration, if its rows of the measurand exist.
    pub(super) fn add(&mut self, row: &Row) {
        if self.figure.measurand == Measurand::Orientation && !row.oriented {
            return;
        }
        let errors = self.errors(row);
        let configuration = row.configuration;
        match (&mut self.data, self.figure.content) {
            (PartialFigure::Travel(bins), Content::Travel(over)) => {
                let travel = value(over, configuration);
                bins.bin_mut(travel).add(travel, &errors, configuration);
            }
            (PartialFigure::Surface(grid), Content::Surface([first, second])) => {
                let second = value(second, configuration);
                grid.bin_mut(value(first, configuration), second).add(second, &errors, configuration);
            }
            (PartialFigure::Cloud(points), _) => points.add(row.index, &errors, self.bounds, configuration),
            (PartialFigure::Histogram(all), _) => {
                Histogram::add(all, if self.bounds { errors.random } else { errors.repeatable });
            }
            _ => {}
        }
    }

    fn errors(&self, row: &Row) -> Errors {
        let rows = |deviation: &[f64; 6]| self.figure.measurand.rows(deviation);
        match self.source {
            None => Errors {
                repeatable: rows(&row.repeatable),
                random: rows(&row.random),
                random_norm: row.random_norms[self.figure.measurand as usize],
            },
            Some(source) if self.random => {
                let (random, random_norm) = self.parts.largest(source, row.sources, self.figure.measurand);
                Errors { repeatable: [0.0; 3], random, random_norm }
            }
            Some(source) => {
                Errors { repeatable: rows(&row.sources[source]), random: [0.0; 3], random_norm: 0.0 }
            }
        }
    }

    /// Returns the data to draw.
    pub(super) fn finish(self) -> FigureData {
        match self.data {
            PartialFigure::Travel(bins) => FigureData::Travel(Envelope::new(bins)),
            PartialFigure::Surface(grid) => FigureData::Surface(grid.mesh()),
            PartialFigure::Cloud(points) => FigureData::Cloud(points),
            PartialFigure::Histogram(all) => FigureData::Histogram(Histogram::new(all)),
            PartialFigure::Whole => FigureData::Pareto,
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
