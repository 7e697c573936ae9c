//! Runs of an axis of a machine tool, of body diagonals, or of a circular test.

use std::sync::Arc;

use abbe_metrology::positioning::Positioning;
use abbe_report::views;
use pyo3::prelude::*;

use crate::{Measured, Report, run};

/// Evaluates runs of one axis by ISO 230-2, body diagonals by ISO 230-6, or circles by ISO 230-4.
///
/// `data`: a CSV file or a table with columns `position (mm)`, `direction` (`+` or `-`) and
/// `deviation (um)` or `actual (mm)`; or with one column for each pass, `1+ (um)`, `1- (um)`, …
/// A column `diagonal` names the body diagonal of each row. A column `angle (deg)` instead of
/// `position` has a circular test, whose deviations are those of the radius. `reading_uncertainty`,
/// `scale_uncertainty`: standard uncertainties of one reading of the instrument, "0.1 um", and of
/// its scale, "1 um/m". `accept`: limits of characteristics, "A 12 um, B 3 um"; the report then has
/// a verdict, `accepted`.
///
/// Positions are in mm or deg, characteristics in um or arcsec. `.table("rows")` has the mean
/// deviations of an axis at its positions. Fields: `abbe.reports.PositioningReport`.
///
/// >>> import abbe
/// >>> runs = {"position (mm)": [0, 100], "1+ (um)": [1.0, 4.0], "1- (um)": [0.0, 2.0]}
/// >>> report = abbe.positioning(runs)
/// >>> both = report.lines[0].bidirectional
/// >>> both and both.reversal.value
/// 2.0
#[pyfunction]
#[pyo3(signature = (data, *, reading_uncertainty=None, scale_uncertainty=None, accept=None))]
pub(crate) fn positioning(
    py: Python<'_>,
    data: &Bound<'_, PyAny>,
    reading_uncertainty: Option<String>,
    scale_uncertainty: Option<String>,
    accept: Option<String>,
) -> PyResult<Py<Report>> {
    let measured = Measured::all("data", data)?;
    let (report, notes) = run(py, None, None, |notes| {
        let (reading, scale) = (reading_uncertainty, scale_uncertainty);
        Positioning { data: measured.source(), reading, scale, accept }.run(notes)
    })?;
    let rows = report.table();
    let found = Report::from_document("positioning", &Arc::new(report), notes, views::positioning)?;
    match rows {
        Some(rows) => found.with_rows(rows),
        None => found,
    }
    .create(py)
}
