//! HTML pages of reports: one self-contained file with its figures, without external links, and
//! without scripts but those of a live panel.
//!
//! `report` shows a [`Document`](crate::Document) as a page: verdict, the most important numbers
//! and the live panel first, then its sections, and the input files last; sections with long tables
//! are folded. The page ends with record, options and files. `document` has the parts of
//! every page, `table` tables. `notebook` shows a text in a notebook.

mod document;
mod index;
mod notebook;
mod report;
mod table;

use document::{document, folded, heading, panel, panels, paragraphs, section, verdict};
pub(crate) use index::index;
pub use notebook::notebook;
pub(crate) use report::Provenance;

use crate::markup::escaped;
