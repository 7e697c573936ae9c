//! Pareto chart: the share of each source in descending order, and the cumulative share.

use abbe_study::{analyze::Report, number::trimmed};

use super::NamedFigure;
use crate::scene::{Axis, Colour, Mark, Panel, Scale, Scene};

/// Maximum number of bars.
const MOST: usize = 12;

pub(super) fn scene(figure: &NamedFigure, report: &Report) -> Scene {
    let errors = largest_errors(figure, report);
    let sum = errors.iter().map(|(_, error)| error).sum::<f64>();
    let share = |error: f64| if sum > 0.0 { 100.0 * error / sum } else { 0.0 };
    let mut added = 0.0;
    let (mut bars, mut curve) = (Vec::new(), Vec::new());
    for (i, (_, error)) in errors.iter().enumerate() {
        let at = i as f64;
        added += share(*error);
        bars.push([[at - 0.36, 0.0], [at + 0.36, share(*error)]]);
        curve.push([at, added]);
    }
    let unit = figure.errors(report).unit;
    let names = errors.iter().map(|(name, error)| format!("{name}\n{} {unit}", trimmed(*error, 3)));
    let range = [-0.8, errors.len().max(1) as f64 - 0.4];
    let x = Axis::linear("", "", range).scaled(Scale::Names(names.collect()));
    let marks = vec![
        Mark::bars(Colour::BAR, bars).named("share of the sum of the largest errors"),
        Mark::line(Colour::XYZ[0], 1.8, curve.clone()).named("cumulative share"),
        Mark::points(Colour::XYZ[0], 3.2, curve),
    ];
    let panel = Panel::plane(330.0, x, Axis::linear("share", "%", [0.0, 105.0]), marks);
    Scene { subtitle: "Largest norm of each source alone".to_owned(), ..Scene::new("", 1, vec![panel]) }
}

/// Returns the largest norm of each source in the unit of the figure, in descending order. Beyond
/// the maximum number, the smallest are summed.
fn largest_errors(figure: &NamedFigure, report: &Report) -> Vec<(String, f64)> {
    let unit = figure.errors(report);
    let sources = report.budget.errors(figure.request.measurand).0.iter();
    let error =
        sources.map(|alone| (report.sources[alone.source].name.clone(), unit.show(alone.plain_max.norm)));
    let mut errors = error.collect::<Vec<_>>();
    errors.sort_by(|a, b| b.1.total_cmp(&a.1));
    if errors.len() > MOST {
        let rest = errors.split_off(MOST - 1);
        let sum = rest.iter().map(|(_, error)| error).sum();
        errors.push((format!("{} others", rest.len()), sum));
    }
    errors
}
