//! Writer of SVG elements, in pixels.

use std::fmt::Write as _;

use crate::{markup::escaped, scene::Colour};

/// Position in pixels, to the right and down.
pub(super) type Pixel = [f64; 2];

/// Width of every figure, in pixels.
pub(super) const WIDTH: f64 = 960.0;

/// Rectangle of the sheet, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Area {
    pub(super) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height
    }
}

/// Alignment of a text relative to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Size and colour of a text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Font {
    pub(super) size: f64,
    pub(super) colour: Colour,
    pub(super) bold: bool,
}

impl Font {
    /// Title of a figure.
    pub(super) const TITLE: Self = Self { size: 17.0, colour: Colour::INK, bold: true };
    /// Title of a panel.
    pub(super) const HEAD: Self = Self { size: 13.0, colour: Colour::INK, bold: true };
    /// Title of an axis, legend and labels.
    pub(super) const WORDS: Self = Self { size: 12.5, colour: Colour::INK, bold: false };
    /// Second line of the heading.
    pub(super) const ASIDE: Self = Self { size: 12.5, colour: Colour::GREY, bold: false };
    /// Tick labels.
    pub(super) const TICK: Self = Self { size: 11.5, colour: Colour::GREY, bold: false };
    /// Published values.
    pub(super) const PUBLISHED: Self = Self { size: 12.5, colour: Colour::PUBLISHED, bold: false };

    /// Estimates the width of a text, which SVG does not provide.
    pub(super) fn width(&self, text: &str) -> f64 {
        let wide = if self.bold { 0.6 } else { 0.55 };
        wide * self.size * text.chars().count() as f64
    }
}

/// SVG elements written so far.
#[derive(Default)]
pub(super) struct Canvas {
    elements: String,
}

/// Formats a number of pixels to a tenth.
pub(super) fn px(pixels: f64) -> String {
    let text = format!("{pixels:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Formats the path of a polyline.
pub(super) fn path(points: &[Pixel]) -> String {
    let mut text = String::new();
    for (i, [x, y]) in points.iter().enumerate() {
        text += &format!("{}{} {}", if i == 0 { "M" } else { "L" }, px(*x), px(*y));
    }
    // A round cap makes a single point visible as a dot.
    if points.len() == 1 { text + "h0" } else { text }
}

impl Canvas {
    /// Adds a path; a name becomes its `<title>`.
    pub(super) fn path(&mut self, d: &str, attributes: &str, name: &str) {
        let name = if name.is_empty() { String::new() } else { format!("<title>{}</title>", escaped(name)) };
        let end = if name.is_empty() { "/>".to_owned() } else { format!(">{name}</path>") };
        writeln!(self.elements, "<path d=\"{d}\" {attributes}{end}").expect("a text takes all");
    }

    /// Adds a straight line.
    pub(super) fn line(&mut self, ends: [Pixel; 2], colour: Colour, width: f64) {
        self.path(&path(&ends), &format!("stroke=\"{}\" stroke-width=\"{width}\"", colour.css()), "");
    }

    /// Adds a text with its baseline at a position.
    pub(super) fn text(&mut self, at: Pixel, text: &str, font: Font, anchor: Anchor) {
        self.word(at, text, font, anchor, "");
    }

    /// Adds a text rotated by 90° to read upwards.
    pub(super) fn upward_text(&mut self, at: Pixel, text: &str, font: Font) {
        let turn = format!(" transform=\"rotate(-90 {} {})\"", px(at[0]), px(at[1]));
        self.word(at, text, font, Anchor::Middle, &turn);
    }

    /// Adds a text with a white halo, legible on top of lines.
    pub(super) fn haloed_text(&mut self, at: Pixel, text: &str, font: Font, anchor: Anchor) {
        let halo = " stroke=\"#fff\" stroke-width=\"3.5\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
        self.word(at, text, font, anchor, halo);
    }

    fn word(&mut self, [x, y]: Pixel, text: &str, font: Font, anchor: Anchor, more: &str) {
        if text.is_empty() {
            return;
        }
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let bold = if font.bold { " font-weight=\"bold\"" } else { "" };
        writeln!(
            self.elements,
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{}\"{anchor}{bold}{more}>{}</text>",
            px(x),
            px(y),
            font.size,
            font.colour.css(),
            escaped(text)
        )
        .expect("a text takes all");
    }

    pub(super) fn finish(self) -> String {
        self.elements
    }
}
