//! The figures as SVG, one file each.

mod canvas;
mod cloud;
mod histogram;
mod manipulator;
mod pareto;
mod rule;
mod surface;
mod travel;

use super::data::gather::Gathered;
use super::figure::Figure;
use super::subject::Subject;
use abbe_study::study_file::Content;

use canvas::{Failed, Sheet};

/// Draws a figure.
pub(super) fn draw(figure: &Figure, subject: &Subject) -> Result<String, Failed> {
    let sheet = |size, subtitle: &str| Sheet::new(size, figure, subject, subtitle);
    match (&figure.data, figure.asked.content) {
        (Gathered::Travel(envelope), Content::Travel(over)) => travel::draw(envelope, over, figure, subject),
        (Gathered::Surface(mesh), Content::Surface(over)) => surface::draw(mesh, over, figure, subject),
        (Gathered::Cloud(points), _) => cloud::draw(points, figure, subject),
        (Gathered::Histogram(histogram), _) => histogram::draw(histogram, figure, subject),
        (_, Content::Manipulator(up)) => manipulator::draw(up, &sheet((900, 640), ""), subject),
        _ => pareto::draw(&sheet((900, 460), "largest norm of each source alone"), subject),
    }
}
