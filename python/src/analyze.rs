//! What every error source does over a workspace.
#![allow(clippy::too_many_arguments, reason = "keywords of Python")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use abbe_report::text;
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::analyze::options::DRAWS;
use abbe_study::analyze::parts::{Part, Question, Shard, Written};
use abbe_study::analyze::{self, Analyze};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::failure::guarded;
use crate::job::run;
use crate::machine::Machine;
use crate::options::{self, within};
use crate::report::Report;

impl Machine {
    /// What an analysis asks, with the texts of its files, and no options.
    fn question(&self, study: Option<&Path>, study_text: Option<&str>) -> Result<Question, Diagnostics> {
        let folder = self.unchanged.file.as_deref().and_then(Path::parent);
        let spec_text = self.text.clone().map(|text| Written {
            name: self.unchanged.origin.clone(),
            folder: folder.map(|folder| folder.to_string_lossy().into_owned()),
            text,
        });
        let mut question =
            Question { spec_text, changes: self.each_change(), ..Question::new(&self.unchanged, study)? };
        if let (Some(text), None) = (study_text, study) {
            let name = "study_text".to_owned();
            question.study = Some(Written { name, folder: None, text: text.to_owned() });
        }
        Ok(question)
    }
}

#[pymethods]
impl Machine {
    /// Every error source alone and all together, over a workspace: what leads, where, and whether a tolerance is met.
    ///
    /// `study`: a study file; `study_text`: the text of one; if neither is given, the one beside the spec or shipped with it, or
    /// else samples of the joints. `monte_carlo` draws at the worst configuration and at home. `figures` gathers what the pictures of
    /// `.report(folder)` and `.figure(name)` show. Lengths in the unit of the spec; fields as those of `abbe analyze --json`.
    ///
    /// >>> import abbe
    /// >>> report = abbe.load("pps").analyze()
    /// >>> print(f"{report.combined.radius:.3f}")
    /// 5.480
    ///
    /// With `shard=(i, n)`, i from 1 to n, one of n shares of the workspace is swept, and a Part is given: `abbe.merge` of all
    /// parts is the report.
    #[pyo3(signature = (study=None, *, study_text=None, monte_carlo=0, seed=None, figures=true, shard=None, threads=None, progress=None))]
    fn analyze<'py>(
        &self,
        py: Python<'py>,
        study: Option<PathBuf>,
        study_text: Option<&str>,
        monte_carlo: usize,
        seed: Option<u64>,
        figures: bool,
        shard: Option<(u32, u32)>,
        threads: Option<usize>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let monte_carlo = Some(monte_carlo).filter(|draws| *draws > 0);
        let monte_carlo = monte_carlo.map(|draws| within("monte_carlo", draws, DRAWS)).transpose()?;
        if let Some((number, of)) = shard {
            let shard = Shard::new(number, of)
                .map_err(|message| PyValueError::new_err(format!("`shard`: {message}")))?;
            let (part, _) = run(py, threads, progress, |notes| {
                let question = self.question(study.as_deref(), study_text)?;
                Part::new(Question { monte_carlo, seed, figures, ..question }, shard, notes)
            })?;
            return Ok(Bound::new(py, crate::part::Part(part))?.into_any());
        }
        let (report, notes) = run(py, threads, progress, |notes| {
            let machine = self.unchanged.clone();
            let study = options::study(study.as_deref(), study_text, &machine)?;
            let mut job = Analyze::new(machine, study);
            self.changes()?.iter().for_each(|changes| job.change(changes, notes));
            job.monte_carlo = monte_carlo;
            job.seed = seed;
            job.figures = figures;
            job.run(notes)
        })?;
        Ok(Bound::new(py, analysis(report, notes)?)?.into_any())
    }
}

/// The report of an analysis, with its text, its tables and its pages.
pub(crate) fn analysis(report: analyze::Report, notes: Vec<String>) -> PyResult<Report> {
    let tables = guarded(|| Ok(budget(&report)))?;
    let report = Arc::new(report);
    let drawn = Arc::clone(&report);
    let found = Report::new("analyze", &report, notes, text::analysis)?;
    let found = found.with_html(tables).with_figures(move || abbe_report::figures(&drawn));
    Ok(found.with_pages(move || {
        let files = abbe_report::analysis(&report);
        Ok(files.into_iter().map(|file| (file.name, file.text)).collect())
    }))
}

/// The ledger and the uncertainty budgets as tables.
fn budget(report: &analyze::Report) -> String {
    let ledgers = [Some(analyze::ledger(report)), analyze::turns(report)];
    let budgets = report
        .uncertainty_budgets()
        .flat_map(|budget| [analyze::contributions(report, budget), analyze::totals(report, budget)]);
    ledgers.into_iter().flatten().chain(budgets).map(|listing| abbe_report::listed(&listing)).collect()
}
