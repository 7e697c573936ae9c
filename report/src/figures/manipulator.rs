//! Manipulator as a stick figure with its frames, at home.

use abbe::analysis::sampling::range_of;
use abbe_study::{analyze::Report, analyze::figures::Stick};

use crate::scene::{Axis, Colour, Mark, Panel, Scene, Shape, View};

/// Length of the axes of a frame, and smallest side of the box, as fractions of its longest side.
const AXIS: f64 = 0.11;
const LEAST: f64 = 0.3;

pub(super) fn scene(stick: &Stick, up: usize, report: &Report) -> Scene {
    let Stick { origins, links, size } = stick;
    let points = origins.iter().map(|place| place.origin).collect::<Vec<_>>();
    let mut marks = vec![match &links[..] {
        [line] => Mark::line(Colour::LINK, 7.0, line.clone()),
        lines => Mark::lines(Colour::LINK, 7.0, lines.to_vec()),
    }];
    let mut tips = Vec::new();
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let arrow = |place: &abbe_study::analyze::figures::FrameOrigin| {
            let tip = std::array::from_fn(|i| place.origin[i] + AXIS * size * place.axes[axis][i]);
            vec![place.origin, tip]
        };
        let arrows = origins.iter().map(arrow).collect::<Vec<_>>();
        tips.extend(arrows.iter().flatten().copied());
        marks.push(Mark::lines(Colour::XYZ[axis], 2.2, arrows).named(format!("{name} axes of the frames")));
    }
    marks.push(Mark::points(Colour::INK, 4.0, points));
    let texts = origins.iter().map(|place| (place.origin, place.label.clone())).collect();
    marks.push(Mark::new(Colour::INK, Shape::Texts { texts }));
    let axes = [0, 1, 2].map(|axis| {
        let [least, most] = range_of(tips.iter().map(|tip| tip[axis]));
        let room = (0.06 * size).max((LEAST * size - (most - least)) / 2.0);
        Axis::linear(["x", "y", "z"][axis], report.spec.length.symbol(), [least - room, most + room])
    });
    let panels = vec![Panel::new(560.0, View::Space { axes, up, equal: true, marks })];
    Scene { subtitle: "Links are straight lines between origins".to_owned(), ..Scene::new("", 1, panels) }
}
