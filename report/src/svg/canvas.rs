//! SVG elements one after another, in pixels.

use std::fmt::Write as _;

use crate::markup::escaped;
use crate::scene::Colour;

/// A place: pixels to the right and downwards.
pub(super) type Pixel = [f64; 2];

/// A part of the sheet.
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

/// The side of a text that stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// The size and the colour of a text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Font {
    pub(super) size: f64,
    pub(super) colour: Colour,
    pub(super) bold: bool,
}

impl Font {
    /// The title of a figure.
    pub(super) const TITLE: Self = Self { size: 17.0, colour: Colour::INK, bold: true };
    /// The title of a panel.
    pub(super) const HEAD: Self = Self { size: 13.0, colour: Colour::INK, bold: true };
    /// The name of an axis, and words in a figure.
    pub(super) const WORDS: Self = Self { size: 12.5, colour: Colour::INK, bold: false };
    /// What is said beside the title.
    pub(super) const ASIDE: Self = Self { size: 12.5, colour: Colour::GREY, bold: false };
    /// The numbers of an axis.
    pub(super) const TICK: Self = Self { size: 11.5, colour: Colour::GREY, bold: false };
    /// What is published.
    pub(super) const PUBLISHED: Self = Self { size: 12.5, colour: Colour::PUBLISHED, bold: false };

    /// About how wide a text is: SVG does not tell.
    pub(super) fn width(&self, text: &str) -> f64 {
        let wide = if self.bold { 0.6 } else { 0.55 };
        wide * self.size * text.chars().count() as f64
    }
}

/// What is drawn so far.
#[derive(Default)]
pub(super) struct Canvas {
    elements: String,
}

/// A number of pixels, to a tenth.
pub(super) fn px(pixels: f64) -> String {
    let text = format!("{pixels:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// `M` and `L` through places.
pub(super) fn path(points: &[Pixel]) -> String {
    let mut text = String::new();
    for (i, [x, y]) in points.iter().enumerate() {
        text += &format!("{}{} {}", if i == 0 { "M" } else { "L" }, px(*x), px(*y));
    }
    // A single point is seen as a dot.
    if points.len() == 1 { text + "h0" } else { text }
}

impl Canvas {
    /// A path with attributes, and what it shows, if that has a name.
    pub(super) fn path(&mut self, d: &str, attributes: &str, name: &str) {
        let name = if name.is_empty() { String::new() } else { format!("<title>{}</title>", escaped(name)) };
        let end = if name.is_empty() { "/>".to_owned() } else { format!(">{name}</path>") };
        writeln!(self.elements, "<path d=\"{d}\" {attributes}{end}").expect("a text takes all");
    }

    /// A straight line.
    pub(super) fn line(&mut self, ends: [Pixel; 2], colour: Colour, width: f64) {
        let attributes = format!("stroke=\"{}\" stroke-width=\"{width}\"", colour.css());
        self.path(&path(&ends), &attributes, "");
    }

    /// A text whose baseline is at a place.
    pub(super) fn text(&mut self, at: Pixel, text: &str, font: Font, anchor: Anchor) {
        self.word(at, text, font, anchor, "");
    }

    /// A text that is read upwards.
    pub(super) fn upward_text(&mut self, at: Pixel, text: &str, font: Font) {
        let turn = format!(" transform=\"rotate(-90 {} {})\"", px(at[0]), px(at[1]));
        self.word(at, text, font, Anchor::Middle, &turn);
    }

    /// A text that can be read where a line passes behind it.
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
