//! Panel with two axes.

use super::canvas::{Anchor, Area, Canvas, Font, Pixel};
use super::shapes;
use super::ticks::{Tick, ticks};
use crate::scene::{Axis, Colour, Mark, Scale};

/// Height of a line of names below an axis.
const LINE: f64 = 14.0;

/// Panel to draw.
pub(super) struct Plane<'a> {
    pub(super) x: &'a Axis,
    pub(super) y: &'a Axis,
    pub(super) equal: bool,
    pub(super) marks: &'a [Mark<Pixel>],
}

impl Plane<'_> {
    fn y_ticks(y: &Axis, height: f64) -> Vec<Tick> {
        ticks(y, ((height / 30.0) as usize).clamp(2, 8))
    }

    fn x_ticks(x: &Axis, width: f64) -> Vec<Tick> {
        let each = if x.scale == Scale::Dates { 90.0 } else { 54.0 };
        ticks(x, ((width / each) as usize).clamp(2, 10))
    }

    /// Returns the width of tick labels and title left of the panel.
    pub(super) fn left(&self, height: f64) -> f64 {
        let labels = Self::y_ticks(self.y, height);
        let widest = labels.iter().map(|tick| Font::TICK.width(&tick.label)).fold(0.0, f64::max);
        if widest > 0.0 { widest + 34.0 } else { 12.0 }
    }

    /// Returns the height of tick labels and title below a panel of this width.
    pub(super) fn foot(&self, width: f64) -> f64 {
        match &self.x.scale {
            _ if !self.x.numbered => 10.0,
            Scale::Names(names) => {
                12.0 + LINE
                    * (self.name_lines(names, width).map(|lines| lines.len()).max().unwrap_or(0)) as f64
            }
            _ => 44.0,
        }
    }

    /// Wraps the names of the axis to the width of their bars.
    fn name_lines<'n>(&self, names: &'n [String], width: f64) -> impl Iterator<Item = Vec<String>> + use<'n> {
        let [from, to] = self.x.range;
        let letters = (width / (to - from) / Font::TICK.width("n")).max(8.0) as usize;
        names.iter().map(move |name| wrapped(name, letters))
    }

    /// Draws the panel with its axes around the area.
    pub(super) fn draw(&self, canvas: &mut Canvas, area: &Area) {
        let (x, y) = if self.equal { equal(self.x, self.y, area) } else { (self.x.clone(), self.y.clone()) };
        let across = |value: f64| area.left + area.width * x.share(value);
        let down = |value: f64| area.bottom() - area.height * y.share(value);
        let (x_ticks, y_ticks) = (Self::x_ticks(&x, area.width), Self::y_ticks(&y, area.height));
        if !matches!(x.scale, Scale::Names(_)) {
            for tick in &x_ticks {
                let at = across(tick.at);
                canvas.line([[at, area.top], [at, area.bottom()]], Colour::FAINT, 1.0);
            }
        }
        for tick in &y_ticks {
            let at = down(tick.at);
            canvas.line([[area.left, at], [area.right(), at]], Colour::FAINT, 1.0);
        }
        let zero = |axis: &Axis| axis.scale == Scale::Linear && axis.range[0] < 0.0 && axis.range[1] > 0.0;
        if zero(&y) {
            canvas.line([[area.left, down(0.0)], [area.right(), down(0.0)]], Colour::LINK, 1.0);
        }
        if self.equal && zero(&x) {
            canvas.line([[across(0.0), area.top], [across(0.0), area.bottom()]], Colour::LINK, 1.0);
        }
        for mark in self.marks {
            shapes::draw(canvas, &mark.map(|[x, y]| [across(x), down(y)]), area);
        }
        canvas.line([[area.left, area.bottom()], [area.right(), area.bottom()]], Colour::GREY, 1.0);
        canvas.line([[area.left, area.top], [area.left, area.bottom()]], Colour::GREY, 1.0);
        for tick in &y_ticks {
            let at = [area.left - 6.0, down(tick.at) + 4.0];
            canvas.text(at, &tick.label, Font::TICK, Anchor::End);
        }
        let middle = area.top + area.height / 2.0;
        canvas.upward_text([area.left - self.left(area.height) + 14.0, middle], &y.title(), Font::WORDS);
        if x.numbered {
            self.numbers(canvas, area, &x, &x_ticks);
        }
    }

    /// Draws the tick labels or names below the panel, and the title of the axis.
    fn numbers(&self, canvas: &mut Canvas, area: &Area, x: &Axis, ticks: &[Tick]) {
        let across = |value: f64| area.left + area.width * x.share(value);
        if let Scale::Names(names) = &x.scale {
            for (i, lines) in self.name_lines(names, area.width).enumerate() {
                for (row, line) in lines.iter().enumerate() {
                    let at = [across(i as f64), area.bottom() + 16.0 + LINE * row as f64];
                    canvas.text(at, line, Font { colour: Colour::INK, ..Font::TICK }, Anchor::Middle);
                }
            }
            return;
        }
        for tick in ticks {
            let half = Font::TICK.width(&tick.label) / 2.0;
            let at = across(tick.at).min(area.right() + 12.0 - half);
            canvas.text([at, area.bottom() + 16.0], &tick.label, Font::TICK, Anchor::Middle);
        }
        let middle = area.left + area.width / 2.0;
        canvas.text([middle, area.bottom() + 34.0], &x.title(), Font::WORDS, Anchor::Middle);
    }
}

/// Extends one of the axes so that both have the same scale.
fn equal(x: &Axis, y: &Axis, area: &Area) -> (Axis, Axis) {
    let span = |axis: &Axis| axis.range[1] - axis.range[0];
    let scale = (span(x) / area.width).max(span(y) / area.height);
    let longer = |axis: &Axis, pixels: f64| {
        let room = (scale * pixels - span(axis)) / 2.0;
        Axis { range: [axis.range[0] - room, axis.range[1] + room], ..axis.clone() }
    };
    (longer(x, area.width), longer(y, area.height))
}

/// Wraps a text to lines of at most `letters` letters. Line breaks are kept; longer words are not
/// split.
fn wrapped(name: &str, letters: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in name.lines() {
        lines.push(String::new());
        for word in part.split(' ') {
            match lines.last_mut() {
                Some(line) if line.is_empty() => word.clone_into(line),
                Some(line) if line.chars().count() + 1 + word.chars().count() <= letters => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.to_owned()),
            }
        }
    }
    lines
}
