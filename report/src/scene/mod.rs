//! Figures as plain data: panels with axes and marks, in the units of display.
//!
//! `figures` builds scenes from reports, `svg` renders them, and Python returns them as dicts.
//!
//! Colours of figures.

mod axis;
mod mark;

pub(crate) use axis::with_margin;
pub use axis::{Axis, Scale};
pub use mark::{Corner, Mark, Shape};

use serde::{Serialize, Serializer};

/// Figure with its title, caption and panels.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Scene {
    /// Title.
    pub title: String,
    /// Title of the manipulator, for a figure outside its report.
    pub manipulator: String,
    /// Short description of the content.
    pub subtitle: String,
    /// Reference to the corresponding published figure; may be empty.
    pub reference: String,
    /// Caption.
    pub caption: String,
    /// Number of panels per row.
    pub columns: usize,
    /// Panels, row by row.
    pub panels: Vec<Panel>,
}

/// Coordinate system with its marks.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panel {
    /// Title above the panel.
    pub title: String,
    /// Published value for comparison; may be empty.
    pub published: String,
    /// Height between the axes, in pixels.
    pub height: f64,
    /// Axes and marks.
    #[serde(flatten)]
    pub view: View,
}

/// Plane, or space in a parallel projection.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "view", rename_all = "lowercase")]
pub enum View {
    /// Two axes.
    Plane {
        /// Horizontal axis.
        x: Axis,
        /// Vertical axis.
        y: Axis,
        /// True if both axes have the same scale.
        equal: bool,
        /// Marks from back to front.
        marks: Vec<Mark<[f64; 2]>>,
    },
    /// Three axes.
    Space {
        /// Axes x, y and z.
        axes: [Axis; 3],
        /// Index of the vertical axis.
        up: usize,
        /// True if all axes have the same scale.
        equal: bool,
        /// Marks from back to front.
        marks: Vec<Mark<[f64; 3]>>,
    },
}

impl Panel {
    /// Creates a panel without a title.
    pub(crate) fn new(height: f64, view: View) -> Self {
        Self { title: String::new(), published: String::new(), height, view }
    }

    /// Creates a panel with two axes.
    pub(crate) fn plane(height: f64, x: Axis, y: Axis, marks: Vec<Mark<[f64; 2]>>) -> Self {
        Self::new(height, View::Plane { x, y, equal: false, marks })
    }

    /// Sets the title.
    pub(crate) fn titled(self, title: String) -> Self {
        Self { title, ..self }
    }

    /// Describes the axes.
    fn text(&self) -> String {
        match &self.view {
            View::Plane { x, y, .. } => [y, x].map(Axis::text).join(" over "),
            View::Space { axes, .. } => axes.each_ref().map(Axis::text).join("; "),
        }
    }
}

impl Scene {
    /// Creates a figure with `columns` panels per row.
    pub(crate) fn new(title: impl Into<String>, columns: usize, panels: Vec<Panel>) -> Self {
        Self { title: title.into(), columns, panels, ..Self::default() }
    }

    /// Sets the caption.
    pub(crate) fn captioned(self, caption: impl Into<String>) -> Self {
        Self { caption: caption.into(), ..self }
    }

    /// Returns the second line of the heading: manipulator, subtitle and reference.
    pub(crate) fn heading(&self) -> String {
        let parts = [&self.manipulator, &self.subtitle, &self.reference].map(String::as_str);
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · ")
    }

    /// Returns the text alternative: caption and axes.
    pub(crate) fn alternative(&self) -> String {
        let panels = self.panels.iter().map(Panel::text).collect::<Vec<_>>();
        format!("{} {}.", self.caption, panels.join(". ")).trim_start().to_owned()
    }
}

/// Colour as red, green and blue. Serialized in CSS notation, `#d55e00`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

/// Nine colours of the viridis map, from dark to light with uniform steps of lightness, also in
/// print.
const VIRIDIS: [Colour; 9] = [
    Colour(68, 1, 84),
    Colour(71, 44, 122),
    Colour(59, 81, 139),
    Colour(44, 113, 142),
    Colour(33, 144, 141),
    Colour(39, 173, 129),
    Colour(92, 200, 99),
    Colour(170, 220, 50),
    Colour(253, 231, 37),
];

impl Colour {
    /// Colours of x, y and z, distinguishable with red-green colour blindness (Okabe and Ito).
    pub(crate) const XYZ: [Self; 3] = [Self(213, 94, 0), Self(0, 158, 115), Self(0, 114, 178)];
    /// Text, norms, and all sources together.
    pub(crate) const INK: Self = Self(40, 44, 52);
    /// Published figures.
    pub(crate) const PUBLISHED: Self = Self(160, 70, 130);
    /// Bars, and errors after a correction.
    pub(crate) const BAR: Self = Self(66, 122, 178);
    /// Axes, tick labels, and errors before a correction.
    pub(crate) const GREY: Self = Self(110, 114, 122);
    /// Grid lines.
    pub(crate) const FAINT: Self = Self(226, 228, 232);
    /// Links of a manipulator.
    pub(crate) const LINK: Self = Self(176, 182, 192);
    /// Tolerances and limits.
    pub(crate) const TOLERANCE: Self = Self(120, 120, 120);

    /// Returns the colour at `share` of the viridis map, from 0 to 1, in 32 steps.
    pub(crate) fn graded(share: f64) -> Self {
        let share = (share.clamp(0.0, 1.0) * 31.0).round() / 31.0;
        let at = share * (VIRIDIS.len() - 1) as f64;
        let i = (at as usize).min(VIRIDIS.len() - 2);
        let between = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * (at - i as f64)) as u8;
        let (low, high) = (VIRIDIS[i], VIRIDIS[i + 1]);
        Self(between(low.0, high.0), between(low.1, high.1), between(low.2, high.2))
    }

    /// Formats the colour in CSS notation.
    pub(crate) fn css(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.css())
    }
}
