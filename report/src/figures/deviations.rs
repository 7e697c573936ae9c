//! Figures of a positioning or circular test: mean deviations over the positions, with two standard
//! deviations.

use abbe::analysis::sampling::range_of;
use abbe_metrology::positioning::{ApproachResult, PositionResult, Report};

use crate::scene::{Axis, Colour, Mark, Panel, Scene, with_margin};

/// Directions: name, colour, and their results at a position.
type Direction = (&'static str, Colour, fn(&PositionResult) -> Option<ApproachResult>);

const DIRECTIONS: [Direction; 2] =
    [("from below", Colour::XYZ[2], |one| one.forward), ("from above", Colour::XYZ[0], |one| one.reverse)];

/// Builds a panel for the axis, or for each diagonal.
pub(crate) fn scenes(report: &Report) -> Vec<Scene> {
    let panel = |positions: &[PositionResult], name: &str| {
        let mut marks = Vec::new();
        for (k, (name, colour, approach)) in DIRECTIONS.into_iter().enumerate() {
            let name = report.circle.as_ref().map_or(name, |_| ["counterclockwise", "clockwise"][k]);
            let at = |shift: f64| -> Vec<[f64; 2]> {
                let shifted = |one: &PositionResult| {
                    let own = approach(one)?;
                    Some([one.position, own.mean + shift * own.standard_deviation.unwrap_or_default()])
                };
                positions.iter().filter_map(shifted).collect()
            };
            if !at(0.0).is_empty() {
                marks.push(Mark::dashed(colour, vec![at(2.0), at(-2.0)]));
                marks.push(Mark::line(colour, 2.0, at(0.0)).named(name));
            }
        }
        let values = marks.iter().flat_map(|mark| mark.places()).map(|[_, value]| value);
        let y = Axis::linear("deviation", report.unit, with_margin(range_of(values), 0.06));
        let range = range_of(positions.iter().map(|one| one.position));
        let along = if report.circle.is_some() { "angle" } else { "position" };
        let x = Axis::linear(along, report.position_unit, with_margin(range, 0.02));
        Panel::plane(280.0, x, y, marks).titled(name.to_owned())
    };
    let panels = report.lines.iter().map(|line| panel(&line.evaluation.positions, &line.name)).collect();
    let caption = "Lines: mean deviation of the approaches; dashed: two standard deviations beside it.";
    vec![Scene::new("Deviations", report.lines.len().min(2), panels).captioned(caption)]
}
