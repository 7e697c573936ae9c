//! The report: one HTML file with everything in it, its script and its data, and no link to anywhere.
//!
//! `page` is that of an analysis, `measurement` that of a measurement; `ledger` its tables of errors, `covered` its verdict and uncertainty, `facts` what they rest on; `plots` the figures, one module for each kind.

mod covered;
mod facts;
mod ledger;
mod measurement;
mod page;
mod plots;

pub use measurement::measurement;
pub(super) use page::page;
use page::{document, section};
use plots::style;

/// Text as HTML has it.
pub(super) fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;")
}
