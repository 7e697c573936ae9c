//! How often which error occurs: along each axis, and of the norm.

use plotters::prelude::*;

use super::canvas::{Failed, Sheet, Side, panel, px, rgb};
use crate::axis::{Axis, INK, XYZ, with_room};
use crate::figure::Named;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Histogram;

pub(super) fn draw(histogram: &Histogram, figure: &Named, report: &Report) -> Result<String, Failed> {
    let Histogram(all) = histogram;
    let counts = all.iter().flat_map(|bins| bins.iter().map(|(_, count)| count.0));
    let most = counts.max().unwrap_or_default() as f64;
    let count = Axis { name: "configurations".to_owned(), unit: String::new(), factor: 1.0 };
    let total = all[3].iter().map(|(_, count)| count.0).sum::<usize>();
    Sheet::new((900, 560), figure, report, &format!("{total} configurations")).draw(|area| {
        let [x, y, z] = figure.rows(report);
        let names = [x, y, z, "norm of the"].map(|name| format!("{name} {}", figure.errors()));
        let colours = [XYZ[0], XYZ[1], XYZ[2], INK];
        for (((area, bins), name), colour) in
            area.split_evenly((2, 2)).iter().zip(all).zip(names).zip(colours)
        {
            let errors = Axis { name, ..figure.axis(report) };
            let edges = |(key, count): (i64, &_)| (bins.edges(key).map(|edge| errors.show(edge)), *count);
            let bars = bins.iter().map(edges).collect::<Vec<_>>();
            let ends = bars.first().zip(bars.last()).map(|((first, _), (last, _))| [first[0], last[1]]);
            let x = Side {
                axis: &errors,
                range: with_room(ends.unwrap_or_default(), 0.04),
                about: 6,
                labelled: true,
            };
            let y = Side { axis: &count, range: [0.0, most.max(1.0) * 1.05], about: 4, labelled: true };
            let mut chart = panel(area, &x, &y, 18.0)?;
            let style = rgb(colour).mix(0.75).filled();
            chart.draw_series(bars.iter().map(
                |([left, right], count): &([f64; 2], abbe_study::analyze::figures::Count)| {
                    let mut bar = Rectangle::new([(*left, 0.0), (*right, count.0 as f64)], style);
                    bar.set_margin(0, 0, px(0.5).unsigned_abs(), px(0.5).unsigned_abs());
                    bar
                },
            ))?;
        }
        Ok(())
    })
}
