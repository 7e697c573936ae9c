//! Largest norms: sampled values, and the interval that contains the true maximum.

use abbe::analysis::Measurand;
use abbe_study::analyze::{NormComparison, Report};
use abbe_study::number::{decimals, fixed, rounded_down, rounded_up};

use super::Quantity;
use crate::scene::{Axis, Colour, Mark, Panel, Scene};

/// Height per class of sources, in pixels.
const ROW: f64 = 52.0;

/// Builds the figure; none if nothing is certified.
pub(crate) fn scene(report: &Report) -> Option<Scene> {
    let rows = report.norm_comparisons();
    if rows.is_empty() {
        return None;
    }
    let errors = Quantity::errors(Measurand::Position, &report.spec);
    let tolerance = report.study.tolerance.map(|tolerance| errors.show(tolerance));
    let ends = rows.iter().map(|row| errors.show(row.bound.certified.unwrap_or(row.bound.found)));
    let most = ends.chain(tolerance).fold(0.0, f64::max);
    // The largest error found in an enclosing box is no lower bound over the workspace.
    let contains_more = report.box_exceeds_workspace();
    let range = [0.0, if most > 0.0 { 1.04 * most } else { 1.0 }];
    let height = [0.5 - rows.len() as f64, 0.5];
    let (mut bars, mut lines, mut texts) = (Vec::new(), Vec::new(), Vec::new());
    for (i, row) in rows.iter().enumerate() {
        let (low, high) = (-(i as f64) - 0.36, -(i as f64) + 0.06);
        bars.extend(row.sampled.map(|sampled| [[0.0, low], [errors.show(sampled), high]]));
        let found = Some(errors.show(row.bound.found)).filter(|_| !contains_more);
        let certified = row.bound.certified.map(|certified| errors.show(certified));
        lines.extend(found.into_iter().chain(certified).map(|at| vec![[at, low], [at, high]]));
        texts.push(([0.0, high], label(row, &errors, contains_more)));
    }
    let sampled = (!bars.is_empty()).then(|| Mark::bars(Colour::BAR, bars).named("sampled"));
    let mut marks: Vec<_> = sampled.into_iter().collect();
    if let Some(tolerance) = tolerance {
        let line = height.map(|at| [tolerance, at]).to_vec();
        marks.push(Mark::dashed(Colour::TOLERANCE, vec![line]).named("tolerance"));
    }
    let name = if contains_more { "certified maximum of the box" } else { "the true maximum lies between" };
    marks.push(Mark::lines(Colour::XYZ[0], 2.0, lines).named(name));
    marks.push(Mark::texts(texts));
    let x = errors.named("largest norm of the position error").axis(range);
    let panel = Panel::plane(ROW * rows.len() as f64, x, Axis::names(Vec::new(), height), marks);
    let scene = Scene::new("Sampled and certified", 1, vec![panel]).captioned(caption(report));
    Some(Scene { manipulator: report.spec.title.clone(), ..scene })
}

/// Describes the bars and the lines.
fn caption(report: &Report) -> String {
    let lines = match report.box_exceeds_workspace() {
        true => {
            "Line: certified maximum to first order over the enclosing joint box, which is larger \
             than the workspace; the maximum over the workspace may be smaller"
        }
        false => {
            "Lines: the largest error found and the certified maximum over the box of the \
             workspace, to first order. The true maximum lies between them; where both coincide \
             there is one line"
        }
    };
    let tolerance = if report.study.tolerance.is_some() { "; the dashed line is the tolerance" } else { "" };
    format!("Bars: sampled maximum, a lower bound. {lines}{tolerance}.")
}

fn label(row: &NormComparison, errors: &Quantity, contains_more: bool) -> String {
    let unit = &errors.unit;
    let found = errors.show(row.bound.found);
    let decimals = decimals(found, 4);
    let certified = row.bound.certified.map(|certified| errors.show(certified));
    let at_most = certified.map_or_else(|| "not known".to_owned(), |value| rounded_up(value, decimals));
    let at_least = match contains_more {
        true => String::new(),
        false => format!("at least {} {unit}, ", rounded_down(found, decimals)),
    };
    let sampled =
        row.sampled.map(|sampled| format!("{} {unit} sampled; ", fixed(errors.show(sampled), decimals)));
    format!("{}: {}{at_least}at most {at_most} {unit}", row.sources, sampled.unwrap_or_default())
}
