//! Figures of compensation: position errors of the tool point before and after.

use abbe::analysis::sampling::range_of;
use abbe_metrology::compensate::{Report, Row};
use abbe_spec::Spec;
use abbe_study::study_file::Over;

use super::histogram::{NamedValues, panel};
use super::{Quantity, step, thinned};
use crate::scene::{Axis, Colour, Mark, Panel, Scale, Scene, with_margin};

/// Maximum number of dots per panel.
const DOTS: usize = 3000;
/// Height of a panel, in pixels.
const HEIGHT: f64 = 200.0;
/// Smallest distance on the logarithmic scale, in mm.
const LEAST: f64 = 1e-5;
/// Colours and names of both distances.
const BEFORE: (Colour, &str) = (Colour::GREY, "as commanded");
const AFTER: (Colour, &str) = (Colour::BAR, "corrected");

/// Builds the figures of corrected commands.
pub(crate) fn scenes(report: &Report, spec: &Spec) -> Vec<Scene> {
    let to_mm = 1e3 * spec.length.in_metres();
    let every = step(report.rows.len(), DOTS);
    let numbered = report.rows.iter().enumerate().step_by(every);
    let shown: Vec<(f64, &Row)> = numbered.map(|(i, row)| (i as f64 + 1.0, row)).collect();
    let few = thinned(report.rows.len(), every);
    let caption = format!("Logarithmic scale; values below 10 nm are drawn at 10 nm.{few}");
    let x = Axis::linear("row", "", [0.0, report.rows.len() as f64 + 1.0]);
    let over_rows = Scene::new("Position error by row", 1, vec![distances(&shown, x, to_mm)]);
    let over_joint = |joint: usize| {
        let quantity = Quantity::over(Over::Variable(joint), spec);
        let at = |row: &Row| row.q.0.get(joint).map_or(0.0, |(_, value)| quantity.show(*value));
        let points: Vec<(f64, &Row)> = shown.iter().map(|(_, row)| (at(row), *row)).collect();
        let range = range_of(points.iter().map(|(x, _)| *x));
        let moves = range[1] - range[0] > 1e-9;
        moves.then(|| distances(&points, quantity.axis(with_margin(range, 0.03)), to_mm))
    };
    let over_joints = (0..spec.variables.len()).filter_map(over_joint).collect();
    let lengths = |length: fn(&Row) -> f64| report.rows.iter().map(|row| length(row) * to_mm).collect();
    let lists = [
        NamedValues { values: lengths(|row| row.before.length), colour: BEFORE.0, name: BEFORE.1 },
        NamedValues { values: lengths(|row| row.after.length), colour: AFTER.0, name: AFTER.1 },
    ];
    let histogram = panel("distance", "mm", &lists);
    let changes = spec.variables.iter().enumerate().filter_map(|(joint, variable)| {
        let (factor, unit) = variable.kind.either((1e3, "mrad"), (to_mm, "mm"));
        let changes = report.rows.iter().filter_map(|row| Some(row.changes.get(joint)? * factor));
        let changes: Vec<f64> = changes.collect();
        let name = format!("change of {}", variable.name);
        (!changes.is_empty()).then(|| panel(&name, unit, &[NamedValues::new(changes, AFTER.0)]))
    });
    let scenes = [
        over_rows.captioned(&caption),
        Scene::new("Position error by joint", 3, over_joints).captioned(caption),
        Scene::new("Distribution of position errors", 1, vec![histogram]),
        Scene::new("Joint corrections", 3, changes.collect())
            .captioned("Corrected minus original commands, all rows."),
    ];
    scenes.into_iter().filter(|scene| !scene.panels.is_empty()).collect()
}

fn distances(shown: &[(f64, &Row)], x: Axis, to_mm: f64) -> Panel {
    let list = |length: fn(&Row) -> f64| {
        shown.iter().map(|(x, row)| [*x, (length(row) * to_mm).max(LEAST)]).collect::<Vec<_>>()
    };
    let lists = [(list(|row| row.before.length), BEFORE, 0.6), (list(|row| row.after.length), AFTER, 0.9)];
    let [least, most] = range_of(lists.iter().flat_map(|(places, ..)| places).map(|[_, distance]| *distance));
    let range = if least <= most { [least / 1.5, most * 1.5] } else { [LEAST, 1.0] };
    let y = Axis::linear("distance", "mm", range).scaled(Scale::Logarithmic);
    let radius = if shown.len() < 1000 { 2.0 } else { 1.5 };
    let marks = lists.map(|(places, (colour, name), opacity)| {
        Mark::points(colour, radius, places).faded(opacity).named(name)
    });
    Panel::plane(HEIGHT, x, y, marks.to_vec())
}
