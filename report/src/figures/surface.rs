//! Error with the largest magnitude over two variables: one surface per axis.

use abbe::analysis::sampling::range_of;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::{Merge, Mesh, Range};
use abbe_study::number::trimmed;
use abbe_study::study_file::Over;

use super::{NamedFigure, Quantity};
use crate::scene::{Corner, Mark, Panel, Scene, View, with_margin};

pub(super) fn scene(mesh: &Mesh, over: [Over; 2], figure: &NamedFigure, report: &Report) -> Scene {
    let [first, second] = over.map(|over| Quantity::over(over, &report.spec));
    let errors = figure.errors(report);
    let panels = (0..3).map(|axis| {
        let lines = mesh.cells.iter().zip(&mesh.first).map(|(line, one)| {
            let corners = line.iter().zip(&mesh.second).map(|(cell, other)| {
                let value = errors.show(cell.as_ref()?.errors[axis].farther());
                Some(Corner { at: [first.show(*one), second.show(*other), value], value })
            });
            corners.collect::<Vec<_>>()
        });
        let corners = lines.collect::<Vec<_>>();
        let values = corners.iter().flatten().flatten().map(|corner| corner.value);
        let range = with_margin(range_of(values.chain([0.0])), 0.0);
        let axes = [
            first.axis(with_margin(range_of(mesh.first.iter().map(|value| first.show(*value))), 0.0)),
            second.axis(with_margin(range_of(mesh.second.iter().map(|value| second.show(*value))), 0.0)),
            errors.axis(range),
        ];
        let view = View::Space { axes, up: 2, equal: false, marks: vec![Mark::surface(corners, range)] };
        let title = format!("{} {} ({})", figure.rows(report)[axis], figure.what(), errors.unit);
        Panel { title, published: published(axis, mesh, figure, report), height: 270.0, view }
    });
    let subtitle =
        format!("Largest magnitude of {} over all other variables{}", figure.what(), figure.remark());
    Scene { subtitle, ..Scene::new("", 3, panels.collect()) }
}

/// States the error with the largest magnitude on an axis, and the published one.
fn published(axis: usize, mesh: &Mesh, figure: &NamedFigure, report: &Report) -> String {
    let mut span = Range::default();
    mesh.cells.iter().flatten().flatten().for_each(|cell| span.merge(cell.errors[axis]));
    let errors = figure.errors(report);
    let here = format!("here: {} {}", trimmed(errors.show(span.farther()), 4), errors.unit);
    match figure.published_range(axis, span, report) {
        Some(printed) => format!("{here} · {}", printed.label),
        None => here,
    }
}
