//! Evaluation of measurements of a machine.

use std::sync::Arc;

use abbe_metrology::{data::Data, measure::Measure};
use abbe_report::views;
use pyo3::prelude::*;

use crate::measured::{Measured, unusable};
use crate::{Machine, Report, run};

#[pymethods]
impl Machine {
    /// Evaluates measurements: accuracy and repeatability against the ideal machine, and the
    /// residuals after its sources.
    ///
    /// `data`: a CSV file, or a table with the columns of the map: a dict of arrays, a pandas or
    /// polars frame, a pyarrow table; its rows count from 0. Rows that cannot be used are listed in
    /// `.messages`. `map`: path of the map of the columns, or a shipped name. `new_station`:
    /// estimate the station of the instrument from the data instead of taking it from the map.
    /// `corrected`: the rows hold commands that were corrected by this machine's errors. `accept`:
    /// limits of the machine such as "mean 0.15 mm, max 0.3 mm".
    ///
    /// `.table("rows")` has ΔX of each row, the prediction by the machine with its sources, and
    /// measured minus predicted; for instruments that read numbers, reading minus prediction and
    /// prediction.
    ///
    /// `.report(folder)` writes report.html and errors.csv. Fields: `abbe.reports.MeasureReport`.
    #[pyo3(signature = (data, map, *, new_station=false, corrected=false, accept=None))]
    fn measure(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: &Bound<'_, PyAny>,
        new_station: bool,
        corrected: bool,
        accept: Option<&str>,
    ) -> PyResult<Py<Report>> {
        let map = self.map(map)?;
        let measured = Measured::new("data", data, &map)?;
        let ((job, report), notes) = run(py, None, None, |notes| {
            let machine = self.machine.clone();
            let mut map = if new_station { map.newly_stationed() } else { map };
            map.is_corrected |= corrected;
            let accept = map.limits("accept", accept, &machine.spec)?;
            let data = Data::read(measured.source(), &map)?;
            unusable(&data, notes);
            let job = Measure { data, machine, map, accept };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let (report, spec, map) = (Arc::new(report), job.machine.spec.clone(), job.map.clone());
        let document = move |report: &_| views::measurement(&spec, &map, report);
        let found = Report::from_document("measure", &report, notes, document)?.with_rows(report.table());
        let found = found.with_pages(move || {
            let document = views::measurement(&job.machine.spec, &job.map, &report);
            let (files, residuals) = ([("measurements", measured.source())], report.residuals());
            let page = document.measured_page(&job.machine, Some(&job.map), files, residuals, &mut ())?;
            Ok(vec![("report.html".into(), page), ("errors.csv".into(), report.table().csv())])
        });
        found.create(py)
    }
}
