//! Scenes of reports, one file for each kind of figure.
//!
//! `travel`, `surface`, `cloud`, `histogram`, `pareto` and `manipulator` are the figures that a
//! study can request; [`NamedFigure`] has their titles and file names.
//! `measured`, `residuals`, `distances`, `charts` and `deviations` are the figures of measurements,
//! identification, compensation, monitoring and positioning tests.

pub(crate) mod charts;
mod cloud;
pub(crate) mod deviations;
pub(crate) mod distances;
mod histogram;
mod manipulator;
pub(crate) mod measured;
mod named;
mod pareto;
mod quantity;
pub(crate) mod residuals;
mod surface;
mod travel;

use abbe::analysis::sampling::norm;
use abbe_study::{analyze::Report, analyze::figures::FigureData, study_file::Content};

pub(crate) use named::NamedFigure;
use quantity::Quantity;

use crate::scene::Scene;

/// Builds the scene of a figure of an analysis.
pub(crate) fn scene(figure: &NamedFigure, report: &Report) -> Scene {
    let scene = match (figure.data, figure.request.content) {
        (FigureData::Travel(envelope), Content::Travel(over)) => {
            travel::scene(envelope, over, figure, report)
        }
        (FigureData::Surface(mesh), Content::Surface(over)) => surface::scene(mesh, over, figure, report),
        (FigureData::Cloud(points), _) => cloud::scene(points, figure, report),
        (FigureData::Histogram(histogram), _) => histogram::scene(histogram, figure, report),
        (FigureData::Manipulator(stick), Content::Manipulator(up)) => manipulator::scene(stick, up, report),
        _ => pareto::scene(figure, report),
    };
    let paper = &figure.request.paper;
    let reference = match paper.as_str() {
        "" => String::new(),
        paper => format!("cf. {paper} of {}", report.publisher()),
    };
    Scene {
        title: figure.title.clone(),
        manipulator: report.spec.title.clone(),
        reference,
        caption: figure.request.caption.clone(),
        ..scene
    }
}

/// Returns the step that thins `count` items to at most `most`.
fn step(count: usize, most: usize) -> usize {
    count.div_ceil(most).max(1)
}

/// Returns the sentence about thinning, or nothing if all items are shown.
fn thinned(count: usize, step: usize) -> String {
    if step == 1 { String::new() } else { format!(" One in {step} of {count} is drawn.") }
}
