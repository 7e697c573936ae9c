//! Simulated measurements of a machine.
#![allow(clippy::too_many_arguments, reason = "keywords of Python")]

use std::sync::Arc;

use abbe_metrology::data::Data;
use abbe_metrology::simulate::options::{OUTLIERS, SAMPLES};
use abbe_metrology::simulate::{Places, Simulate};
use pyo3::prelude::*;

use crate::job::{SEEDS, Whole, length, run, within};
use crate::{Machine, Measured, Report};

#[pymethods]
impl Machine {
    /// Simulates measurements of the machine with the repeatable errors of its sources.
    ///
    /// `map`: path of the map of the columns to write, or a shipped name. `data`: joint commands in
    /// a CSV file or a table; without it, `samples` random configurations. `noise`: standard
    /// deviation of each coordinate, in the length unit or as text with a unit; by default the
    /// uncertainty in the map. `outliers`: fraction of the rows that are outliers. `random`: also
    /// draw the random sources, independently in every row. `seed`: of configurations, noise,
    /// outliers and random sources.
    ///
    /// `.report(folder)` writes measurements.csv. Fields: `abbe.reports.SimulateReport`.
    #[pyo3(signature = (map, *, data=None, samples=100, noise=None, outliers=0.0, random=false, seed=0))]
    fn simulate(
        &self,
        py: Python<'_>,
        map: &Bound<'_, PyAny>,
        data: Option<&Bound<'_, PyAny>>,
        samples: Whole,
        noise: Option<&Bound<'_, PyAny>>,
        outliers: f64,
        random: bool,
        seed: Whole,
    ) -> PyResult<Py<Report>> {
        let (samples, seed) = (within("samples", samples, SAMPLES.range)?, within("seed", seed, SEEDS)?);
        let outliers = within("outliers", outliers, OUTLIERS.range)?;
        let noise = noise.map(|value| length("noise", value, &self.machine.spec)).transpose()?;
        let map = self.map(map)?;
        let commands = data.map(|data| Measured::new("data", data, &map)).transpose()?;
        let (report, notes) = run(py, None, None, |notes| {
            let machine = self.machine.clone();
            let at = match &commands {
                Some(commands) => Places::Rows(Data::read_commanded(commands.source(), &map)?),
                None => Places::Samples(samples),
            };
            Simulate { machine, map, at, noise, outliers, random, seed }.run(notes)
        })?;
        let report = Arc::new(report);
        let found = Report::new("simulate", &report, notes, |report, _| report.table.csv())?;
        let found = found.with_rows(report.table.clone());
        found.with_pages(move || Ok(vec![("measurements.csv".into(), report.table.csv())])).create(py)
    }
}
