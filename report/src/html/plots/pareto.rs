//! The share of each source, the largest first, and the shares added up.

use plotly::common::{HoverInfo, Line, Marker, Mode};
use plotly::{Bar, Layout, Scatter};

use super::Plots;
use super::style::{axis, margin, plot};
use crate::axis::{BAR, XYZ, css};
use crate::figure::Named;
use crate::shares::shares;
use abbe_study::analyze::Report;
use abbe_study::number::trimmed;

pub(super) fn plots(figure: &Named, report: &Report) -> Plots {
    let shares = shares(figure, report);
    let unit = figure.axis(report).unit;
    let names = shares.iter().map(|bar| super::super::escaped(&bar.name)).collect::<Vec<_>>();
    let percent = |value: f64| trimmed(100.0 * value, 1);
    let hover = shares.iter().map(|bar| {
        let (share, together) = (percent(bar.share), percent(bar.cumulative));
        let largest = trimmed(bar.largest, 4);
        format!("{}: {largest} {unit}, {share} %<br>together {together} %", super::super::escaped(&bar.name))
    });
    let hover = hover.collect::<Vec<_>>();
    let layout = Layout::new()
        .margin(margin([60, 16, 16, 40]))
        .x_axis(axis("").show_grid(false))
        .y_axis(axis("share (%)").range(vec![0.0, 105.0]));
    let mut plot = plot(layout);
    let bars = Bar::new(names.clone(), shares.iter().map(|bar| 100.0 * bar.share).collect())
        .marker(Marker::new().color(css(BAR, 1.0)))
        .hover_info(HoverInfo::Text)
        .hover_text_array(hover.clone());
    let line = Scatter::new(names, shares.iter().map(|bar| 100.0 * bar.cumulative).collect())
        .mode(Mode::LinesMarkers)
        .line(Line::new().color(css(XYZ[0], 1.0)).width(2.0))
        .hover_info(HoverInfo::Text)
        .hover_text_array(hover);
    plot.add_trace(bars);
    plot.add_trace(line);
    let note = "Bars: share of the sum of the largest norms of each source alone. Line: shares added up.";
    Plots { plots: vec![plot], height: 380, note: note.to_owned() }
}
