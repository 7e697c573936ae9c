//! Errors in space, and the spheres about zero.

use plotly::common::{ColorScale, ColorScaleElement, HoverInfo, Marker, MarkerSymbol, Mode};
use plotly::layout::{AspectMode, Layout};
use plotly::{Scatter3D, Surface};

use super::Plots;
use super::style::{margin, plot, scene};
use crate::axis::{BAR, INK, TOLERANCE, XYZ, css};
use crate::figure::Named;
use crate::spheres::Spheres;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::norm;
use abbe_study::analyze::figures::{Point, Points};
use abbe_study::number::trimmed;

/// Meridians and parallels of a sphere.
const MESH: usize = 36;

pub(super) fn plots(points: &Points, figure: &Named, report: &Report) -> Plots {
    let errors = figure.axis(report);
    let unit = &errors.unit;
    let titles = figure.rows(report).map(|axis| format!("{axis} {} ({unit})", figure.errors()));
    let titles = titles.each_ref().map(String::as_str);
    let layout = Layout::new().margin(margin([0, 0, 0, 0])).scene(scene(titles, AspectMode::Data, 2, 0.8));
    let mut plot = plot(layout);
    let shown = |points: &[&Point]| {
        let along =
            |axis: usize| points.iter().map(|point| errors.show(point.error[axis])).collect::<Vec<_>>();
        let hover = |point: &&Point| {
            let [x, y, z] = point.error.map(|error| trimmed(errors.show(error), 4));
            let norm = trimmed(errors.show(norm(point.error)), 4);
            format!("({x}, {y}, {z}) {unit}, norm {norm} {unit}<br>{}", report.label(&point.configuration))
        };
        Scatter3D::new(along(0), along(1), along(2))
            .mode(Mode::Markers)
            .hover_info(HoverInfo::Text)
            .hover_text_array(points.iter().map(hover).collect::<Vec<_>>())
    };
    let kept = points.kept.iter().collect::<Vec<_>>();
    plot.add_trace(shown(&kept).marker(Marker::new().size(3).opacity(0.8).color(css(BAR, 1.0))));
    if let Some((_, worst)) = &points.worst {
        let cross = Marker::new().size(5).symbol(MarkerSymbol::Cross).color(css(XYZ[0], 1.0));
        plot.add_trace(shown(&[worst]).marker(cross));
    }
    let spheres = Spheres::of(points, figure, report);
    plot.add_trace(sphere(errors.show(spheres.radius), &css(INK, 1.0), 0.10));
    if let Some(tolerance) = spheres.tolerance {
        plot.add_trace(sphere(errors.show(tolerance), &css(TOLERANCE, 1.0), 0.35));
    }
    let note = format!(
        "{}. {} of {} configurations are drawn.",
        spheres.legend(report).replace("circle", "sphere").replace("Solid", "Large"),
        points.kept.len(),
        points.seen()
    );
    Plots { plots: vec![plot], height: 560, note }
}

fn sphere(radius: f64, colour: &str, opacity: f64) -> Box<Surface<Vec<f64>, Vec<f64>, f64>> {
    let at = |i: usize, of: f64| of * i as f64 / MESH as f64;
    let point = |i: usize, j: usize| {
        let (turn, height) = (at(i, std::f64::consts::TAU), at(j, std::f64::consts::PI));
        [turn.cos() * height.sin(), turn.sin() * height.sin(), height.cos()].map(|unit| round(radius * unit))
    };
    let mesh = |axis: usize| {
        let line = |i: usize| (0..=MESH).map(|j| point(i, j)[axis]).collect();
        (0..=MESH).map(line).collect::<Vec<Vec<_>>>()
    };
    let colours = [0.0, 1.0].map(|at| ColorScaleElement(at, colour.to_owned()));
    Surface::new(mesh(2))
        .x(mesh(0))
        .y(mesh(1))
        .color_scale(ColorScale::Vector(colours.to_vec()))
        .show_scale(false)
        .opacity(opacity)
        .hover_info(HoverInfo::None)
}

/// Six digits: the file need not be longer.
fn round(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}
