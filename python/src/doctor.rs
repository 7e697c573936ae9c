//! Conventions of measured data.

use std::sync::Arc;

use abbe_metrology::doctor::Doctor;
use abbe_report::views;
use pyo3::prelude::*;

use crate::job::{length, run};
use crate::report::{Pages, Report};
use crate::{Machine, Measured, guarded, spec_error};

/// File name of the corrected spec.
const CORRECTED: &str = "doctor.spec.toml";

#[pymethods]
impl Machine {
    /// Finds the conventions of measured data: units, signs, order, zeros, Euler angles and more,
    /// from about ten rows of joints and poses.
    ///
    /// `data`: a CSV file or a table with one column per joint, found by the names of the variables
    /// or else taken from the first columns, then x, y, z and, optionally, an orientation.
    /// Alternatively joints alone (m, nq), with `seen`: positions (m, 3), positions and three
    /// angles (m, 6) or a quaternion (m, 7), matrices (m, 12), (m, 16) or (m, 4, 4). `within`:
    /// largest position residual of an interpretation that fits, in the length unit or as text with
    /// a unit.
    ///
    /// `.statements["answer"]` states the result. `.found` lists the interpretations that fit.
    /// `.map` is the text of the map of the first one, or None; `.report(folder)` writes it as
    /// doctor.map.toml.
    /// If the interpretation changes the spec, `.load()` returns the corrected machine, and
    /// doctor.spec.toml is its spec.
    ///
    /// Residuals are in the length unit and rad. Fields: `abbe.reports.DoctorReport`.
    ///
    /// >>> import abbe, numpy as np
    /// >>> ur5 = abbe.load("ur5")
    /// >>> q = np.random.default_rng(0).uniform(-2, 2, (10, 6))
    /// >>> report = ur5.doctor(np.degrees(q), ur5.pose(q)[:, :3, 3] / 1000)
    /// >>> found = report.found[0].interpretation
    /// >>> found.joints_in_degrees, found.lengths_in
    /// (True, 'm')
    #[pyo3(signature = (data, seen=None, *, within=None))]
    fn doctor(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        seen: Option<&Bound<'_, PyAny>>,
        within: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<Report>> {
        let within = within.map(|value| length("within", value, &self.machine.spec)).transpose()?;
        let rows = match seen {
            None => Measured::all("data", data)?,
            Some(seen) => {
                let read = py.import("abbe._arrays")?.getattr("beside")?;
                Measured::all("data", &read.call1((data, seen, &self.variable_names))?)?
            }
        };
        let (report, notes) = run(py, None, None, |notes| {
            Doctor { machine: self.machine.clone(), data: rows.source(), within }.run(notes)
        })?;
        let mut pages: Pages =
            report.map.iter().map(|map| ("doctor.map.toml".to_owned(), map.clone())).collect();
        let corrected = || report.corrected(&self.unchanged.spec, &self.text()?, CORRECTED);
        let corrected = guarded(|| corrected().map_err(|mistakes| spec_error(py, &mistakes)))?;
        pages.extend(corrected.map(|spec| (CORRECTED.to_owned(), spec)));
        let found = Report::from_document("doctor", &Arc::new(report), notes, views::doctor)?;
        found.with_spec(CORRECTED).with_pages(move || Ok(pages.clone())).create(py)
    }
}
