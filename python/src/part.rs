//! Parts of an analysis, and their report.

use std::path::PathBuf;

use abbe_study::analyze::parts;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::analyze::analysis;
use crate::failure::{guarded, spec_error};
use crate::job::run;
use crate::report::Report;

/// What was gathered over a share of a workspace: `Machine.analyze(…, shard=(i, n))`, or `Part.load` of a file of `abbe analyze
/// --shard`. It pickles; `abbe.merge` of all parts is the report.
#[pyclass(frozen, module = "abbe")]
pub(crate) struct Part(pub(crate) parts::Part);

#[pymethods]
impl Part {
    /// Reads the file of a part.
    #[staticmethod]
    fn load(py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        let read = guarded(|| Ok(py.detach(|| parts::Part::read(&file))))?;
        Ok(Self(read.map_err(|mistakes| spec_error(py, &mistakes))?))
    }

    /// Writes the part into a file, for `abbe merge` or `Part.load`; a file that is there is replaced.
    fn save(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        let bytes = guarded(|| Ok(py.detach(|| self.0.to_bytes())))?;
        // Whole or not at all: whoever merges never sees half of it.
        let mut name = file.file_name().unwrap_or_default().to_owned();
        name.push(format!(".{}.tmp", std::process::id()));
        let beside = file.with_file_name(name);
        let written = std::fs::write(&beside, bytes).and_then(|()| std::fs::rename(&beside, &file));
        written.inspect_err(|_| _ = std::fs::remove_file(&beside))?;
        Ok(())
    }

    /// Which share it is, from 1 on, and of how many.
    #[getter]
    fn shard(&self) -> (u32, u32) {
        (self.0.shard().number(), self.0.shard().of())
    }

    /// How many configurations were reached.
    #[getter]
    fn configurations(&self) -> usize {
        self.0.configurations()[0]
    }

    /// How many could not be reached.
    #[getter]
    fn unreachable(&self) -> usize {
        self.0.configurations()[1]
    }

    fn __repr__(&self) -> String {
        let [reached, _] = self.0.configurations();
        format!("Part({} of '{}': {reached} configurations)", self.0.shard(), self.0.question().spec)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let restore = py.import("abbe._abbe")?.getattr("_part")?;
        let bytes = guarded(|| Ok(py.detach(|| self.0.to_bytes())))?;
        Ok((restore, (PyBytes::new(py, &bytes),)))
    }
}

/// What pickle calls.
#[pyfunction]
#[pyo3(name = "_part")]
pub(crate) fn restore(py: Python<'_>, bytes: &[u8]) -> PyResult<Part> {
    let read = guarded(|| Ok(parts::Part::from_bytes("part", bytes)))?;
    Ok(Part(read.map_err(|mistakes| spec_error(py, &mistakes))?))
}

/// The report of an analysis from all its parts, in any order: the same, byte for byte, as that of one `Machine.analyze`.
///
/// `parts`: Parts, or paths of their files. Parts that are missing, twice, damaged or not of one analysis raise SpecError.
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
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Report> {
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
    let ((_, report), notes) =
        run(py, threads, progress, |notes| abbe_study::analyze::parts::merge(named, notes))?;
    analysis(report, notes)
}
