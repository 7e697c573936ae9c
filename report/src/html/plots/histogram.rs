//! How often which error occurs: along each axis, and of the norm.

use plotly::common::{HoverInfo, Marker};
use plotly::{Bar, Layout};

use super::Plots;
use super::style::{axis, margin, plot};
use crate::axis::{INK, XYZ, css};
use crate::figure::Named;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Histogram;
use abbe_study::number::trimmed;

pub(super) fn plots(histogram: &Histogram, figure: &Named, report: &Report) -> Plots {
    let errors = figure.axis(report);
    let unit = &errors.unit;
    let [x, y, z] = figure.rows(report);
    let names = [x, y, z, "norm of the"];
    let colours = [XYZ[0], XYZ[1], XYZ[2], INK];
    let plots = histogram.0.iter().zip(names).zip(colours).map(|((bins, name), colour)| {
        let bars = bins.iter().map(|(key, count)| (bins.edges(key).map(|edge| errors.show(edge)), count.0));
        let bars = bars.collect::<Vec<_>>();
        let hover = bars.iter().map(|([from, to], count)| {
            format!("{} … {} {unit}: {count} configurations", trimmed(*from, 5), trimmed(*to, 5))
        });
        let hover = hover.collect::<Vec<_>>();
        let width = bars.first().map_or(1.0, |([from, to], _)| to - from);
        let middles = bars.iter().map(|([from, to], _)| f64::midpoint(*from, *to)).collect::<Vec<_>>();
        let counts = bars.iter().map(|(_, count)| *count).collect::<Vec<_>>();
        let title = format!("{name} {} ({unit})", figure.errors());
        let layout = Layout::new()
            .margin(margin([56, 10, 10, 44]))
            .x_axis(axis(&title))
            .y_axis(axis("configurations"));
        let mut plot = plot(layout);
        let bar = Bar::new(middles, counts)
            .width(width * 0.94)
            .marker(Marker::new().color(css(colour, 0.75)))
            .hover_info(HoverInfo::Text)
            .hover_text_array(hover);
        plot.add_trace(bar);
        plot
    });
    Plots::new(plots.collect(), 260)
}
