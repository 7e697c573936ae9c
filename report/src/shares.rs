//! The share of each source in the sum of the largest errors.

use super::figure::Named;
use abbe_study::analyze::Report;

/// The most sources that stand alone.
const MOST: usize = 12;

/// A bar of a Pareto chart.
#[derive(Clone, Debug)]
pub(super) struct Share {
    pub(super) name: String,
    /// The largest norm, in the unit of the figure.
    pub(super) largest: f64,
    /// Its share of the sum.
    pub(super) share: f64,
    /// Its share, and those of all larger ones.
    pub(super) cumulative: f64,
}

/// The largest first; the smallest together, if there are many.
pub(super) fn shares(figure: &Named, report: &Report) -> Vec<Share> {
    let errors = figure.axis(report);
    let sources = report.budget.errors(figure.asked.measurand).0.iter();
    let name = |source: usize| report.sources[source].name.clone();
    let largest = sources.map(|alone| (name(alone.source), errors.show(alone.plain_max.norm)));
    let mut largest = largest.collect::<Vec<_>>();
    largest.sort_by(|a, b| b.1.total_cmp(&a.1));
    if largest.len() > MOST {
        let rest = largest.split_off(MOST - 1);
        let sum = rest.iter().map(|(_, error)| error).sum();
        largest.push((format!("{} others", rest.len()), sum));
    }
    let sum = largest.iter().map(|(_, error)| error).sum::<f64>();
    let mut cumulative = 0.0;
    let share = |(name, largest)| {
        let share = if sum > 0.0 { largest / sum } else { 0.0 };
        cumulative += share;
        Share { name, largest, share, cumulative }
    };
    largest.into_iter().map(share).collect()
}
