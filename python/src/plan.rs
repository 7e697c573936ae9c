//! Measurement plans.
#![allow(clippy::too_many_arguments, reason = "keywords of Python")]

use std::{path::PathBuf, sync::Arc};

use abbe_metrology::plan::options::{CANDIDATES, COUNT, CRITERIA};
use abbe_metrology::plan::{Choice, Plan, Sets};
use abbe_report::views;
use pyo3::prelude::*;

use crate::job::{self, GivenStudy, SEEDS, Whole, length, named, run, within};
use crate::{Machine, Report};

#[pymethods]
impl Machine {
    /// Plans measurements, and predicts the uncertainty of the tool point after identification.
    ///
    /// `map`: path of the map of the measurements, or a shipped name. `sets`: path of a plan file
    /// with sets of configurations: `count` of them are chosen, or all are evaluated; without it,
    /// `count` (50) configurations are chosen from `candidates`: a number of samples, or
    /// configurations (m, nq) as an array, or a table with columns of joints and inputs.
    /// `criterion`: "v" for the smallest mean variance of the tool point over the workspace of
    /// `study`, "d" for the largest determinant of the information matrix. `seed`: of random
    /// candidates; without it they are evenly distributed. `model_error`: model error at the tool
    /// point in addition to the noise of the instrument, in the length unit or as text with a unit.
    ///
    /// `.report(folder)` writes plan.csv. Fields: `abbe.reports.PlanReport`.
    #[pyo3(signature = (map, *, sets=None, count=None, criterion="v", candidates=None, model_error=None, study=None, seed=None, progress=None), text_signature = "($self, map, *, sets=None, count=None, criterion='v', candidates=500, model_error=None, study=None, seed=None, progress=None)")]
    fn plan(
        &self,
        py: Python<'_>,
        map: &Bound<'_, PyAny>,
        sets: Option<PathBuf>,
        count: Option<Whole>,
        criterion: &str,
        candidates: Option<&Bound<'_, PyAny>>,
        model_error: Option<&Bound<'_, PyAny>>,
        study: Option<GivenStudy>,
        seed: Option<Whole>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<Report>> {
        let criterion = named("criterion", criterion, CRITERIA)?;
        let seed = seed.map(|seed| within("seed", seed, SEEDS)).transpose()?;
        // Rows of candidates are a plan file in a folder that is removed with its object.
        let helper = py.import("abbe._arrays")?.getattr("candidates")?;
        let defaults = (CANDIDATES.default, COUNT.default);
        let read = helper.call1((
            candidates,
            self.variable_names.bind(py),
            self.units(py)?,
            sets,
            count,
            defaults,
        ))?;
        let (candidates, sets, count, _folder) =
            read.extract::<(Whole, Option<PathBuf>, Option<Whole>, Bound<'_, PyAny>)>()?;
        let count = count.map(|count| within("count", count, COUNT.range)).transpose()?;
        let candidates = within("candidates", candidates, CANDIDATES.range)?;
        let model_error =
            model_error.map(|value| length("model_error", value, &self.machine.spec)).transpose()?;
        let map = self.map(map)?;
        let (study, study_text) = GivenStudy::or_text(study, None);
        let ((job, report), notes) = run(py, None, progress, |notes| {
            let machine = self.machine.clone();
            let sets = sets.as_deref().map(|file| Sets::find(file, &machine.spec)).transpose()?;
            let choice = Choice::new(sets, count, criterion, candidates);
            let study = job::study(study.as_deref(), study_text.as_deref(), &machine)?;
            let job = Plan { machine, map, choice, study, model_error: model_error.unwrap_or(0.0), seed };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let (report, spec, map) = (Arc::new(report), job.machine.spec, job.map.clone());
        let document = move |report: &_| views::plan(&spec, &map, report);
        let found =
            Report::from_document("plan", &report, notes, document)?.with_rows(report.table(&job.map));
        found.with_pages(move || Ok(vec![("plan.csv".into(), report.table(&job.map).csv())])).create(py)
    }
}
