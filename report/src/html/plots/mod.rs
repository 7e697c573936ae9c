//! The figures to rotate, to zoom and to point at.

mod cloud;
mod histogram;
mod manipulator;
mod pareto;
pub(super) mod style;
mod surface;
mod travel;

use plotly::Plot;

use crate::figure::Named;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Gathered;
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
pub(super) fn of(figure: &Named, report: &Report) -> Plots {
    match (figure.data, figure.asked.content) {
        (Gathered::Travel(envelope), Content::Travel(over)) => travel::plots(envelope, over, figure, report),
        (Gathered::Surface(mesh), Content::Surface(over)) => surface::plots(mesh, over, figure, report),
        (Gathered::Cloud(points), _) => cloud::plots(points, figure, report),
        (Gathered::Histogram(histogram), _) => histogram::plots(histogram, figure, report),
        (Gathered::Manipulator(stick), Content::Manipulator(up)) => manipulator::plots(stick, up, report),
        _ => pareto::plots(figure, report),
    }
}
