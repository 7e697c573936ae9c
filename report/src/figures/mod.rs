//! The scenes of reports, one file for each kind of figure.
//!
//! `travel`, `surface`, `cloud`, `histogram`, `pareto` and `manipulator` are those that a study asks for, [`Named`] has their
//! titles and files; `sampled` shows what is certified. `measured`, `residuals`, `distances` and `charts` are those of
//! measurements, identifications, corrected commands and checks.

pub(crate) mod charts;
mod cloud;
pub(crate) mod distances;
mod histogram;
mod manipulator;
pub(crate) mod measured;
mod named;
mod pareto;
mod quantity;
mod reach;
pub(crate) mod residuals;
mod sampled;
mod surface;
mod travel;

use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Gathered;
use abbe_study::study_file::Content;

pub(crate) use named::Named;
use quantity::Quantity;
pub(crate) use sampled::scene as sampled;

use crate::scene::Scene;

/// The scene of a figure of an analysis.
pub(crate) fn scene(figure: &Named, report: &Report) -> Scene {
    let scene = match (figure.data, figure.asked.content) {
        (Gathered::Travel(envelope), Content::Travel(over)) => travel::scene(envelope, over, figure, report),
        (Gathered::Surface(mesh), Content::Surface(over)) => surface::scene(mesh, over, figure, report),
        (Gathered::Cloud(points), _) => cloud::scene(points, figure, report),
        (Gathered::Histogram(histogram), _) => histogram::scene(histogram, figure, report),
        (Gathered::Manipulator(stick), Content::Manipulator(up)) => manipulator::scene(stick, up, report),
        _ => pareto::scene(figure, report),
    };
    let paper = &figure.asked.paper;
    let reference = match paper.as_str() {
        "" => String::new(),
        paper => format!("cf. {paper} of {}", report.publisher()),
    };
    Scene {
        title: figure.title.clone(),
        manipulator: report.spec.title.clone(),
        reference,
        caption: figure.asked.caption.clone(),
        ..scene
    }
}

/// The Euclidean norm.
fn norm(vector: [f64; 3]) -> f64 {
    vector.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// The step at which no more than `most` of so many are drawn.
fn step(count: usize, most: usize) -> usize {
    count.div_ceil(most).max(1)
}

/// A sentence behind others if not all are drawn.
fn thinned(count: usize, step: usize) -> String {
    if step == 1 { String::new() } else { format!(" One in {step} of {count} is drawn.") }
}
