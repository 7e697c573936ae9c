//! Error cloud: three views with the same scale, and circles about zero.

use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Points;
use abbe_study::number::{short, trimmed};

use super::{NamedFigure, Quantity};
use crate::scene::{Axis, Colour, Mark, Panel, Scene, Shape, View};

/// Horizontal and vertical axis of each view.
const VIEWS: [[usize; 2]; 3] = [[0, 1], [0, 2], [2, 1]];

/// Creates the three views of marks in space.
pub(super) fn views(axes: &[Axis; 3], marks: impl Fn([usize; 2]) -> Vec<Mark<[f64; 2]>>) -> Vec<Panel> {
    let view = |[across, up]: [usize; 2]| {
        let (x, y, marks) = (axes[across].clone(), axes[up].clone(), marks([across, up]));
        Panel::new(244.0, View::Plane { x, y, equal: true, marks })
    };
    VIEWS.map(view).to_vec()
}

pub(super) fn scene(points: &Points, figure: &NamedFigure, report: &Report) -> Scene {
    let errors = figure.errors(report);
    let radius = errors.show(points.worst.as_ref().map_or(0.0, |(norm, _)| *norm));
    let tolerance = report.tolerance(figure.request.measurand).map(|tolerance| errors.show(tolerance));
    let reach = radius.max(tolerance.unwrap_or_default()) * 1.12;
    let reach = if reach > 0.0 { reach } else { 1.0 };
    let axes = figure.rows(report).map(|row| errors.named(format!("{row} error")).axis([-reach, reach]));
    let circles = [Some((radius, Colour::INK, around(radius, &errors, figure, report)))].into_iter();
    let circles = circles.chain([tolerance.map(|tolerance| {
        (tolerance, Colour::TOLERANCE, format!("tolerance {} {}", trimmed(tolerance, 3), errors.unit))
    })]);
    let circles = circles.flatten().collect::<Vec<_>>();
    let panels = views(&axes, |[across, up]| {
        let at = |error: [f64; 3]| [errors.show(error[across]), errors.show(error[up])];
        let dots = points.kept.iter().map(|point| at(point.error)).collect();
        let mut marks = vec![Mark::points(Colour::BAR, 1.6, dots).faded(0.6).named("configurations")];
        for (radius, colour, name) in &circles {
            marks.push(Mark::line(*colour, 1.5, circle(*radius)).named(name));
        }
        let worst = points.worst.iter().map(|(_, worst)| at(worst.error)).collect::<Vec<_>>();
        if !worst.is_empty() {
            marks.push(Mark::new(Colour::XYZ[0], Shape::Crosses { points: worst }).named("largest error"));
        }
        marks
    });
    let subtitle = format!("{} of {} configurations", points.kept.len(), points.seen);
    Scene { subtitle, ..Scene::new("", 3, panels) }
}

/// Names the circle around all errors, including the random errors.
fn around(radius: f64, errors: &Quantity, figure: &NamedFigure, report: &Report) -> String {
    let unit = &errors.unit;
    let mut name = format!("radius {} {unit}{}", trimmed(radius, 3), figure.remark());
    if let Some(published) = figure.published_total(report) {
        name += &format!(" ({}: {} {unit})", report.publisher(), short(errors.show(published)));
    }
    name
}

fn circle(radius: f64) -> Vec<[f64; 2]> {
    let angles = (0..=120).map(|i| f64::from(i) * std::f64::consts::PI / 60.0);
    angles.map(|angle| [radius * angle.cos(), radius * angle.sin()]).collect()
}
