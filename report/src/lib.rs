//! Figures, pages and texts of what `abbe-study` reports: SVG files, and HTML files that need no network.
//!
//! Everything comes back as texts with the names of their files; nothing here writes. `figures` builds a [`scene::Scene`] for each
//! figure of a report, `svg` draws it, and `html` writes the pages that hold it: [`analysis`], [`measurement()`],
//! [`identification()`], [`compensation()`] and [`monitoring()`]. [`figures()`] returns the figures of an analysis one by one.
//! [`text`] is what a terminal and Python's `print` show.

mod figures;
mod html;
mod markup;
mod pictures;
pub mod scene;
mod svg;
pub mod text;

pub use html::{Provenance, compensation, identification, listed, measurement, monitoring};
pub use pictures::{File, PAGE, Picture, analysis, figures};
