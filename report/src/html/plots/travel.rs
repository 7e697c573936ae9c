//! Errors along a travel: one panel for each axis, with the same scale.

use plotly::common::{DashType, Fill, HoverInfo, Line, Mode};
use plotly::{Layout, Scatter};

use super::Plots;
use super::style::{axis, margin, plot};
use crate::axis::{Axis, PUBLISHED, XYZ, css};
use crate::figure::Named;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::{Envelope, Extremes, Range, Worst};
use abbe_study::number::trimmed;
use abbe_study::study_file::Over;

/// Where the panels of x, y and z are, as shares of the height.
const DOMAINS: [[f64; 2]; 3] = [[0.7, 1.0], [0.35, 0.65], [0.0, 0.3]];

pub(super) fn plots(envelope: &Envelope, over: Over, figure: &Named, report: &Report) -> Plots {
    let travel = Axis::over(over, &report.spec);
    let (errors, rows) = (figure.axis(report), figure.rows(report));
    let title = |i: usize| format!("{} {} ({})", rows[i], figure.errors(), errors.unit);
    let side = |i: usize| axis(&title(i)).domain(&DOMAINS[i]);
    let layout = Layout::new()
        .margin(margin([70, 16, 12, 50]))
        .x_axis(axis(&travel.title()).anchor("y3"))
        .y_axis(side(0))
        .y_axis2(side(1).matches("y"))
        .y_axis3(side(2).matches("y"));
    let mut plot = plot(layout);

    let bins = envelope.0.iter().map(|(_, bin)| bin).collect::<Vec<_>>();
    let at = bins.iter().map(|bin| travel.show(bin.travel.middle())).collect::<Vec<_>>();
    let mut notes = Vec::new();
    for i in 0..3 {
        let name = ["y", "y2", "y3"][i];
        let mut span = Range::default();
        bins.iter().for_each(|bin| span.join(bin.errors[i]));
        let edge = |end: fn(Range) -> f64| bins.iter().map(|bin| errors.show(end(bin.errors[i]))).collect();
        let edges: [Vec<f64>; 2] = [edge(|range| range.least), edge(|range| range.largest)];
        for (end, values) in edges.into_iter().enumerate() {
            let hover = bins.iter().map(|bin| hover(bin, i, [&travel, &errors], report)).collect::<Vec<_>>();
            let curve = Scatter::new(at.clone(), values)
                .mode(Mode::Lines)
                .y_axis(name)
                .line(Line::new().color(css(XYZ[i], 1.0)).width(1.6))
                .hover_info(HoverInfo::Text)
                .hover_text_array(hover);
            let band = |curve: Box<Scatter<_, _>>| curve.fill(Fill::ToNextY).fill_color(css(XYZ[i], 0.2));
            plot.add_trace(if end == 1 { band(curve) } else { curve });
        }
        let Some(printed) = figure.printed(i, span, report) else { continue };
        notes.push(format!("{} in {}", printed.lines[1..].join(" "), rows[i]));
        for end in [printed.range.least, printed.range.largest] {
            let ends = at.first().into_iter().chain(at.last()).copied().collect::<Vec<_>>();
            let line = Scatter::new(ends, vec![errors.show(end); 2])
                .mode(Mode::Lines)
                .y_axis(name)
                .line(Line::new().color(css(PUBLISHED, 1.0)).width(1.3).dash(DashType::Dash))
                .hover_info(HoverInfo::Text)
                .hover_text(printed.label());
            plot.add_trace(line);
        }
    }
    let note = if notes.is_empty() {
        String::new()
    } else {
        format!("Dashed lines, {}: {}.", report.publisher(), notes.join(", "))
    };
    Plots { plots: vec![plot], height: 520, note }
}

fn hover(bin: &Extremes, axis: usize, [travel, errors]: [&Axis; 2], report: &Report) -> String {
    let unit = &errors.unit;
    let show = |value: f64| trimmed(errors.show(value), 5);
    let Range { least, largest } = bin.errors[axis];
    let range = if least == largest { show(least) } else { format!("{} … {}", show(least), show(largest)) };
    let at = trimmed(travel.show(bin.travel.middle()), 3);
    let worst = bin.worst.as_ref().map(|Worst { norm, configuration }| {
        format!("<br>largest norm {} {unit} at {}", show(*norm), report.label(configuration))
    });
    format!("{} = {at} {}: {range} {unit}{}", travel.name, travel.unit, worst.unwrap_or_default())
}
