//! Errors along a travel: one panel for each axis, with the same scale.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Failed, Sheet, Side, line, panel, px, rgb, text};
use crate::axis::{Axis, PUBLISHED, XYZ, with_room};
use crate::figure::Named;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::{Envelope, Range};
use abbe_study::study_file::Over;

pub(super) fn draw(
    envelope: &Envelope,
    over: Over,
    figure: &Named,
    report: &Report,
) -> Result<String, Failed> {
    let travel = Axis::over(over, &report.spec);
    let errors = figure.axis(report);
    let bins = envelope.0.iter().map(|(_, bin)| bin).collect::<Vec<_>>();
    let mut spans = [Range::default(); 3];
    let mut travelled = Range::default();
    for bin in &bins {
        travelled.join(bin.travel);
        spans.iter_mut().zip(bin.errors).for_each(|(span, errors)| span.join(errors));
    }
    let printed: [_; 3] = std::array::from_fn(|axis| figure.printed(axis, spans[axis], report));
    let mut all = Range { least: 0.0, largest: 0.0 };
    spans.into_iter().chain(printed.iter().flatten().map(|printed| printed.range)).for_each(|r| all.join(r));
    let range = with_room([all.least, all.largest].map(|error| errors.show(error)), 0.12);
    let across = with_room([travelled.least, travelled.largest].map(|value| travel.show(value)), 0.02);

    let any_printed = printed.iter().any(Option::is_some);
    let what = format!("least and largest {} where others vary too{}", figure.errors(), figure.remark());
    Sheet::new((900, 600), figure, report, &what).draw(|area| {
        let areas = area.split_by_breakpoints(Vec::<i32>::new(), [px(185.0), px(370.0)]);
        for (axis, area) in areas.iter().enumerate() {
            let name = format!("{} {}", figure.rows(report)[axis], figure.errors());
            let errors = Axis { name, ..errors.clone() };
            let x = Side { axis: &travel, range: across, about: 9, labelled: axis == 2 };
            let y = Side { axis: &errors, range, about: 4, labelled: true };
            let mut chart = panel(area, &x, &y, if any_printed { 128.0 } else { 18.0 })?;
            chart.draw_series(LineSeries::new(across.map(|end| (end, 0.0)), line((150, 154, 160), 1.0)))?;

            let edge = |end: fn(Range) -> f64| {
                bins.iter().map(move |bin| (bin.travel.middle(), end(bin.errors[axis])))
            };
            let show = |(at, error): (f64, f64)| (travel.show(at), errors.show(error));
            let upper = edge(|range| range.largest).map(show).collect::<Vec<_>>();
            let lower = edge(|range| range.least).map(show).collect::<Vec<_>>();
            let band = upper.iter().chain(lower.iter().rev()).copied().collect::<Vec<_>>();
            chart.draw_series([Polygon::new(band, rgb(XYZ[axis]).mix(0.22).filled())])?;
            for curve in [upper, lower] {
                chart.draw_series(LineSeries::new(curve, line(XYZ[axis], 1.6)))?;
            }

            let Some(printed) = &printed[axis] else { continue };
            for end in [printed.range.least, printed.range.largest].map(|end| errors.show(end)) {
                let ends = across.map(|at| (at, end));
                let style = line(PUBLISHED, 1.2);
                chart.draw_series(DashedLineSeries::new(ends, px(6.0), px(4.0), style))?;
            }
            let place = (across[1], errors.show(printed.range.middle()));
            for (row, words) in printed.lines.iter().enumerate() {
                let style = text(11.0, PUBLISHED, HPos::Left, VPos::Center);
                let down = 15.0 * (row as f64 - 0.5 * (printed.lines.len() - 1) as f64);
                let label = Text::new(words.clone(), (px(8.0), px(down)), style);
                chart.draw_series([EmptyElement::at(place) + label])?;
            }
        }
        Ok(())
    })
}
