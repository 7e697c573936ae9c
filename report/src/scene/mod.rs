//! A figure as plain data: panels with axes, and marks on them, in the units that a reader sees.
//!
//! `figures` builds scenes from reports, `svg` draws them, and Python gets them as dicts.

mod axis;
mod colour;
mod mark;

use serde::Serialize;

pub use axis::{Axis, Scale};
pub(crate) use axis::{ends, with_room};
pub use colour::Colour;
pub use mark::{Corner, Mark, Shape};

/// A figure: what it is called, and its panels.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Scene {
    /// The title.
    pub title: String,
    /// The manipulator, for those who see the figure by itself.
    pub manipulator: String,
    /// What is drawn, in a few words.
    pub subtitle: String,
    /// The published figure that shows the same, with its publisher.
    pub reference: String,
    /// What a reader should know about it.
    pub caption: String,
    /// The number of panels in a row.
    pub columns: usize,
    /// The panels, row by row.
    pub panels: Vec<Panel>,
}

/// One coordinate system with what is drawn in it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panel {
    /// Stands above it.
    pub title: String,
    /// What is published about it.
    pub published: String,
    /// The height of what the axes enclose, in pixels.
    pub height: f64,
    /// The axes and the marks.
    #[serde(flatten)]
    pub view: View,
}

/// A plane, or a space that is seen from a corner.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "view", rename_all = "lowercase")]
pub enum View {
    /// Two axes.
    Plane {
        /// To the right.
        x: Axis,
        /// Upwards.
        y: Axis,
        /// The same scale on both axes.
        equal: bool,
        /// In the order in which they are drawn.
        marks: Vec<Mark<[f64; 2]>>,
    },
    /// Three axes.
    Space {
        /// x, y and z.
        axes: [Axis; 3],
        /// The axis that points up.
        up: usize,
        /// The same scale on all axes.
        equal: bool,
        /// In the order in which they are drawn.
        marks: Vec<Mark<[f64; 3]>>,
    },
}

impl Panel {
    /// A panel with two axes.
    pub(crate) fn plane(height: f64, x: Axis, y: Axis, marks: Vec<Mark<[f64; 2]>>) -> Self {
        let view = View::Plane { x, y, equal: false, marks };
        Self { title: String::new(), published: String::new(), height, view }
    }

    /// A panel with two axes of the same scale.
    pub(crate) fn equal_plane(height: f64, x: Axis, y: Axis, marks: Vec<Mark<[f64; 2]>>) -> Self {
        let view = View::Plane { x, y, equal: true, marks };
        Self { title: String::new(), published: String::new(), height, view }
    }

    /// A panel with three axes of the same scale.
    pub(crate) fn equal_space(height: f64, axes: [Axis; 3], up: usize, marks: Vec<Mark<[f64; 3]>>) -> Self {
        let view = View::Space { axes, up, equal: true, marks };
        Self { title: String::new(), published: String::new(), height, view }
    }

    /// The panel with a title above it.
    pub(crate) fn titled(self, title: String) -> Self {
        Self { title, ..self }
    }

    /// The axes in words.
    fn text(&self) -> String {
        match &self.view {
            View::Plane { x, y, .. } => [y, x].map(Axis::text).join(" over "),
            View::Space { axes, .. } => axes.each_ref().map(Axis::text).join("; "),
        }
    }
}

impl Scene {
    /// A figure whose panels stand in rows of so many.
    pub(crate) fn new(title: impl Into<String>, columns: usize, panels: Vec<Panel>) -> Self {
        Self { title: title.into(), columns, panels, ..Self::default() }
    }

    /// The figure with a caption.
    pub(crate) fn captioned(self, caption: impl Into<String>) -> Self {
        Self { caption: caption.into(), ..self }
    }

    /// The second line of the heading.
    pub(crate) fn heading(&self) -> String {
        let parts = [&self.manipulator, &self.subtitle, &self.reference].map(String::as_str);
        parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · ")
    }

    /// The figure in words, for those who cannot see it.
    pub(crate) fn alternative(&self) -> String {
        let panels = self.panels.iter().map(Panel::text).collect::<Vec<_>>();
        format!("{} {}.", self.caption, panels.join(". ")).trim_start().to_owned()
    }
}
