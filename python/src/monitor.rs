//! Whether a machine that is checked again and again is still what it was.

use std::path::PathBuf;
use std::sync::Arc;

use abbe_report::{Provenance, text};
use abbe_study::monitor::options::FALSE_ALARM;
use abbe_study::monitor::{Checks, Monitor, Settings};
use pyo3::prelude::*;

use crate::job::run;
use crate::machine::Machine;
use crate::measured::Measured;
use crate::options::{length, within};
use crate::report::Report;

#[pymethods]
impl Machine {
    /// Whether the machine is still what it was: charts of a few points that are measured again and again.
    ///
    /// `data`: CSV files or tables in the order of their dates, or one with a column of dates. `tolerance`: how far the tool point may move, in the length unit or as text.
    /// `since`: begin with the check of this date. `false_alarm`: one in so many checks. Fields as those of `abbe monitor --json`.
    #[pyo3(signature = (data, map, *, tolerance=None, since=None, false_alarm=365))]
    fn monitor(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: PathBuf,
        tolerance: Option<&Bound<'_, PyAny>>,
        since: Option<&str>,
        false_alarm: usize,
    ) -> PyResult<Report> {
        let false_alarm = within("false_alarm", false_alarm, FALSE_ALARM.range)?;
        let tolerance = tolerance.map(|value| length("tolerance", value, &self.machine.spec)).transpose()?;
        let map = self.map(py, &map)?;
        let measured = Measured::several("data", data, &map)?;
        let ((job, report), notes) = run(py, None, None, |notes| {
            let machine = self.machine.clone();
            let mut checks = Checks::read(measured.iter().map(Measured::source), &map)?;
            since.map_or(Ok(()), |date| checks.since("since", date))?;
            let checks_per_false_alarm = false_alarm as f64;
            let settings = Settings { checks_per_false_alarm, tolerance, ..Settings::default() };
            let job = Monitor { machine, map, checks, settings };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let (report, spec) = (Arc::new(report), job.machine.spec.clone());
        let text = move |report: &_| text::monitoring(&spec, report);
        Ok(Report::new("monitor", &report, notes, text)?.with_pages(move || {
            let files = measured.iter().map(|check| ("check", check.source()));
            let provenance = Provenance::new(&job.machine.spec, Some(&job.map), files, None)?;
            let page = abbe_report::monitoring(&job.machine.spec, &job.map, &report, &provenance);
            Ok(vec![("report.html".into(), page)])
        }))
    }
}
