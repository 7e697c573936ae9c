//! The report: one HTML file with everything in it, its figures too, without a script and without a link to anywhere else.
//!
//! `page` is that of an analysis, `measurement`, `identification`, `compensation` and `monitoring` those about measurements, with
//! `figure` (numbered figures) and `provenance` (instrument, files, date); `ledger` its tables of errors, `covered` its verdict
//! and uncertainty, `facts` what they rest on.

mod compensation;
mod covered;
mod facts;
mod figure;
mod identification;
mod ledger;
mod measurement;
mod monitoring;
mod page;
mod provenance;

pub use compensation::compensation;
pub use identification::identification;
pub use ledger::listed;
pub use measurement::measurement;
pub use monitoring::monitoring;
pub(super) use page::page;
use page::{document, section};
pub use provenance::Provenance;

use crate::markup::escaped;
