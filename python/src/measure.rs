//! How good a machine is, from measurements.

use std::path::PathBuf;
use std::sync::Arc;

use abbe_report::{Provenance, text};
use abbe_study::data::Data;
use abbe_study::measure::Measure;
use pyo3::prelude::*;

use crate::job::run;
use crate::machine::Machine;
use crate::measured::{Measured, unusable};
use crate::options::limits;
use crate::report::Report;

#[pymethods]
impl Machine {
    /// How good the machine is: what was measured against the ideal machine and against what its sources predict.
    ///
    /// `data`: a CSV file, or a table with the columns that the map names: a dict of arrays, a frame of pandas or polars, a table of
    /// pyarrow; rows are then counted from 0. Those that cannot be used are in `.notes`. `map`: what the columns are, a file or a shipped name. `new_station`: the instrument stands where no map
    /// knows. `accept`: limits such as "mean 0.15 mm, max 0.3 mm". Fields as those of `abbe measure --json`.
    #[pyo3(signature = (data, map, *, new_station=false, accept=None))]
    fn measure(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: PathBuf,
        new_station: bool,
        accept: Option<&str>,
    ) -> PyResult<Report> {
        let map = self.map(py, &map)?;
        let measured = Measured::new("data", data, &map)?;
        let ((job, report), notes) = run(py, None, None, |notes| {
            let machine = self.machine.clone();
            let map = if new_station { map.newly_stationed() } else { map };
            let accept = limits(accept, &machine.spec, &map)?;
            let data = Data::read(measured.source(), &map)?;
            unusable(&data, notes);
            let job = Measure { data, machine, map, accept };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let (report, spec) = (Arc::new(report), job.machine.spec.clone());
        let text = move |report: &_| text::measurement(&spec, report);
        let found = Report::new("measure", &report, notes, text)?.with_rows(report.table());
        Ok(found.with_pages(move || {
            let spec = &job.machine.spec;
            let provenance =
                Provenance::new(spec, Some(&job.map), [("measurements", measured.source())], None)?;
            let page = abbe_report::measurement(spec, &job.map, &report, &provenance);
            Ok(vec![("report.html".into(), page), ("errors.csv".into(), report.table().csv())])
        }))
    }
}
