//! Report of an analysis, of one run or of merged parts.

use std::sync::Arc;

use abbe_report::budget;
use abbe_study::analyze;
use abbe_study::explore::Explore;
use pyo3::prelude::*;

use crate::report::Report;

/// Creates the report of an analysis, with its text, tables and pages. `live` is the job of the
/// page's live panel; without files that a command can name there is none.
pub(crate) fn analysis(
    py: Python<'_>,
    report: analyze::Report,
    live: Option<Explore<'static>>,
    notes: Vec<String>,
) -> PyResult<Py<Report>> {
    let report = Arc::new(report);
    let drawn = Arc::clone(&report);
    let found = Report::from_document("analyze", &report, notes, budget)?;
    let found = found.with_figures(move || abbe_report::figures(&drawn));
    let found = found.with_pages(move || {
        let live = live.as_ref().map(|live| live.run(&mut ())).transpose()?;
        let files = abbe_report::analysis(&report, live.as_ref());
        Ok(files.into_iter().map(|file| (file.name, file.text)).collect())
    });
    found.create(py)
}
