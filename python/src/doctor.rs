//! Which convention some rows of joints and poses are in.

use std::sync::Arc;

use abbe_report::text;
use abbe_study::doctor::Doctor;
use pyo3::prelude::*;

use crate::failure::{guarded, spec_error};
use crate::job::run;
use crate::machine::Machine;
use crate::measured::Measured;
use crate::options::length;
use crate::report::{Pages, Report};

/// The spec as a reading has it.
const CORRECTED: &str = "doctor.spec.toml";

#[pymethods]
impl Machine {
    /// Which convention is it? Of some ten rows of joints and of what was seen at them, the reading under which they are this machine's.
    ///
    /// `data`: a CSV file or a table: a column for each joint, by the names of the variables or else the first ones, then x, y, z and
    /// an orientation if there is one. Or joints alone, (m, nq), with `seen`: (m, 3), positions; (m, 6), three angles more; (m, 7), a
    /// quaternion; (m, 12) or (m, 16), a matrix; (m, 4, 4). Nobody says units, signs, orders: that is the question. `within`: what
    /// may be left of a position, in the length unit or as text.
    ///
    /// `.sentence` says what is found, `.found` has the readings that fit, `.map` is the text of the first one's map, or None, which
    /// `.report(folder)` writes as doctor.map.toml; where the reading is about the spec, `.load()` is the machine as it has it, and
    /// doctor.spec.toml its spec. Fields as those of `abbe doctor --json`, residuals in the length unit and rad.
    ///
    /// >>> import abbe, numpy as np
    /// >>> ur5 = abbe.load("ur5")
    /// >>> q = np.random.default_rng(0).uniform(-2, 2, (10, 6))
    /// >>> report = ur5.doctor(np.degrees(q), ur5.pose(q)[:, :3, 3] / 1000)
    /// >>> report.found[0].reading.joints_in_degrees, report.found[0].reading.lengths_in
    /// (True, 'm')
    #[pyo3(signature = (data, seen=None, *, within=None))]
    fn doctor(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        seen: Option<&Bound<'_, PyAny>>,
        within: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Report> {
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
        let found = Report::new("doctor", &Arc::new(report), notes, text::doctor)?;
        Ok(found.with_spec(CORRECTED).with_pages(move || Ok(pages.clone())))
    }
}
