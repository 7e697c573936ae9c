//! Tests of `svg`.

use super::{embedded, file};
use crate::scene::{Axis, Colour, Corner, Mark, Panel, Scene, View};

fn axis(name: &str, range: [f64; 2]) -> Axis {
    Axis::linear(name, "mm", range)
}

/// Parses the coordinates of the first path of a colour.
fn places(svg: &str, colour: Colour) -> Vec<[f64; 2]> {
    let is_its = |line: &&str| line.contains(&format!("stroke=\"{}\"", colour.css()));
    let line = svg.lines().find(is_its).expect("a path");
    let d = line.split('"').nth(1).expect("its places");
    let pairs = d.split(['M', 'L']).filter(|pair| !pair.is_empty());
    let place =
        |pair: &str| pair.split(' ').map(|number| number.parse().expect("a number")).collect::<Vec<f64>>();
    pairs.map(place).map(|pair| [pair[0], pair[1]]).collect()
}

#[test]
fn a_figure_is_told_to_those_who_cannot_see_it() {
    let marks = vec![Mark::bars(Colour::BAR, vec![[[0.0, 0.0], [1.0, 3.0]]]).named("a < b")];
    let panel = Panel::plane(100.0, axis("d", [0.0, 1.0]), Axis::linear("count", "", [0.0, 4.0]), marks);
    let scene = Scene::new("A & B", 1, vec![panel]).captioned("Bars.");
    let page = embedded(&scene);
    assert!(page.starts_with("<svg width=\"960\"") && page.contains("role=\"img\""), "{page}");
    assert!(
        page.contains(
            "<title>A &amp; B</title>\n<desc>Bars. count from 0 to 4 over d from 0 to 1 mm.</desc>"
        )
    );
    assert!(page.contains(">a &lt; b</text>"), "the legend: {page}");
    assert!(!page.contains(">A &amp; B</text>") && file(&scene).contains(">A &amp; B</text>"));
}

#[test]
fn equal_axes_have_one_scale() {
    let square = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let marks = vec![Mark::line(Colour::BAR, 1.0, square)];
    let panel = Panel::new(
        90.0,
        View::Plane { x: axis("x", [-1.0, 1.0]), y: axis("y", [-1.0, 1.0]), equal: true, marks },
    );
    let svg = embedded(&Scene::new("", 1, vec![panel]));
    let [a, b, c, _] = places(&svg, Colour::BAR)[..] else { panic!("{svg}") };
    assert!((b[0] - a[0] - 90.0).abs() < 0.2 && (b[1] - c[1] - 90.0).abs() < 0.2, "{a:?} {b:?} {c:?}");
}

/// The projection is right-handed: x to the lower left, y to the lower right, z up.
#[test]
fn axes_in_space_are_right_handed() {
    let axes = ["x", "y", "z"].map(|name| axis(name, [0.0, 1.0]));
    let ends = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let lines = ends.map(|end| vec![[0.0; 3], end]).to_vec();
    let corners = vec![vec![Some(Corner { at: [0.0; 3], value: 0.0 }); 2]; 2];
    let marks = vec![Mark::surface(corners, [0.0, 1.0]), Mark::lines(Colour::BAR, 1.0, lines)];
    let svg = embedded(&Scene::new(
        "",
        1,
        vec![Panel::new(300.0, View::Space { axes, up: 2, equal: true, marks })],
    ));
    let [from, x, _, y, _, z] = places(&svg, Colour::BAR)[..] else { panic!("{svg}") };
    assert!(x[0] < from[0] && x[1] > from[1], "{x:?}");
    assert!(y[0] > from[0] && y[1] > from[1], "{y:?}");
    assert!(z[0] == from[0] && z[1] < from[1], "{z:?}");
    assert_eq!(svg.matches(&format!("fill=\"{}\"", Colour::graded(0.0).css())).count(), 1);
}
