//! The sheet that a figure is drawn on.

use std::io;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::FontTransform;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::rule::Rule;
use crate::axis::{Axis, FAINT, GREY, INK, Ticks};
use crate::figure::Named;
use abbe_study::analyze::Report;

/// Why a figure could not be drawn.
pub(crate) type Failed = DrawingAreaErrorKind<io::Error>;
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Panel<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Rule, Rule>>;

/// Coordinates are whole numbers: so many to a pixel, for smooth curves.
const FINE: i32 = 8;

/// Pixels.
pub(super) fn px(pixels: f64) -> i32 {
    (pixels * f64::from(FINE)).round() as i32
}

/// A colour.
pub(super) fn rgb((red, green, blue): (u8, u8, u8)) -> RGBColor {
    RGBColor(red, green, blue)
}

/// A line of this width in pixels.
pub(super) fn line(colour: (u8, u8, u8), width: f64) -> ShapeStyle {
    ShapeStyle { color: rgb(colour).to_rgba(), filled: false, stroke_width: px(width).unsigned_abs() }
}

/// Text of this size in pixels.
pub(super) fn text(size: f64, colour: (u8, u8, u8), horizontal: HPos, vertical: VPos) -> TextStyle<'static> {
    // The library writes fonts smaller than it is asked for.
    let font = ("Helvetica, Arial, sans-serif", 1.24 * f64::from(px(size))).into_font();
    let style = TextStyle::from(font).pos(Pos::new(horizontal, vertical));
    TextStyle { color: rgb(colour).to_backend_color(), ..style }
}

/// The size and the headings of a figure.
pub(super) struct Sheet {
    size: (u32, u32),
    title: String,
    subtitle: String,
    caption: String,
}

impl Sheet {
    /// How high the headings are, pixels.
    const HEAD: u32 = 56;

    pub(super) fn new(size: (u32, u32), figure: &Named, report: &Report, subtitle: &str) -> Self {
        let name = &report.spec.title;
        let paper = &figure.asked.paper;
        let paper = if paper.is_empty() {
            String::new()
        } else {
            format!(" · cf. {paper} of {}", report.publisher())
        };
        let subtitle = if subtitle.is_empty() { String::new() } else { format!(" · {subtitle}") };
        Self {
            size,
            title: figure.title.clone(),
            subtitle: format!("{name}{subtitle}{paper}"),
            caption: figure.asked.caption.clone(),
        }
    }

    /// A sheet of its own, that no study asks for.
    pub(super) fn titled(size: (u32, u32), title: &str, subtitle: &str, caption: &str) -> Self {
        let [title, subtitle, caption] = [title, subtitle, caption].map(str::to_owned);
        Self { size, title, subtitle, caption }
    }

    /// Draws below the headings.
    pub(super) fn draw(&self, picture: impl FnOnce(&Area) -> Result<(), Failed>) -> Result<String, Failed> {
        let (width, height) = (self.size.0, self.size.1 + Self::HEAD);
        let fine = FINE.unsigned_abs();
        let mut svg = String::new();
        {
            let root = SVGBackend::with_string(&mut svg, (width * fine, height * fine)).into_drawing_area();
            root.fill(&WHITE)?;
            let (head, body) = root.split_vertically(px(f64::from(Self::HEAD)));
            let title = text(17.0, INK, HPos::Left, VPos::Top);
            let title = TextStyle { font: title.font.style(FontStyle::Bold), ..title };
            head.draw(&Text::new(self.title.as_str(), (px(18.0), px(12.0)), title))?;
            let subtitle = text(12.0, GREY, HPos::Left, VPos::Top);
            head.draw(&Text::new(self.subtitle.as_str(), (px(18.0), px(35.0)), subtitle))?;
            picture(&body)?;
            root.present()?;
        }
        Ok(self.described(&svg))
    }

    /// The same at the size of a screen, with its title and caption for those who cannot see it.
    fn described(&self, svg: &str) -> String {
        let (width, height) = (self.size.0, self.size.1 + Self::HEAD);
        let fine = FINE.unsigned_abs();
        let (large_width, large_height) = (width * fine, height * fine);
        let large = format!("width=\"{large_width}\" height=\"{large_height}\"");
        let small = format!("width=\"{width}\" height=\"{height}\"");
        let svg = svg.replacen(&large, &small, 1);
        let escaped = |text: &str| text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
        let words =
            format!(">\n<title>{}</title>\n<desc>{}</desc>", escaped(&self.title), escaped(&self.caption));
        svg.replacen('>', &words, 1)
    }
}

/// One axis of a panel.
pub(super) struct Side<'a> {
    pub(super) axis: &'a Axis,
    pub(super) range: [f64; 2],
    /// About how many labels.
    pub(super) about: usize,
    /// Whether numbers and a title stand at it.
    pub(super) labelled: bool,
}

/// A panel with a grid, numbers and the titles of its axes, and so much room on the right.
pub(super) fn panel<'a>(area: &Area<'a>, x: &Side, y: &Side, right: f64) -> Result<Panel<'a>, Failed> {
    let (x_ticks, y_ticks) = (x.axis.ticks(x.range, x.about), y.axis.ticks(y.range, y.about));
    let mut chart = ChartBuilder::on(area)
        .set_label_area_size(LabelAreaPosition::Left, px(if y.labelled { 74.0 } else { 12.0 }))
        .set_label_area_size(LabelAreaPosition::Bottom, px(if x.labelled { 46.0 } else { 8.0 }))
        .margin_right(px(right))
        .margin_top(px(10.0))
        .build_cartesian_2d(
            Rule { range: x.range, labelled: x_ticks.values.clone() },
            Rule { range: y.range, labelled: y_ticks.values.clone() },
        )?;
    let small = text(11.0, GREY, HPos::Center, VPos::Center);
    let nothing = line(FAINT, 0.0);
    let label = |side: &Side, ticks: &Ticks, value: f64| {
        if side.labelled { ticks.label(value) } else { String::new() }
    };
    let x_label = |value: &f64| label(x, &x_ticks, *value);
    let y_label = |value: &f64| label(y, &y_ticks, *value);
    let mut mesh = chart.configure_mesh();
    mesh.bold_line_style(line(FAINT, 1.0))
        .light_line_style(nothing)
        .axis_style(line(GREY, 1.0))
        .label_style(small)
        .x_label_formatter(&x_label)
        .y_label_formatter(&y_label)
        .set_all_tick_mark_size(px(4.0));
    mesh.draw()?;
    let (width, height) = area.dim_in_pixel();
    let plot = chart.plotting_area().get_pixel_range();
    let base = area.get_base_pixel();
    if x.labelled {
        let middle = (plot.0.start + plot.0.end) / 2 - base.0;
        let style = text(12.0, INK, HPos::Center, VPos::Bottom);
        area.draw(&Text::new(x.axis.title(), (middle, height as i32 - px(8.0)), style))?;
    }
    if y.labelled {
        let middle = (plot.1.start + plot.1.end) / 2 - base.1;
        let style = text(12.0, INK, HPos::Center, VPos::Top).transform(FontTransform::Rotate270);
        area.draw(&Text::new(y.axis.title(), (px(12.0).min(width as i32), middle), style))?;
    }
    Ok(chart)
}
