//! Panel with three axes, in parallel projection.

use super::canvas::{Anchor, Area, Canvas, Font, Pixel};
use super::shapes;
use super::ticks::{Tick, ticks};
use crate::scene::{Axis, Colour, Mark};

/// Direction to the viewer in degrees: azimuth from the first horizontal axis to the second, and
/// elevation.
const AZIMUTH: f64 = 38.0;
const ELEVATION: f64 = 24.0;
/// Margins for tick labels: left, right, top and bottom.
const MARGINS: [f64; 4] = [62.0, 46.0, 22.0, 46.0];
/// Height of a box with independent scales, relative to its width.
const HEIGHT: f64 = 0.8;

/// Panel to draw.
pub(super) struct Space<'a> {
    pub(super) axes: &'a [Axis; 3],
    pub(super) up: usize,
    pub(super) equal: bool,
    pub(super) marks: &'a [Mark<[f64; 3]>],
}

/// Projection of the box, whose coordinates are from 0 to 1 along each axis.
struct Camera {
    /// Pixels to the right and down along each axis.
    axes: [Pixel; 3],
    origin: Pixel,
}

impl Camera {
    fn at(&self, share: [f64; 3]) -> Pixel {
        let along = |i: usize| (0..3).map(|axis| self.axes[axis][i] * share[axis]).sum::<f64>();
        [self.origin[0] + along(0), self.origin[1] + along(1)]
    }

    fn length(&self, axis: usize) -> f64 {
        self.axes[axis][0].hypot(self.axes[axis][1])
    }
}

impl Space<'_> {
    /// Returns the two horizontal axes, right-handed with the vertical axis.
    fn ground(&self) -> [usize; 2] {
        [(self.up + 1) % 3, (self.up + 2) % 3]
    }

    /// Computes the largest projection that fits the area.
    fn camera(&self, area: &Area) -> Camera {
        let [a, b] = self.ground();
        let (sin, cos) = AZIMUTH.to_radians().sin_cos();
        let (rise, flat) = ELEVATION.to_radians().sin_cos();
        let size = |axis: usize| match self.equal {
            true => self.axes[axis].range[1] - self.axes[axis].range[0],
            false if axis == self.up => HEIGHT,
            false => 1.0,
        };
        let mut axes = [[0.0; 2]; 3];
        axes[a] = [-sin, cos * rise].map(|unit| unit * size(a));
        axes[b] = [cos, sin * rise].map(|unit| unit * size(b));
        axes[self.up] = [0.0, -flat * size(self.up)];
        let spans = [0, 1].map(|i| axes.iter().map(|axis| axis[i].abs()).sum::<f64>());
        let [left, right, top, bottom] = MARGINS;
        let room = [area.width - left - right, area.height - top - bottom];
        let scale = (room[0] / spans[0]).min(room[1] / spans[1]);
        let axes = axes.map(|axis| axis.map(|unit| unit * scale));
        // Upper left corner of the projected box, centered in the available area.
        let least = [0, 1].map(|i| axes.iter().map(|axis| axis[i].min(0.0)).sum::<f64>());
        let corner = [area.left + left, area.top + top];
        let origin = [0, 1].map(|i| corner[i] + (room[i] - scale * spans[i]) / 2.0 - least[i]);
        Camera { axes, origin }
    }

    /// Draws the panel within the area.
    pub(super) fn draw(&self, canvas: &mut Canvas, area: &Area) {
        let camera = self.camera(area);
        let all: [Vec<Tick>; 3] = std::array::from_fn(|axis| {
            let each = if axis == self.up { 26.0 } else { 34.0 };
            ticks(&self.axes[axis], ((camera.length(axis) / each) as usize).clamp(1, 8))
        });
        self.walls(canvas, &camera, &all);
        self.numbers(canvas, &camera, &all, area);
        for mark in self.marks {
            let place =
                |point: [f64; 3]| camera.at(std::array::from_fn(|axis| self.axes[axis].share(point[axis])));
            shapes::draw(canvas, &mark.map(place), area);
        }
    }

    /// Draws the floor and the two back walls with their grids.
    fn walls(&self, canvas: &mut Canvas, camera: &Camera, all: &[Vec<Tick>; 3]) {
        let mut line = |axis: usize, share: f64, colour: Colour| {
            for wall in [(axis + 1) % 3, (axis + 2) % 3] {
                // Each axis spans two walls; the line is drawn on both.
                let end = |to: f64| {
                    let mut place = [0.0; 3];
                    place[axis] = share;
                    place[wall] = to;
                    camera.at(place)
                };
                canvas.line([end(0.0), end(1.0)], colour, 1.0);
            }
        };
        for (axis, ticks) in all.iter().enumerate() {
            ticks.iter().for_each(|tick| line(axis, self.axes[axis].share(tick.at), Colour::FAINT));
        }
        for axis in 0..3 {
            line(axis, 1.0, Colour::FAINT);
            line(axis, 0.0, Colour::LINK);
        }
    }

    /// Draws the three front edges with tick labels and titles.
    fn numbers(&self, canvas: &mut Canvas, camera: &Camera, all: &[Vec<Tick>; 3], area: &Area) {
        let [a, b] = self.ground();
        // Edges: the first horizontal axis at the lower right, the second at the lower left, the
        // vertical axis at the left.
        for (axis, beside, [dx, dy], anchor) in [
            (a, b, [7.0, 13.0], Anchor::Start),
            (b, a, [-7.0, 13.0], Anchor::End),
            (self.up, a, [-8.0, 4.0], Anchor::End),
        ] {
            let at = |share: f64| {
                let mut place = [0.0; 3];
                place[beside] = 1.0;
                place[axis] = share;
                camera.at(place)
            };
            canvas.line([at(0.0), at(1.0)], Colour::GREY, 1.0);
            for tick in &all[axis] {
                let [x, y] = at(self.axes[axis].share(tick.at));
                canvas.text([x + dx, y + dy], &tick.label, Font::TICK, anchor);
            }
            let title = self.axes[axis].title();
            if axis == self.up {
                let [x, y] = at(1.0);
                canvas.text(
                    [x.max(area.left + Font::WORDS.width(&title) / 2.0), y - 10.0],
                    &title,
                    Font::WORDS,
                    Anchor::Middle,
                );
                continue;
            }
            let [x, y] = at(0.5);
            let width = Font::WORDS.width(&title);
            let x = match anchor {
                Anchor::Start => (x + 16.0).min(area.right() - width),
                _ => (x - 16.0).max(area.left + width),
            };
            canvas.text([x, y + 34.0], &title, Font::WORDS, anchor);
        }
    }
}
