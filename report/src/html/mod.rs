//! The report: one HTML file with everything in it, its script and its data, and no link to anywhere.
//!
//! `page` is that of an analysis, `measurement`, `identification`, `compensation` and `monitoring` those about measurements, with
//! `figure`, `residuals` (what is left, as pictures) and `provenance` (instrument, files, date); `ledger` its tables of errors, `covered` its verdict and uncertainty, `facts` what they rest on; `plots` the figures, one module for each kind.

mod compensation;
mod covered;
mod facts;
mod figure;
mod identification;
mod ledger;
mod measurement;
mod monitoring;
mod page;
mod plots;
mod provenance;
mod reach;
mod residuals;

pub use compensation::compensation;
pub use identification::identification;
pub use ledger::listed;
pub use measurement::measurement;
pub use monitoring::monitoring;
pub(super) use page::page;
use page::{document, section};
use plots::style;
pub use provenance::Provenance;

use abbe_study::analyze::Report;
use plotly::Plot;

use crate::figure::Named;

/// The plots of a figure, those that stand side by side.
pub(super) fn interactive(figure: &Named, report: &Report) -> Vec<Plot> {
    plots::of(figure, report).plots
}

/// Text as HTML has it.
pub(super) fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;")
}
