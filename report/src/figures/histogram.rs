//! Histograms of errors: along each axis, and of the norm.
//!
//! Range of a figure without outliers, which would compress the rest to a line. The figure states
//! their number.

#[cfg(test)]
mod tests;

use abbe::analysis::sampling::range_of;
use abbe_study::{analyze::Report, analyze::figures::Histogram};

use super::NamedFigure;
use crate::scene::{Axis, Colour, Mark, Panel, Scene, with_margin};

/// Height of a panel, in pixels.
const HEIGHT: f64 = 190.0;
/// Maximum number of bins of a list of values.
const BINS: usize = 40;

/// Shows the histograms of an analysis.
pub(super) fn scene(histogram: &Histogram, figure: &NamedFigure, report: &Report) -> Scene {
    let Histogram(all) = histogram;
    let errors = figure.errors(report);
    let counts = all.iter().flat_map(|bins| bins.iter().map(|(_, count)| count.0));
    let most = counts.max().unwrap_or_default().max(1) as f64;
    let total = all[3].iter().map(|(_, count)| count.0).sum::<usize>();
    let [x, y, z] = figure.rows(report);
    let names = [x, y, z, "norm of the"].map(|name| format!("{name} {}", figure.what()));
    let panels = all.iter().zip(names).zip(COLOURS).map(|((bins, name), colour)| {
        let bar = |(key, count): (i64, &abbe_study::analyze::figures::Count)| {
            let [from, to] = bins.edges(key).map(|edge| errors.show(edge));
            [[from, 0.0], [to, count.0 as f64]]
        };
        let bars = bins.iter().map(bar).collect::<Vec<_>>();
        let range = with_margin(range_of(bars.iter().flatten().map(|corner| corner[0])), 0.04);
        let y = Axis::linear("configurations", "", [0.0, 1.05 * most]);
        Panel::plane(HEIGHT, errors.named(name).axis(range), y, vec![Mark::bars(colour, bars).faded(0.8)])
    });
    Scene { subtitle: format!("{total} configurations"), ..Scene::new("", 2, panels.collect()) }
}

/// Colours of x, y, z and the norm.
pub(super) const COLOURS: [Colour; 4] = [Colour::XYZ[0], Colour::XYZ[1], Colour::XYZ[2], Colour::INK];

/// List of values with its colour and its name in the legend, which may be empty.
pub(super) struct NamedValues {
    pub(super) values: Vec<f64>,
    pub(super) colour: Colour,
    pub(super) name: &'static str,
}

impl NamedValues {
    pub(super) fn new(values: Vec<f64>, colour: Colour) -> Self {
        Self { values, colour, name: "" }
    }
}

/// Creates a panel of lists over the same bins, without outliers.
pub(super) fn panel(name: &str, unit: &str, lists: &[NamedValues]) -> Panel {
    // Outliers are found in each list separately.
    let each: Vec<FigureRange> = lists.iter().map(|list| FigureRange::new(list.values.clone())).collect();
    let beyond = each.iter().map(|reach| reach.beyond).sum();
    let joined = each.iter().map(|reach| reach.ends).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    let reach = FigureRange { ends: joined.unwrap_or_default(), beyond };
    let [least, most] = reach.ends;
    let largest = lists.iter().map(|list| list.values.len()).max().unwrap_or_default();
    // Proportional to the square root of the number of values, so that twenty rows do not form a
    // comb.
    let bins = ((largest as f64).sqrt() * 1.5).ceil().clamp(5.0, BINS as f64) as usize;
    let width = ((most - least) / bins as f64).max(1e-9);
    let edge = |i: usize| least + i as f64 * width;
    let mut highest = 1;
    let marks = lists.iter().map(|list| {
        let mut counts = vec![0_usize; bins];
        for value in list.values.iter().filter(|value| reach.contains(**value)) {
            counts[(((value - least) / width) as usize).min(bins - 1)] += 1;
        }
        highest = highest.max(counts.iter().copied().max().unwrap_or_default());
        let bars = counts.iter().enumerate().filter(|(_, count)| **count > 0);
        let bars = bars.map(|(i, count)| [[edge(i), 0.0], [edge(i + 1), *count as f64]]).collect();
        Mark::bars(list.colour, bars).faded(if lists.len() > 1 { 0.65 } else { 0.8 }).named(list.name)
    });
    let marks = marks.collect();
    let x = Axis::linear(reach.title(name), unit, with_margin([least, edge(bins)], 0.02));
    Panel::plane(HEIGHT, x, Axis::linear("count", "", [0.0, 1.05 * highest as f64]), marks)
}

/// Distance from the middle 80 % of the values, in multiples of their width, beyond which a value
/// is an outlier.
const TIMES: f64 = 4.0;
/// Number of values below which all are shown.
const FEWEST: usize = 20;

/// Range of a figure, and number of values outside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FigureRange {
    pub(super) ends: [f64; 2],
    pub(super) beyond: usize,
}

impl FigureRange {
    /// Computes the range of finite values.
    pub(super) fn new(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let (Some(least), Some(most)) = (values.first().copied(), values.last().copied()) else {
            return Self { ends: [0.0, 0.0], beyond: 0 };
        };
        let [low, high] = [values[values.len() / 10], values[values.len() * 9 / 10]];
        let far = TIMES * (high - low);
        if values.len() < FEWEST || far == 0.0 {
            return Self { ends: [least, most], beyond: 0 };
        }
        let inside = |value: &&f64| (low - far..=high + far).contains(*value);
        let kept: Vec<f64> = values.iter().filter(inside).copied().collect();
        let ends = [kept.first().copied().unwrap_or(least), kept.last().copied().unwrap_or(most)];
        Self { ends, beyond: values.len() - kept.len() }
    }

    /// Appends the number of values outside the range to the name of an axis.
    pub(super) fn title(self, name: &str) -> String {
        match self.beyond {
            0 => name.to_owned(),
            beyond => format!("{name}; {beyond} beyond"),
        }
    }

    pub(super) fn contains(self, value: f64) -> bool {
        (self.ends[0]..=self.ends[1]).contains(&value)
    }
}
