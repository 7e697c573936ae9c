//! The report: one HTML file with everything in it, its script and its data, and no link to anywhere.
//!
//! `page` is the whole; `ledger` its tables of errors, `facts` what they rest on; `plots` the figures, one module for each kind.

mod facts;
mod ledger;
mod page;
mod plots;

pub(super) use page::page;
pub use page::{document, section};
pub use plots::style;

/// Text as HTML has it.
pub fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;")
}
