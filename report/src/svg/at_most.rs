//! The largest norms: what was sampled, and between which two values the true maximum lies.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Failed, Sheet, Side, line, panel, px, rgb, text};
use crate::axis::{Axis, BAR, INK, TOLERANCE, XYZ};
use abbe::analysis::Measurand;
use abbe_study::analyze::{Report, Sampled};
use abbe_study::number::{decimals, fixed, rounded_down, rounded_up};

/// How high the part of a kind of errors is, pixels.
const ROW: u32 = 52;

/// Draws it; nothing if nothing is certified.
pub(crate) fn draw(report: &Report) -> Result<Option<String>, Failed> {
    let rows = report.sampled();
    if rows.is_empty() {
        return Ok(None);
    }
    let unit = Axis::errors(Measurand::Position, &report.spec);
    let axis = Axis { name: "largest norm of the position's error".to_owned(), ..unit };
    let tolerance = report.study.tolerance.map(|tolerance| axis.show(tolerance));
    let ends = rows.iter().map(|row| axis.show(row.largest.certified.unwrap_or(row.largest.found)));
    let most = ends.chain(tolerance).fold(0.0, f64::max);
    // What was found in a larger box says nothing of the workspace.
    let contains_more = report.box_contains_more();
    let caption = match contains_more {
        true => {
            "Bars: what was sampled. The line: what nothing in a box that holds more than the workspace exceeds."
        }
        false => {
            "Bars: what was sampled. Between the two lines, which may be one, lies the true maximum: the first was found, and \
             nothing in the box exceeds the second."
        }
    };
    let size = (900, ROW * rows.len() as u32 + 60);
    let sheet = Sheet::titled(size, "Sampled and certified", &report.spec.title, caption);
    let drawn = sheet.draw(|area| {
        let rank = Axis { name: String::new(), unit: String::new(), factor: 1.0 };
        let x = Side {
            axis: &axis,
            range: [0.0, if most > 0.0 { 1.04 * most } else { 1.0 }],
            about: 8,
            labelled: true,
        };
        let y = Side { axis: &rank, range: [-(rows.len() as f64) + 0.5, 0.5], about: 0, labelled: false };
        let mut chart = panel(area, &x, &y, 18.0)?;
        if let Some(tolerance) = tolerance {
            let ends = [(tolerance, y.range[0]), (tolerance, y.range[1])];
            chart.draw_series(DashedLineSeries::new(ends, px(5.0), px(4.0), line(TOLERANCE, 1.2)))?;
        }
        for (i, Sampled { sources, sampled, largest }) in rows.iter().enumerate() {
            let middle = -(i as f64);
            let (low, high) = (middle - 0.36, middle + 0.06);
            let sampled = axis.show(*sampled);
            chart.draw_series([Rectangle::new([(0.0, low), (sampled, high)], rgb(BAR).filled())])?;
            let found = axis.show(largest.found);
            let certified = largest.certified.map(|certified| axis.show(certified));
            let found_here = Some(found).filter(|_| !contains_more);
            for value in [found_here, certified].into_iter().flatten() {
                chart
                    .draw_series([PathElement::new(vec![(value, low), (value, high)], line(XYZ[0], 2.0))])?;
            }
            let decimals = decimals(found, 4);
            let at_most =
                certified.map_or_else(|| "not known".to_owned(), |value| rounded_up(value, decimals));
            let unit = &axis.unit;
            let at_least = match contains_more {
                true => String::new(),
                false => format!("at least {} {unit}, ", rounded_down(found, decimals)),
            };
            let sampled = fixed(sampled, decimals);
            let label = format!("{sources}: {sampled} {unit} sampled; {at_least}at most {at_most} {unit}");
            let style = text(11.5, INK, HPos::Left, VPos::Bottom);
            let text = Text::new(label, (px(4.0), -px(3.0)), style);
            chart.draw_series([EmptyElement::at((0.0, high)) + text])?;
        }
        Ok(())
    })?;
    Ok(Some(drawn))
}
