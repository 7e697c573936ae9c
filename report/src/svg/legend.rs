//! Legend below a figure.

use super::{Anchor, Area, Canvas, Font, WIDTH, shapes};
use crate::scene::{Mark, Panel, Shape, View};

/// Height of a row.
const ROW: f64 = 20.0;
/// Width of a sample, gap after it, gap after each name, and left margin.
const SAMPLE: f64 = 18.0;
const GAP: f64 = 6.0;
const NAME_GAP: f64 = 22.0;
const LEFT: f64 = 18.0;

/// Returns one sample per name, in the unit square.
fn named(panels: &[Panel]) -> Vec<Mark<[f64; 2]>> {
    fn add<P: Copy>(found: &mut Vec<Mark<[f64; 2]>>, marks: &[Mark<P>]) {
        for mark in marks.iter().filter(|mark| !mark.name.is_empty()) {
            if found.iter().all(|other| other.name != mark.name) {
                found.push(sample(mark));
            }
        }
    }
    let mut found = Vec::new();
    for panel in panels {
        match &panel.view {
            View::Plane { marks, .. } => add(&mut found, marks),
            View::Space { marks, .. } => add(&mut found, marks),
        }
    }
    found
}

/// Returns a sample of a mark between (0, 0) and (1, 1).
fn sample<P: Copy>(mark: &Mark<P>) -> Mark<[f64; 2]> {
    let (middle, ends) = ([0.5, 0.5], [[0.0, 0.5], [1.0, 0.5]]);
    let shape = match &mark.shape {
        Shape::Lines { width, dashed, .. } => {
            Shape::Lines { lines: vec![ends.to_vec()], width: *width, dashed: *dashed }
        }
        Shape::Points { radius, .. } => Shape::Points { points: vec![middle], radius: radius.max(2.5) },
        Shape::Crosses { .. } => Shape::Crosses { points: vec![middle] },
        _ => Shape::Bars { bars: vec![[[0.0, 0.1], [1.0, 0.9]]] },
    };
    Mark { name: mark.name.clone(), colour: mark.colour, opacity: mark.opacity, shape }
}

/// Returns the position of every entry, and the number of rows.
fn places(marks: &[Mark<[f64; 2]>]) -> (Vec<[f64; 2]>, usize) {
    let (mut left, mut row) = (LEFT, 0);
    let place = |mark: &Mark<[f64; 2]>| {
        let width = SAMPLE + GAP + Font::WORDS.width(&mark.name);
        if left > LEFT && left + width > WIDTH - LEFT {
            (left, row) = (LEFT, row + 1);
        }
        let place = [left, ROW * f64::from(row)];
        left += width + NAME_GAP;
        place
    };
    (marks.iter().map(place).collect(), if marks.is_empty() { 0 } else { row as usize + 1 })
}

/// Returns the height of the legend; 0 for a figure without names.
pub(super) fn height(panels: &[Panel]) -> f64 {
    match places(&named(panels)).1 {
        0 => 0.0,
        rows => ROW * rows as f64 + 8.0,
    }
}

/// Draws the legend below `top`.
pub(super) fn draw(canvas: &mut Canvas, panels: &[Panel], top: f64) {
    let marks = named(panels);
    for (mark, [left, down]) in marks.iter().zip(places(&marks).0) {
        let area = Area { left, top: top + down + 3.0, width: SAMPLE, height: 13.0 };
        let place = |[x, y]: [f64; 2]| [area.left + x * area.width, area.top + y * area.height];
        let name = std::mem::take(&mut mark.map(place).name);
        shapes::draw(canvas, &mark.map(place).named(""), &area);
        canvas.text([area.right() + GAP, area.bottom() - 2.5], &name, Font::WORDS, Anchor::Start);
    }
}
