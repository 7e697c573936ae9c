//! The figures as SVG, one file each.

mod at_most;
mod canvas;
mod cloud;
mod histogram;
mod manipulator;
mod pareto;
mod rule;
mod surface;
mod travel;

use super::figure::Named;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Gathered;
use abbe_study::study_file::Content;

pub(super) use at_most::draw as at_most;
use canvas::{Failed, Sheet};

/// Draws a figure.
pub(super) fn draw(figure: &Named, report: &Report) -> Result<String, Failed> {
    let sheet = |size, subtitle: &str| Sheet::new(size, figure, report, subtitle);
    match (figure.data, figure.asked.content) {
        (Gathered::Travel(envelope), Content::Travel(over)) => travel::draw(envelope, over, figure, report),
        (Gathered::Surface(mesh), Content::Surface(over)) => surface::draw(mesh, over, figure, report),
        (Gathered::Cloud(points), _) => cloud::draw(points, figure, report),
        (Gathered::Histogram(histogram), _) => histogram::draw(histogram, figure, report),
        (Gathered::Manipulator(stick), Content::Manipulator(up)) => {
            manipulator::draw(stick, up, &sheet((900, 640), ""), report)
        }
        _ => pareto::draw(&sheet((900, 460), "largest norm of each source alone"), figure, report),
    }
}
