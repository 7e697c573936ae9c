//! The spheres about zero that belong to a cloud of errors.

use super::axis::Axis;
use super::figure::Named;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Points;
use abbe_study::number::{self, short};

/// Radii in the length unit.
pub(super) struct Spheres {
    /// Around everything that is shown, with what random errors may add.
    pub(super) radius: f64,
    added: bool,
    published: Option<f64>,
    pub(super) tolerance: Option<f64>,
    errors: Axis,
}

impl Spheres {
    pub(super) fn of(points: &Points, figure: &Named, report: &Report) -> Self {
        Self {
            radius: points.worst.as_ref().map_or(0.0, |(norm, _)| *norm),
            added: figure.asked.source.is_none() && !figure.bounds,
            published: figure.printed_radius(report),
            tolerance: report.tolerance(figure.asked.measurand),
            errors: figure.axis(report),
        }
    }

    /// What the circles are.
    pub(super) fn legend(&self, report: &Report) -> String {
        let errors = &self.errors;
        let show = |value: f64| format!("{} {}", number::trimmed(errors.show(value), 3), errors.unit);
        let what = if self.added { ", random errors added" } else { "" };
        let mut text = format!("Solid circle: radius {}{what}", show(self.radius));
        if let Some(published) = self.published {
            let (publisher, published) = (report.publisher(), short(errors.show(published)));
            text += &format!(" ({publisher}: {published} mm)");
        }
        if let Some(tolerance) = self.tolerance {
            text += &format!(" · small grey circle: tolerance {}", show(tolerance));
        }
        text + " · cross: largest error"
    }
}
