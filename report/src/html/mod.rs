//! HTML pages of reports: one self-contained file with its figures, without external links, and
//! without scripts but those of a live panel.
//!
//! `page` is the page of an analysis; `measurement`, `identification`, `compensation` and
//! `monitoring` are the pages of the other jobs. All begin with the verdict, the most important
//! numbers and the figures; long tables are folded, and the input files come last. `document` has
//! the parts of every page, `findings` the sentences of the printed report, `figure` numbered
//! figures, `table` tables, and `provenance` record, options, files and instrument. Of an analysis,
//! `ledger` has the tables of errors, `covered` verdict and uncertainty, and `facts` conventions
//! and values. `notebook` shows a text in a notebook.

mod compensation;
mod covered;
mod document;
mod facts;
mod figure;
mod findings;
mod identification;
mod index;
mod ledger;
mod measurement;
mod monitoring;
mod notebook;
mod page;
mod provenance;
mod table;

pub use compensation::compensation;
use document::{Card, cards, document, folded, heading, panel, panels, paragraphs, section, verdict};
use findings::findings;
pub use identification::identification;
pub(crate) use index::index;
pub use measurement::measurement;
pub use monitoring::monitoring;
pub use notebook::notebook;
pub(super) use page::page;
pub use provenance::Provenance;

use crate::markup::escaped;
