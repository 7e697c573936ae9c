//! The manipulator as a stick figure with its frames, at home.

use plotly::Scatter3D;
use plotly::common::{HoverInfo, Line, Marker, Mode, Position};
use plotly::layout::{AspectMode, Layout};

use super::Plots;
use super::style::{margin, plot, scene};
use crate::axis::{INK, XYZ, css};
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Stick;
use abbe_study::number::length;

pub(super) fn plots(stick: &Stick, up: usize, report: &Report) -> Plots {
    let unit = report.spec.length;
    let titles = ["x", "y", "z"].map(|axis| format!("{axis} ({})", unit.symbol()));
    let titles = titles.each_ref().map(String::as_str);
    let layout = Layout::new().margin(margin([0, 0, 0, 0])).scene(scene(titles, AspectMode::Data, up, 0.85));
    let mut plot = plot(layout);
    let Stick { places, size } = stick;
    let along = |axis: usize| places.iter().map(|place| place.origin[axis]).collect::<Vec<_>>();
    let hover = places.iter().map(|place| {
        let [x, y, z] = place.origin.map(|at| length(at, unit));
        format!("{}<br>({x}, {y}, {z})", super::super::escaped(&place.label))
    });
    let links = Scatter3D::new(along(0), along(1), along(2))
        .mode(Mode::LinesMarkersText)
        .text_array(places.iter().map(|place| super::super::escaped(&place.label)).collect::<Vec<_>>())
        .text_position(Position::TopRight)
        .line(Line::new().color("rgb(176,182,192)").width(8.0))
        .marker(Marker::new().size(5).color(css(INK, 1.0)))
        .hover_info(HoverInfo::Text)
        .hover_text_array(hover.collect::<Vec<_>>());
    plot.add_trace(links);
    for (axis, colour) in XYZ.into_iter().enumerate() {
        // All arrows of one direction are one line with gaps.
        let line = |i: usize| {
            let ends = places.iter().flat_map(|place| {
                let origin = place.origin[i];
                [Some(origin), Some(origin + 0.11 * size * place.axes[axis][i]), None]
            });
            ends.collect::<Vec<_>>()
        };
        let arrows = Scatter3D::new(line(0), line(1), line(2))
            .mode(Mode::Lines)
            .line(Line::new().color(css(colour, 1.0)).width(5.0))
            .hover_info(HoverInfo::None);
        plot.add_trace(arrows);
    }
    let note = "Axes of each frame: x orange, y green, z blue. Links are straight lines between origins.";
    Plots { plots: vec![plot], height: 520, note: note.to_owned() }
}
