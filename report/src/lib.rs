//! Figures, pages and texts of the reports of `abbe-study`: SVG files, and HTML files that need no
//! network.
//!
//! All functions return texts with their file names; nothing is written to disk. [`views`] builds
//! the [`Document`] of a job, `terminal` and `html` show it. `figures` builds a [`scene::Scene`]
//! for each figure of a report, and `svg` renders it. [`analysis`] is the page of an analysis,
//! [`explore()`] the live page of a machine, and [`gallery()`] the pages of several. [`notebook()`]
//! shows a text in a notebook. [`figures()`] returns the figures of an analysis one by one.
//! [`text`] has the layout of text for a terminal and for Python's `print`.

mod document;
mod explore;
mod figures;
mod gallery;
mod html;
mod markup;
mod pictures;
pub mod scene;
mod svg;
mod terminal;
pub mod text;
mod unit;
pub mod views;

pub use document::{Document, Worded, plain};
pub use explore::explore;
pub use gallery::{INDEX, gallery};
pub use html::notebook;
pub use pictures::{File, PAGE, Picture, analysis, budget, figures};
