//! Figures as plain data: panels with axes and marks, in the units of display.
//!
//! `figures` builds scenes from reports, `svg` renders them, and Python returns them as dicts.

mod axis;
mod colour;
mod mark;

use serde::Serialize;

pub use axis::{Axis, Scale};
pub(crate) use axis::{ends, with_margin};
pub use colour::Colour;
pub use mark::{Corner, Mark, Shape};

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
    /// Creates a panel with two axes.
    pub(crate) fn plane(height: f64, x: Axis, y: Axis, marks: Vec<Mark<[f64; 2]>>) -> Self {
        let view = View::Plane { x, y, equal: false, marks };
        Self { title: String::new(), published: String::new(), height, view }
    }

    /// Creates a panel with two axes of the same scale.
    pub(crate) fn equal_plane(height: f64, x: Axis, y: Axis, marks: Vec<Mark<[f64; 2]>>) -> Self {
        let view = View::Plane { x, y, equal: true, marks };
        Self { title: String::new(), published: String::new(), height, view }
    }

    /// Creates a panel with three axes of the same scale.
    pub(crate) fn equal_space(height: f64, axes: [Axis; 3], up: usize, marks: Vec<Mark<[f64; 3]>>) -> Self {
        let view = View::Space { axes, up, equal: true, marks };
        Self { title: String::new(), published: String::new(), height, view }
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
