//! Where to measure.
#![allow(clippy::too_many_arguments, reason = "keywords of Python")]

use std::path::PathBuf;
use std::sync::Arc;

use abbe_report::text;
use abbe_study::Study;
use abbe_study::data::Map;
use abbe_study::plan::options::{CANDIDATES, COUNT, CRITERIA};
use abbe_study::plan::{Choice, Plan, Sets};
use pyo3::prelude::*;

use crate::job::run;
use crate::machine::Machine;
use crate::options::{length, named, within};
use crate::report::Report;

#[pymethods]
impl Machine {
    /// Where to measure, and how well the errors of the machine will then be known where it is used.
    ///
    /// `map`: what will be measured. `sets`: a plan file; else the `count` configurations that tell most of `candidates` samples, by
    /// `criterion` "v" or "d"; `seed` draws the samples. `model_error`: a length in the unit of the spec, or text. `.report(folder)` writes plan.csv. Fields as
    /// those of `abbe plan --json`.
    #[pyo3(signature = (map, *, sets=None, count=50, criterion="v", candidates=500, model_error=None, study=None, seed=None, progress=None))]
    fn plan(
        &self,
        py: Python<'_>,
        map: PathBuf,
        sets: Option<PathBuf>,
        count: usize,
        criterion: &str,
        candidates: usize,
        model_error: Option<&Bound<'_, PyAny>>,
        study: Option<PathBuf>,
        seed: Option<u64>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Report> {
        let criterion = named("criterion", criterion, CRITERIA)?;
        let count = within("count", count, COUNT.range)?;
        let candidates = within("candidates", candidates, CANDIDATES.range)?;
        let model_error =
            model_error.map(|value| length("model_error", value, &self.machine.spec)).transpose()?;
        let ((job, report), notes) = run(py, None, progress, |notes| {
            let machine = self.machine.clone();
            let map = Map::find(&map, &machine.spec)?;
            let choice = match &sets {
                Some(file) => Choice::Sets(Sets::find(file, &machine.spec)?),
                None => Choice::Optimal { criterion, count, candidates },
            };
            let study = Study::find(study.as_deref(), &machine)?;
            let job = Plan { machine, map, choice, study, model_error: model_error.unwrap_or(0.0), seed };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let (report, spec, map) = (Arc::new(report), job.machine.spec, job.map.clone());
        let text = move |report: &_| text::plan(&spec, &map, report);
        let found = Report::new("plan", &report, notes, text)?.with_rows(report.table(&job.map));
        Ok(found.with_pages(move || Ok(vec![("plan.csv".into(), report.table(&job.map).csv())])))
    }
}
