//! Renderer of scenes as SVG.
//!
//! A sheet has a heading, rows of panels and a legend. `plane` and `space` draw the axes of a panel
//! and project its marks to pixels, `shapes` draws marks, `ticks` chooses tick positions, and
//! `legend` draws the legend.

mod canvas;
mod legend;
mod plane;
mod shapes;
mod space;
mod ticks;

use canvas::{Anchor, Area, Canvas, Font, WIDTH, px};
use plane::Plane;
use space::Space;

use crate::markup::escaped;
use crate::scene::{Panel, Scene, View};

/// Height of the heading.
const HEAD: f64 = 56.0;
/// Gap between panels, and margin to the right of each.
const GAP: f64 = 10.0;
const RIGHT: f64 = 14.0;

/// Renders a figure as a file with a heading.
pub(crate) fn file(scene: &Scene) -> String {
    let mut canvas = Canvas::default();
    canvas.text([18.0, 26.0], &scene.title, Font::TITLE, Anchor::Start);
    canvas.text([18.0, 45.0], &scene.heading(), Font::ASIDE, Anchor::Start);
    sheet(canvas, scene, HEAD, " xmlns=\"http://www.w3.org/2000/svg\"")
}

/// Renders a figure for a page that has the heading itself.
pub(crate) fn embedded(scene: &Scene) -> String {
    sheet(Canvas::default(), scene, 4.0, "")
}

fn sheet(mut canvas: Canvas, scene: &Scene, top: f64, namespace: &str) -> String {
    let mut bottom = top;
    for row in scene.panels.chunks(scene.columns.max(1)) {
        bottom = panels(&mut canvas, row, scene.columns.max(1), bottom);
    }
    legend::draw(&mut canvas, &scene.panels, bottom);
    bottom += legend::height(&scene.panels) + 2.0;
    format!(
        "<svg{namespace} width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         font-family=\"Helvetica, Arial, sans-serif\">\n<title>{}</title>\n<desc>{}</desc>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{}</svg>\n",
        escaped(&scene.title),
        escaped(&scene.alternative()),
        canvas.finish(),
        width = px(WIDTH),
        height = px(bottom),
    )
}

/// Draws a row of panels and returns its lower end.
fn panels(canvas: &mut Canvas, row: &[Panel], columns: usize, top: f64) -> f64 {
    let width = (WIDTH - GAP) / columns as f64;
    let any = |has: fn(&Panel) -> bool| if row.iter().any(has) { 19.0 } else { 0.0 };
    let (title, published) = (any(|panel| !panel.title.is_empty()), any(|panel| !panel.published.is_empty()));
    let most = |number: &dyn Fn(&Panel) -> f64| row.iter().map(number).fold(0.0, f64::max);
    let left = most(&|panel| match &panel.view {
        View::Plane { x, y, equal, marks } => Plane { x, y, equal: *equal, marks }.left(panel.height),
        View::Space { .. } => 0.0,
    });
    let height = most(&|panel| panel.height);
    let inner = width - left - RIGHT;
    let foot = most(&|panel| match &panel.view {
        View::Plane { x, y, equal, marks } => Plane { x, y, equal: *equal, marks }.foot(inner),
        View::Space { .. } => 0.0,
    });
    let inner_top = top + 8.0 + title + published;
    for (i, panel) in row.iter().enumerate() {
        let outer = GAP / 2.0 + width * i as f64;
        let begin = outer + left.max(14.0);
        canvas.text([begin, top + 18.0], &panel.title, Font::HEAD, Anchor::Start);
        canvas.text([begin, top + title + 18.0], &panel.published, Font::PUBLISHED, Anchor::Start);
        match &panel.view {
            View::Plane { x, y, equal, marks } => {
                let area = Area { left: outer + left, top: inner_top, width: inner, height };
                Plane { x, y, equal: *equal, marks }.draw(canvas, &area);
            }
            View::Space { axes, up, equal, marks } => {
                let area = Area { left: outer, top: inner_top, width, height };
                Space { axes, up: *up, equal: *equal, marks }.draw(canvas, &area);
            }
        }
    }
    inner_top + height + foot
}

#[cfg(test)]
mod tests {
    use super::{embedded, file};
    use crate::scene::{Axis, Colour, Corner, Mark, Panel, Scene};

    fn axis(name: &str, range: [f64; 2]) -> Axis {
        Axis::linear(name, "mm", range)
    }

    /// Parses the coordinates of the first path of a colour.
    fn places(svg: &str, colour: Colour) -> Vec<[f64; 2]> {
        let is_its = |line: &&str| line.contains(&format!("stroke=\"{}\"", colour.css()));
        let line = svg.lines().find(is_its).expect("a path");
        let d = line.split('"').nth(1).expect("its places");
        let pairs = d.split(['M', 'L']).filter(|pair| !pair.is_empty());
        let place = |pair: &str| {
            pair.split(' ').map(|number| number.parse().expect("a number")).collect::<Vec<f64>>()
        };
        pairs.map(place).map(|pair| [pair[0], pair[1]]).collect()
    }

    #[test]
    fn a_figure_is_told_to_those_who_cannot_see_it() {
        let marks = vec![Mark::bars(Colour::BAR, vec![[[0.0, 0.0], [1.0, 3.0]]]).named("a < b")];
        let panel = Panel::plane(100.0, axis("d", [0.0, 1.0]), Axis::linear("count", "", [0.0, 4.0]), marks);
        let scene = Scene::new("A & B", 1, vec![panel]).captioned("Bars.");
        let page = embedded(&scene);
        assert!(page.starts_with("<svg width=\"960\"") && page.contains("role=\"img\""), "{page}");
        assert!(page.contains(
            "<title>A &amp; B</title>\n<desc>Bars. count from 0 to 4 over d from 0 to 1 mm.</desc>"
        ));
        assert!(page.contains(">a &lt; b</text>"), "the legend: {page}");
        assert!(!page.contains(">A &amp; B</text>") && file(&scene).contains(">A &amp; B</text>"));
    }

    #[test]
    fn equal_axes_have_one_scale() {
        let square = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let marks = vec![Mark::line(Colour::BAR, 1.0, square)];
        let panel = Panel::equal_plane(90.0, axis("x", [-1.0, 1.0]), axis("y", [-1.0, 1.0]), marks);
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
        let svg = embedded(&Scene::new("", 1, vec![Panel::equal_space(300.0, axes, 2, marks)]));
        let [from, x, _, y, _, z] = places(&svg, Colour::BAR)[..] else { panic!("{svg}") };
        assert!(x[0] < from[0] && x[1] > from[1], "{x:?}");
        assert!(y[0] > from[0] && y[1] > from[1], "{y:?}");
        assert!(z[0] == from[0] && z[1] < from[1], "{z:?}");
        assert_eq!(svg.matches(&format!("fill=\"{}\"", Colour::graded(0.0).css())).count(), 1);
    }
}
