//! Errors in space: three views with the same scale, and the sphere around them all.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Failed, Sheet, Side, line, panel, px, rgb, text};
use crate::axis::{Axis, BAR, INK, TOLERANCE, XYZ};
use crate::figure::Named;
use crate::spheres::Spheres;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Points;

pub(super) fn draw(points: &Points, figure: &Named, report: &Report) -> Result<String, Failed> {
    let errors = figure.axis(report);
    let spheres = Spheres::of(points, figure, report);
    let reach = errors.show(spheres.radius.max(spheres.tolerance.unwrap_or_default())) * 1.12;
    let reach = if reach > 0.0 { reach } else { 1.0 };

    let shown = format!("{} of {} configurations", points.kept.len(), points.seen());
    Sheet::new((1080, 370), figure, report, &shown).draw(|area| {
        // As high as they are wide, labels aside.
        let (views, below) = area.split_vertically(px(324.0));
        let areas = views.split_evenly((1, 3));
        for ((across, up), area) in [(0, 1), (0, 2), (2, 1)].into_iter().zip(areas) {
            let axis =
                |i: usize| Axis { name: format!("{} error", figure.rows(report)[i]), ..errors.clone() };
            let (across_axis, up_axis) = (axis(across), axis(up));
            let side = |axis| Side { axis, range: [-reach, reach], about: 7, labelled: true };
            let mut chart = panel(&area, &side(&across_axis), &side(&up_axis), 18.0)?;
            let at = |error: [f64; 3]| (errors.show(error[across]), errors.show(error[up]));
            let dot = rgb(BAR).mix(0.55).filled();
            let dots = points.kept.iter().map(|point| Circle::new(at(point.error), px(1.6), dot));
            chart.draw_series(dots)?;
            let tolerance = spheres.tolerance.map(|tolerance| (tolerance, line(TOLERANCE, 1.4)));
            for (radius, style) in tolerance.into_iter().chain([(spheres.radius, line(INK, 1.5))]) {
                let round = (0..=180).map(|i| f64::from(i) * std::f64::consts::PI / 90.0);
                let radius = errors.show(radius);
                let round = round.map(|angle| (radius * angle.cos(), radius * angle.sin()));
                chart.draw_series(LineSeries::new(round, style))?;
            }
            if let Some((_, worst)) = &points.worst {
                let mark = Cross::new(at(worst.error), px(5.0), line(XYZ[0], 2.0));
                chart.draw_series([mark])?;
            }
        }
        let style = text(11.5, INK, HPos::Left, VPos::Bottom);
        let (_, height) = below.dim_in_pixel();
        below.draw(&Text::new(spheres.legend(report), (px(18.0), height as i32 - px(12.0)), style))?;
        Ok(())
    })
}
