//! Monitoring of a machine by repeated checks.

use std::sync::Arc;

use abbe_metrology::monitor::options::FALSE_ALARM;
use abbe_metrology::monitor::{Checks, Monitor, Settings};
use abbe_report::views;
use pyo3::prelude::*;

use crate::job::{Whole, length, run, within};
use crate::{Machine, Measured, Report};

#[pymethods]
impl Machine {
    /// Detects drift and jumps of a machine with control charts of a few points that are measured
    /// repeatedly.
    ///
    /// `data`: CSV files or tables in chronological order, or one with a date column. `map`: path
    /// of the map of the columns, or a shipped name. `tolerance`: allowed displacement of the tool
    /// point since the first check, in the length unit or as text with a unit. `since`: date of the
    /// first check to use. `false_alarm`: average number of checks per false alarm, over all
    /// charts.
    ///
    /// `.report(folder)` writes report.html. Fields: `abbe.reports.MonitorReport`.
    #[pyo3(signature = (data, map, *, tolerance=None, since=None, false_alarm=365))]
    fn monitor(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: &Bound<'_, PyAny>,
        tolerance: Option<&Bound<'_, PyAny>>,
        since: Option<&str>,
        false_alarm: Whole,
    ) -> PyResult<Py<Report>> {
        let false_alarm = within("false_alarm", false_alarm, FALSE_ALARM.range)?;
        let tolerance = tolerance.map(|value| length("tolerance", value, &self.machine.spec)).transpose()?;
        let map = self.map(map)?;
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
        let (report, spec, map) = (Arc::new(report), job.machine.spec.clone(), job.map.clone());
        let document = move |report: &_| views::monitoring(&spec, &map, report);
        let found = Report::from_document("monitor", &report, notes, document)?.with_pages(move || {
            let files = measured.iter().map(|check| ("check", check.source()));
            let document = views::monitoring(&job.machine.spec, &job.map, &report);
            let (map, residuals) = (Some(&job.map), report.residuals.clone());
            let page = document.measured_page(&job.machine, map, files, residuals, &mut ())?;
            Ok(vec![("report.html".into(), page)])
        });
        found.create(py)
    }
}
