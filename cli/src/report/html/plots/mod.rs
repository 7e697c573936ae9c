//! The figures to rotate, to zoom and to point at.

mod cloud;
mod histogram;
mod manipulator;
mod pareto;
pub(crate) mod style;
mod surface;
mod travel;

use plotly::Plot;

use crate::report::data::gather::Gathered;
use crate::report::figure::Figure;
use crate::report::subject::Subject;
use abbe_study::study_file::Content;

/// Plots that stand side by side.
pub(super) struct Plots {
    pub(super) plots: Vec<Plot>,
    /// In pixels.
    pub(super) height: u32,
    /// What is to be said below them.
    pub(super) note: String,
}

impl Plots {
    fn new(plots: Vec<Plot>, height: u32) -> Self {
        Self { plots, height, note: String::new() }
    }
}

/// The plots of a figure.
pub(super) fn of(figure: &Figure, subject: &Subject) -> Plots {
    match (&figure.data, figure.asked.content) {
        (Gathered::Travel(envelope), Content::Travel(over)) => travel::plots(envelope, over, figure, subject),
        (Gathered::Surface(mesh), Content::Surface(over)) => surface::plots(mesh, over, figure, subject),
        (Gathered::Cloud(points), _) => cloud::plots(points, figure, subject),
        (Gathered::Histogram(histogram), _) => histogram::plots(histogram, figure, subject),
        (_, Content::Manipulator(up)) => manipulator::plots(up, subject),
        _ => pareto::plots(subject),
    }
}
