//! The share of each source in the sum of the largest errors.

use super::axis::Axis;
use abbe_study::analyze::Report;

/// The most sources that stand alone.
const MOST: usize = 12;

/// A bar of a Pareto chart.
#[derive(Clone, Debug)]
pub(super) struct Share {
    pub(super) name: String,
    /// The largest norm, in mm.
    pub(super) millimetres: f64,
    /// Its share of the sum.
    pub(super) share: f64,
    /// Its share, and those of all larger ones.
    pub(super) cumulative: f64,
}

/// The largest first; the smallest together, if there are many.
pub(super) fn shares(report: &Report) -> Vec<Share> {
    let errors = Axis::errors("", &report.spec);
    let sources = report.budget.sources.iter();
    let name = |source: usize| report.source(source).name.clone();
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
    let share = |(name, millimetres)| {
        let share = if sum > 0.0 { millimetres / sum } else { 0.0 };
        cumulative += share;
        Share { name, millimetres, share, cumulative }
    };
    largest.into_iter().map(share).collect()
}
