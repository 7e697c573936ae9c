//! Checks of a spec.

use std::sync::Arc;

use abbe_report::views;
use abbe_study::check::Check;
use pyo3::prelude::*;

use crate::{Machine, Report, run};

#[pymethods]
impl Machine {
    /// Checks the spec, and compares J_e with the exact chain. The report has the model, its chain
    /// at home and the identifiable errors.
    ///
    /// Fields: `abbe.reports.CheckReport`.
    ///
    /// >>> import abbe
    /// >>> all(law.holds for law in abbe.load("scara").check().laws)
    /// True
    fn check(&self, py: Python<'_>) -> PyResult<Py<Report>> {
        let job = Check { machine: self.machine.clone() };
        let (report, notes) = run(py, None, None, |notes| job.run(notes))?;
        Report::from_document("check", &Arc::new(report), notes, views::check)?.create(py)
    }
}
