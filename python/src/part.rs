//! Parts of an analysis, and their merged report.
//!
//! Report of an analysis, of one run or of merged parts.

use std::{borrow::Cow, path::PathBuf, sync::Arc};

use abbe_metrology::data::Table;
use abbe_report::budget;
use abbe_study::{analyze, analyze::parts, explore::Explore};
use pyo3::exceptions::{PyFileExistsError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::job::Whole;
use crate::report::Make;
use crate::{Report, guarded, run, spec_error};

/// Part of an analysis, from `Machine.analyze(…, shard=(i, n))` or `Part.load`. It can be pickled;
/// `abbe.merge` of all parts is the report.
#[pyclass(frozen, module = "abbe")]
pub(crate) struct Part(pub(crate) parts::Part);

#[pymethods]
impl Part {
    /// Reads a part file, written by `save` or by `abbe analyze --shard`.
    #[staticmethod]
    fn load(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        let read = guarded(|| Ok(py.detach(|| parts::Part::read(&file))))?;
        Ok(Self(read.map_err(|mistakes| spec_error(py, &mistakes))?))
    }

    /// Writes the part to a file for `Part.load` or `abbe merge`. Raises FileExistsError if the
    /// file exists, unless `overwrite` is true.
    #[pyo3(signature = (file, *, overwrite=false))]
    fn save(&self, py: Python<'_>, file: PathBuf, overwrite: bool) -> PyResult<()> {
        if !overwrite && file.exists() {
            return Err(PyFileExistsError::new_err(format!("{} is there already", file.display())));
        }
        let bytes = guarded(|| Ok(py.detach(|| self.0.to_bytes())))?;
        // Written to a temporary file and renamed: a concurrent merge never reads a partial file.
        let mut name = file.file_name().unwrap_or_default().to_owned();
        name.push(format!(".{}.tmp", std::process::id()));
        let beside = file.with_file_name(name);
        let written = std::fs::write(&beside, bytes).and_then(|()| std::fs::rename(&beside, &file));
        written.inspect_err(|_| _ = std::fs::remove_file(&beside))?;
        Ok(())
    }

    /// Number of the part, from 1 on, and number of parts.
    #[getter]
    fn shard(&self) -> (u32, u32) {
        (self.0.shard().number(), self.0.shard().count())
    }

    /// Number of configurations reached.
    #[getter]
    fn configurations(&self) -> usize {
        self.0.configurations()[0]
    }

    /// Number of unreachable configurations.
    #[getter]
    fn unreachable(&self) -> usize {
        self.0.configurations()[1]
    }

    fn __repr__(&self) -> String {
        let [reached, _] = self.0.configurations();
        format!("Part({} of '{}': {reached} configurations)", self.0.shard(), self.0.spec())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let restore = py.import("abbe._abbe")?.getattr("_part")?;
        let bytes = guarded(|| Ok(py.detach(|| self.0.to_bytes())))?;
        Ok((restore, (PyBytes::new(py, &bytes),)))
    }
}

/// Recreates a pickled part.
#[pyfunction]
#[pyo3(name = "_part")]
pub(crate) fn restore(py: Python<'_>, bytes: &[u8]) -> PyResult<Part> {
    let read = guarded(|| Ok(parts::Part::from_bytes("part", bytes)))?;
    Ok(Part(read.map_err(|mistakes| spec_error(py, &mistakes))?))
}

/// Merges all parts of an analysis, in any order. The report is byte for byte that of a single
/// `Machine.analyze`.
///
/// `parts`: Parts, or paths of their files. Raises SpecError if parts are missing, duplicate,
/// damaged or from different analyses.
///
/// >>> import abbe
/// >>> pps = abbe.load("pps")
/// >>> report = abbe.merge(pps.analyze(shard=(i, 3)) for i in (1, 2, 3))
/// >>> report.to_json() == pps.analyze().to_json()
/// True
#[pyfunction]
#[pyo3(signature = (parts, *, threads=None, progress=None))]
pub(crate) fn merge(
    py: Python<'_>,
    parts: &Bound<'_, PyAny>,
    threads: Option<Whole>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Py<Report>> {
    let mut named = Vec::new();
    for (i, part) in parts.try_iter()?.enumerate() {
        let part = part?;
        named.push(match part.cast::<Part>() {
            Ok(part) => (format!("parts[{i}]"), part.get().0.clone()),
            Err(_) => {
                let file: PathBuf = part.extract().map_err(|_| {
                    PyTypeError::new_err(format!("parts[{i}] is neither a Part nor the path of one"))
                })?;
                (file.display().to_string(), Part::load(py, file)?.0)
            }
        });
    }
    let ((report, live), notes) = run(py, threads, progress, |notes| {
        let merge = parts::Merge::new(named, notes)?;
        let live =
            Explore { analysis: Cow::Owned(merge.job().clone()), study: merge.study(), residuals: None };
        Ok((merge.report(notes)?, live))
    })?;
    analysis(py, report, live, None, notes)
}

/// Creates the report of an analysis, with its text, tables and pages. `live` is the job of the
/// page's live panel.
pub(crate) fn analysis(
    py: Python<'_>,
    report: analyze::Report,
    live: Explore<'static>,
    rows: Option<Make<Table>>,
    notes: Vec<String>,
) -> PyResult<Py<Report>> {
    let report = Arc::new(report);
    let drawn = Arc::clone(&report);
    let found = Report::from_document("analyze", &report, notes, budget)?.with_made_rows(rows);
    let found = found.with_figures(move || abbe_report::figures(&drawn)).with_pages(move || {
        let files = abbe_report::analysis(&report, Some(&live.run(&mut ())?));
        Ok(files.into_iter().map(|file| (file.name, file.text)).collect())
    });
    found.create(py)
}
