//! Figures, pages and texts of the reports of `abbe-study`: SVG files, and HTML files that need no
//! network.
//!
//! All functions return texts with their file names; nothing is written to disk. `figures` builds a
//! [`scene::Scene`] for each figure of a report, `svg` renders it, and `html` builds the pages:
//! [`analysis`], [`measurement()`], [`identification()`], [`compensation()`] and [`monitoring()`].
//! [`explore()`] is the live page of a machine, [`gallery()`] the pages of several. [`notebook()`]
//! shows a text in a notebook. [`figures()`] returns the figures of an analysis one by one.
//! [`text`] has the texts for a terminal and for Python's `print`.

mod explore;
mod figures;
mod gallery;
mod html;
mod markup;
mod pictures;
pub mod scene;
mod svg;
pub mod text;

pub use explore::explore;
pub use gallery::{INDEX, gallery};
pub use html::{Provenance, compensation, identification, measurement, monitoring, notebook};
pub use pictures::{File, PAGE, Picture, analysis, figures};
