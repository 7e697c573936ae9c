//! HTML pages of reports: one self-contained file with its figures, without external links, and
//! without scripts but those of a live panel.
//!
//! `report` shows a [`Document`](crate::Document) as a page: verdict, the most important numbers
//! and the live panel first, then its sections, and the input files last; sections with long tables
//! are folded. `document` has the parts of every page, `figure` numbered figures, `table` tables,
//! and `provenance` record, options and files. `notebook` shows a text in a notebook.

mod document;
mod figure;
mod index;
mod notebook;
mod provenance;
mod report;
mod table;

use document::{document, folded, heading, panel, panels, paragraphs, section, verdict};
pub(crate) use index::index;
pub use notebook::notebook;
pub(crate) use provenance::Provenance;

use crate::markup::escaped;
