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
mod tests;
