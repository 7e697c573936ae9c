//! The error farthest from zero over two travels: one surface for each axis.

use plotly::common::{ColorScale, ColorScalePalette, HoverInfo, Marker, Mode, Title};
use plotly::layout::{AspectMode, Layout};
use plotly::{Scatter3D, Surface};

use super::Plots;
use super::style::{font, margin, plot, scene};
use crate::axis::{Axis, INK, css};
use crate::figure::Named;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::{Extremes, Mesh, Worst};
use abbe_study::number::trimmed;
use abbe_study::study_file::Over;

pub(super) fn plots(mesh: &Mesh, over: [Over; 2], figure: &Named, report: &Report) -> Plots {
    let [first, second] = over.map(|over| Axis::over(over, &report.spec));
    let (errors, rows) = (figure.axis(report), figure.rows(report));
    let plots = (0..3).map(|i| {
        let height = |cell: &Option<Extremes>| Some(errors.show(cell.as_ref()?.errors[i].farther()));
        // Plotly's lines are along y: it wants one for each value of the second.
        let lines = |content: &dyn Fn(&Option<Extremes>) -> Option<f64>| {
            let line = |j: usize| mesh.cells.iter().map(|line| content(&line[j])).collect();
            (0..mesh.second.len()).map(line).collect::<Vec<Vec<_>>>()
        };
        let name = format!("{} {} ({})", rows[i], figure.errors(), errors.unit);
        let surface = Surface::new(lines(&height))
            .x(mesh.first.iter().map(|value| first.show(*value)).collect())
            .y(mesh.second.iter().map(|value| second.show(*value)).collect())
            .color_scale(ColorScale::Palette(ColorScalePalette::Viridis))
            .show_scale(false)
            .hover_info(HoverInfo::None);
        let titles = [first.title(), second.title(), name.clone()];
        let layout = Layout::new()
            .title(Title::with_text(name.as_str()).font(font(13)).x(0.04).y(0.97))
            .margin(margin([0, 0, 30, 0]))
            .scene(scene(titles.each_ref().map(String::as_str), AspectMode::Cube, 2, 1.0));
        let mut plot = plot(layout);
        plot.add_trace(surface);
        plot.add_trace(dots(mesh, i, [&first, &second], figure, report));
        plot
    });
    Plots::new(plots.collect(), 400)
}

/// The corners of the surface, to point at: a surface itself cannot say more than its numbers.
fn dots(
    mesh: &Mesh,
    axis: usize,
    [first, second]: [&Axis; 2],
    figure: &Named,
    report: &Report,
) -> Box<Scatter3D<f64, f64, f64>> {
    let errors = figure.axis(report);
    let (mut at, mut texts) = ([const { Vec::new() }; 3], Vec::new());
    for (line, one) in mesh.cells.iter().zip(&mesh.first) {
        for (cell, other) in line.iter().zip(&mesh.second) {
            let Some(cell) = cell else { continue };
            let height = errors.show(cell.errors[axis].farther());
            let place = [first.show(*one), second.show(*other), height];
            at.iter_mut().zip(place).for_each(|(values, value)| values.push(value));
            texts.push(hover(cell, axis, figure, report));
        }
    }
    let [x, y, z] = at;
    Scatter3D::new(x, y, z)
        .mode(Mode::Markers)
        .marker(Marker::new().size(2).opacity(0.35).color(css(INK, 1.0)))
        .hover_info(HoverInfo::Text)
        .hover_text_array(texts)
}

fn hover(cell: &Extremes, axis: usize, figure: &Named, report: &Report) -> String {
    let errors = figure.axis(report);
    let unit = &errors.unit;
    let value = trimmed(errors.show(cell.errors[axis].farther()), 5);
    let worst = cell.worst.as_ref().map(|Worst { norm, configuration }| {
        let norm = trimmed(errors.show(*norm), 5);
        format!("<br>largest norm {norm} {unit} at<br>{}", report.label(configuration))
    });
    format!("{} {value} {unit}{}", figure.rows(report)[axis], worst.unwrap_or_default())
}
