//! A sheet with a parallel projection of space: SVG text.

use std::fmt::Write as _;

pub(crate) type Point = [f64; 3];

pub(crate) const INK: &str = "#1f2733";
pub(crate) const GREY: &str = "#6b7480";
pub(crate) const LINK: &str = "#c3c9d2";
pub(crate) const RED: &str = "#c22f2f";
/// Colors of the axes x, y and z.
pub(crate) const XYZ: [&str; 3] = ["#b3402a", "#2e7d46", "#2758a8"];

pub(crate) struct Sheet {
    size: [f64; 2],
    title: &'static str,
    right: Point,
    up: Point,
    scale: f64,
    /// Position of the origin of space on the sheet.
    origin: [f64; 2],
    body: String,
}

impl Sheet {
    /// Creates a sheet viewed from this azimuth and elevation, in degrees; z is up.
    pub(crate) fn new(title: &'static str, size: [f64; 2], [azimuth, elevation]: [f64; 2]) -> Self {
        let (sa, ca) = azimuth.to_radians().sin_cos();
        let (se, ce) = elevation.to_radians().sin_cos();
        // right × up points to the eye: right-handed frames look right-handed.
        let (right, up) = ([-sa, ca, 0.0], [-ca * se, -sa * se, ce]);
        Self { size, title, right, up, scale: 1.0, origin: [0.0; 2], body: String::new() }
    }

    /// Sets the pixels per unit of length, and the position of the origin.
    pub(crate) fn placed(mut self, scale: f64, origin: [f64; 2]) -> Self {
        (self.scale, self.origin) = (scale, origin);
        self
    }

    pub(crate) fn at(&self, point: Point) -> [f64; 2] {
        let along = |axis: &Point| axis.iter().zip(point).map(|(a, p)| a * p).sum::<f64>() * self.scale;
        [self.origin[0] + along(&self.right), self.origin[1] - along(&self.up)]
    }

    pub(crate) fn line(&mut self, points: &[Point], colour: &str, width: f64, dashed: bool) {
        let points: Vec<[f64; 2]> = points.iter().map(|point| self.at(*point)).collect();
        self.polyline(&points, colour, width, dashed);
    }

    fn polyline(&mut self, points: &[[f64; 2]], colour: &str, width: f64, dashed: bool) {
        let path: Vec<String> = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let dashes = if dashed { " stroke-dasharray=\"5 4\"" } else { "" };
        writeln!(
            self.body,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"{dashes}/>",
            path.join(" ")
        )
        .unwrap();
    }

    /// Draws a line through points with an arrowhead at its end.
    pub(crate) fn arrow(&mut self, points: &[Point], colour: &str, width: f64) {
        let mut points: Vec<[f64; 2]> = points.iter().map(|point| self.at(*point)).collect();
        let [.., before, tip] = points[..] else { return };
        let (dx, dy) = (tip[0] - before[0], tip[1] - before[1]);
        let length = dx.hypot(dy).max(1e-9);
        let (dx, dy) = (dx / length, dy / length);
        let (long, half) = (4.0 + 2.6 * width, 1.6 + 1.5 * width);
        let foot = [tip[0] - long * dx, tip[1] - long * dy];
        if let Some(last) = points.last_mut() {
            *last = foot;
        }
        self.polyline(&points, colour, width, false);
        let [left, right] = [half, -half].map(|h| [foot[0] - h * dy, foot[1] + h * dx]);
        writeln!(
            self.body,
            "<polygon points=\"{:.1},{:.1} {:.1},{:.1} {:.1},{:.1}\" fill=\"{colour}\"/>",
            tip[0], tip[1], left[0], left[1], right[0], right[1]
        )
        .unwrap();
    }

    pub(crate) fn dot(&mut self, point: Point, radius: f64, colour: &str) {
        let [x, y] = self.at(point);
        writeln!(self.body, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{colour}\"/>")
            .unwrap();
    }

    /// Writes text at an offset in pixels from a point.
    pub(crate) fn label(&mut self, point: Point, [dx, dy]: [f64; 2], text: &str, colour: &str) {
        let [x, y] = self.at(point);
        self.text([x + dx, y + dy], text, colour, 14.0);
    }

    /// Writes text at a position of the sheet, with a white outline for legibility.
    pub(crate) fn text(&mut self, [x, y]: [f64; 2], text: &str, colour: &str, size: f64) {
        writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" fill=\"{colour}\" stroke=\"#ffffff\" stroke-width=\"4\" stroke-linejoin=\"round\" paint-order=\"stroke\">{text}</text>"
        )
        .unwrap();
    }

    /// Draws the axes x, y, z of a frame, with their names.
    pub(crate) fn axes(&mut self, frame: &Frame, length: f64, named: bool) {
        for (axis, colour) in XYZ.into_iter().enumerate() {
            let tip = frame.point(axis, length);
            self.arrow(&[frame.origin, tip], colour, 2.0);
            if named {
                let [[x0, y0], [x1, y1]] = [self.at(frame.origin), self.at(tip)];
                let far = (x1 - x0).hypot(y1 - y0).max(1e-9);
                let [x, y] = [x1 + 11.0 * (x1 - x0) / far - 4.0, y1 + 11.0 * (y1 - y0) / far + 4.0];
                self.text([x, y], ["x", "y", "z"][axis], colour, 13.0);
            }
        }
        self.dot(frame.origin, 3.5, INK);
    }

    pub(crate) fn finish(self) -> String {
        let [width, height] = self.size;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"Helvetica, Arial, sans-serif\">\n<title>{}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.title, self.body
        )
    }
}

/// Frame in space; its axes are columns.
pub(crate) struct Frame {
    pub(crate) origin: Point,
    pub(crate) axes: [Point; 3],
}

impl Frame {
    /// Returns the point at a distance along one of its axes.
    pub(crate) fn point(&self, axis: usize, length: f64) -> Point {
        self.place(std::array::from_fn(|i| if i == axis { length } else { 0.0 }))
    }

    /// Converts a point given in the frame.
    pub(crate) fn place(&self, point: Point) -> Point {
        std::array::from_fn(|i| self.origin[i] + (0..3).map(|k| self.axes[k][i] * point[k]).sum::<f64>())
    }
}

/// Returns points on a circle about an axis of a frame: radius, height, and range of angles in
/// degrees.
pub(crate) fn arc(
    frame: &Frame,
    axis: usize,
    [radius, height]: [f64; 2],
    [from, to]: [f64; 2],
) -> Vec<Point> {
    let steps = 24;
    let point = |i: i32| {
        let (sin, cos) = (from + (to - from) * f64::from(i) / f64::from(steps)).to_radians().sin_cos();
        let mut place = [0.0; 3];
        place[axis] = height;
        place[(axis + 1) % 3] = radius * cos;
        place[(axis + 2) % 3] = radius * sin;
        frame.place(place)
    };
    (0..=steps).map(point).collect()
}
