//! Errors over the travel of one variable: one panel per axis, with the same scale.

use abbe_study::analyze::Report;
use abbe_study::analyze::figures::{Envelope, Merge, Range};
use abbe_study::study_file::Over;

use super::{NamedFigure, Quantity};
use crate::scene::{Axis, Colour, Mark, Panel, Scene, Shape, with_margin};

pub(super) fn scene(envelope: &Envelope, over: Over, figure: &NamedFigure, report: &Report) -> Scene {
    let travel = Quantity::over(over, &report.spec);
    let errors = figure.errors(report);
    let bins = envelope.0.iter().map(|(_, bin)| bin).collect::<Vec<_>>();
    let mut spans = [Range::default(); 3];
    let mut travelled = Range::default();
    for bin in &bins {
        travelled.merge(bin.travel);
        spans.iter_mut().zip(bin.errors).for_each(|(span, errors)| span.merge(errors));
    }
    let printed: [_; 3] = std::array::from_fn(|axis| figure.published_range(axis, spans[axis], report));
    let mut all = Range { least: 0.0, largest: 0.0 };
    spans.into_iter().chain(printed.iter().flatten().map(|printed| printed.range)).for_each(|r| all.merge(r));
    let range = with_margin([all.least, all.largest].map(|error| errors.show(error)), 0.12);
    let across = with_margin([travelled.least, travelled.largest].map(|value| travel.show(value)), 0.02);

    let panels = printed.iter().enumerate().map(|(axis, printed)| {
        let edge = |end: fn(Range) -> f64| {
            let place = bins.iter().map(|bin| [bin.travel.middle(), end(bin.errors[axis])]);
            place.map(|[at, error]| [travel.show(at), errors.show(error)]).collect::<Vec<_>>()
        };
        let (lower, upper) = (edge(|range| range.least), edge(|range| range.largest));
        let colour = Colour::XYZ[axis];
        let mut marks = vec![
            Mark::new(colour, Shape::Band { lower: lower.clone(), upper: upper.clone() }).faded(0.22),
            Mark::lines(colour, 1.6, vec![lower, upper]),
        ];
        let mut published = String::new();
        if let Some(printed) = printed {
            let ends = [printed.range.least, printed.range.largest].map(|end| errors.show(end));
            let line = |end: f64| across.map(|at| [at, end]).to_vec();
            marks.push(Mark::dashed(Colour::PUBLISHED, ends.map(line).to_vec()));
            published = format!("dashed: {}", printed.label);
        }
        let y = errors.named(format!("{} {}", figure.rows(report)[axis], figure.what())).axis(range);
        let x = Axis { numbered: axis == 2, ..travel.axis(across) };
        Panel { published, ..Panel::plane(150.0, x, y, marks) }
    });
    let subtitle =
        format!("Smallest and largest {} over all other variables{}", figure.what(), figure.remark());
    Scene { subtitle, ..Scene::new("", 1, panels.collect()) }
}
