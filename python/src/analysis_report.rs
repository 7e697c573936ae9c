//! Report of an analysis, of one run or of merged parts.

use std::sync::Arc;

use abbe_report::text;
use abbe_study::analyze;
use pyo3::prelude::*;

use crate::failure::guarded;
use crate::report::Report;

/// Creates the report of an analysis, with its text, tables and pages.
pub(crate) fn analysis(report: analyze::Report, notes: Vec<String>) -> PyResult<Report> {
    let tables = guarded(|| Ok(budget(&report)))?;
    let report = Arc::new(report);
    let drawn = Arc::clone(&report);
    let found = Report::new("analyze", &report, notes, text::analysis)?;
    let found = found.with_html(tables).with_figures(move || abbe_report::figures(&drawn));
    Ok(found.with_pages(move || {
        let files = abbe_report::analysis(&report);
        Ok(files.into_iter().map(|file| (file.name, file.text)).collect())
    }))
}

/// Formats the ledgers and the uncertainty budgets as HTML tables.
fn budget(report: &analyze::Report) -> String {
    let (length, listed) = (report.spec.length.symbol(), abbe_report::listed);
    let turns =
        analyze::orientation_ledger(report).map(|turns| listed("Ledger of the orientation (mrad)", &turns));
    let budgets = report.uncertainty_budgets().flat_map(|budget| {
        let (_, unit) = analyze::unit::display_unit(report, budget.measurand);
        let contributions = analyze::uncertainty_contributions(report, budget);
        [
            listed(&format!("Uncertainty budget ({unit})"), &contributions),
            listed(&format!("Expanded uncertainty ({unit})"), &analyze::uncertainty_totals(report, budget)),
        ]
    });
    let ledger = listed(&format!("Ledger of the tool point ({length})"), &analyze::ledger(report));
    [ledger].into_iter().chain(turns).chain(budgets).collect()
}
