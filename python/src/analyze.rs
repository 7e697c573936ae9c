//! Errors of every source over a workspace.
#![allow(clippy::too_many_arguments, reason = "keywords of Python")]

use std::{borrow::Cow, iter, path::Path};

use abbe::analysis::Row;
use abbe_metrology::data::Table;
use abbe_study::analyze::Analyze;
use abbe_study::analyze::options::DRAWS;
use abbe_study::analyze::parts::{AnalysisRequest, FileText, Part, Shard};
use abbe_study::explore::Explore;
use abbe_study::{Notes, Result};
use numpy::PyUntypedArrayMethods;
use pyo3::{exceptions::PyValueError, prelude::*};

use crate::arrays::{numbers, tuple};
use crate::job::{self, GivenStudy, SEEDS, Tolerances, Whole, run, within};
use crate::machine::Machine;
use crate::part::analysis;
use crate::report::Make;

impl Machine {
    /// Returns the analysis of the machine with its changes and default options.
    pub(crate) fn job(
        &self,
        study: Option<&Path>,
        study_text: Option<&str>,
        tolerances: &[String],
        notes: &mut dyn Notes,
    ) -> Result<Analyze> {
        let mut study = job::study(study, study_text, &self.unchanged)?;
        study.limit(tolerances, &self.unchanged.spec)?;
        let mut job = Analyze::new(self.unchanged.clone(), study);
        self.changes()?.iter().for_each(|changes| job.change(changes, notes));
        Ok(job)
    }

    /// Returns the rows of configurations of an argument.
    fn configurations(&self, q: &Bound<'_, PyAny>) -> PyResult<Vec<Vec<f64>>> {
        let array = numbers(q, "q", Some(self.variable_names.bind(q.py())))?;
        let (values, count) = (array.as_slice()?, self.machine.spec.variables.len());
        if array.shape().len() > 2 || array.shape().last() != Some(&count) || values.is_empty() {
            let shape = tuple(array.shape());
            let message = format!("`q` has shape {shape}: give configurations (m, {count}), one or more");
            return Err(PyValueError::new_err(message));
        }
        if !values.iter().all(|value| value.is_finite()) {
            return Err(PyValueError::new_err("`q` has a number that is not finite"));
        }
        Ok(values.chunks_exact(count).map(<[f64]>::to_vec).collect())
    }

    /// Returns the question of an analysis with the texts of its files and default options.
    fn question(&self, study: Option<&Path>, study_text: Option<&str>) -> Result<AnalysisRequest> {
        let folder = self.unchanged.file.as_deref().and_then(Path::parent);
        let spec_text = self.text.clone().map(|text| FileText {
            name: self.unchanged.origin.clone(),
            folder: folder.map(|folder| folder.to_string_lossy().into_owned()),
            text,
        });
        let mut question = AnalysisRequest {
            spec_text,
            changes: self.changes.clone(),
            ..AnalysisRequest::new(&self.unchanged, study)?
        };
        if let (Some(text), None) = (study_text, study) {
            let name = "study_text".to_owned();
            question.study = Some(FileText { name, folder: None, text: text.to_owned() });
        }
        Ok(question)
    }
}

/// Analyzes again, and returns a row for each configuration: its joints and what else varies, the
/// ideal tool point, and its displacements by each source, by all repeatable and all random ones.
fn rows(job: &Analyze) -> Result<Table> {
    let spec = &job.machine().spec;
    let (parameters, inputs) = (job.varying(), job.moving_inputs());
    let joints = spec.variables.iter().map(|one| &one.name);
    let varying = parameters.iter().map(|i| &spec.parameters[*i].name);
    let varying = varying.chain(inputs.iter().map(|i| &spec.inputs[*i].name));
    let mut heading = vec!["configuration".to_owned()];
    heading.extend(joints.chain(varying).cloned());
    let sources = spec.enabled_sources().map(|source| source.name.as_str());
    for what in ["ideal"].into_iter().chain(sources).chain(["repeatable", "random"]) {
        heading.extend(["x", "y", "z"].map(|axis| format!("{what} {axis}")));
    }
    let mut rows = Vec::new();
    let mut keep = |row: &Row| {
        let at = row.configuration;
        let varying = parameters.iter().map(|i| at.s[*i]).chain(inputs.iter().map(|i| at.u[*i]));
        let moved = row.sources.iter().chain([&row.repeatable, &row.random]).flat_map(|moved| &moved[..3]);
        let first = iter::once(row.index as f64).chain(at.q.iter().copied());
        let numbers = first.chain(varying).chain(row.pose.position()).chain(moved.copied());
        rows.push(numbers.map(Some).collect());
    };
    job.run_with_rows(Some(&mut keep), &mut ())?;
    Ok(Table { heading, rows, ..Table::default() })
}

#[pymethods]
impl Machine {
    /// Computes the errors of every source, and of all sources together, over a workspace, and the
    /// verdict on the tolerances of the study.
    ///
    /// `study`: path of a study file, or a study as a dict; `study_text`: its text. Without both:
    /// the study beside the spec, or the study shipped with the manipulator, or joint samples.
    /// `tolerance`: in place of that of the study, a text such as `"0.3 mm"` or `"0.5 mrad"`, or
    /// both in a list. `q`: configurations (m, nq) in place of the study's workspace, with nominal
    /// inputs. `monte_carlo`: number of draws at the worst configuration and at home. `seed`: of
    /// the draws and of the study's random samples. `figures`: collect data for `.report(folder)`
    /// and `.figure(name)`.
    ///
    /// `.table("configurations")` has the configurations, the ideal tool point, and its
    /// displacements by each source. Lengths are in the unit of the spec, angles in rad. Fields:
    /// `abbe.reports.AnalyzeReport`.
    ///
    /// >>> import abbe
    /// >>> report = abbe.load("pps").analyze()
    /// >>> print(f"{report.combined.radius:.3f}")
    /// 5.480
    ///
    /// With `shard=(i, n)`, i from 1 to n, computes part i of n of the workspace and returns a
    /// Part; `abbe.merge` of all parts is the report.
    #[pyo3(signature = (study=None, *, study_text=None, q=None, tolerance=None, monte_carlo=0, seed=None, figures=true, shard=None, threads=None, progress=None))]
    fn analyze<'py>(
        &self,
        py: Python<'py>,
        study: Option<GivenStudy>,
        study_text: Option<&str>,
        q: Option<&Bound<'py, PyAny>>,
        tolerance: Option<Tolerances>,
        monte_carlo: Whole,
        seed: Option<Whole>,
        figures: bool,
        shard: Option<(Whole, Whole)>,
        threads: Option<Whole>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (study, study_text) = GivenStudy::or_text(study, study_text);
        let q = q.map(|q| self.configurations(q)).transpose()?;
        let tolerances = Tolerances::texts(tolerance);
        let monte_carlo = Some(monte_carlo).filter(|draws| *draws != 0);
        let monte_carlo = monte_carlo.map(|draws| within("monte_carlo", draws, DRAWS)).transpose()?;
        let seed = seed.map(|seed| within("seed", seed, SEEDS)).transpose()?;
        if let Some((number, of)) = shard {
            if q.is_some() {
                return Err(PyValueError::new_err(
                    "`shard` divides a workspace, and `q` is none: give one of them",
                ));
            }
            let [number, of] = [number, of].map(|one| u32::try_from(one).unwrap_or_default());
            let shard = Shard::new(number, of)
                .map_err(|message| PyValueError::new_err(format!("`shard`: {message}")))?;
            let (part, _) = run(py, threads, progress, |notes| {
                let question = self.question(study.as_deref(), study_text.as_deref())?;
                Part::new(
                    AnalysisRequest { tolerances, monte_carlo, seed, figures, ..question },
                    shard,
                    notes,
                )
            })?;
            return Ok(Bound::new(py, crate::part::Part(part))?.into_any());
        }
        let ((report, job, has_q), notes) = run(py, threads, progress, |notes| {
            let mut job = self.job(study.as_deref(), study_text.as_deref(), &tolerances, notes)?;
            let has_q = q.is_some();
            if let Some(q) = q {
                job.restrict(q, notes);
            }
            job.monte_carlo = monte_carlo;
            job.seed = seed;
            job.figures = figures;
            Ok((job.run(notes)?, job, has_q))
        })?;
        let again = job.clone();
        let text = (study_text.is_some() || has_q).then(String::new);
        let study = text.or_else(|| study.map(|study| study.to_string_lossy().into_owned()));
        let live = Explore { analysis: Cow::Owned(job), study, residuals: None };
        let rows: Make<Table> = Box::new(move || rows(&again));
        Ok(analysis(py, report, live, Some(rows), notes)?.into_bound(py).into_any())
    }
}
