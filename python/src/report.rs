//! What a job found, as an object of Python's.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use abbe_codegen::diagnostic::Diagnostics;
use pyo3::exceptions::{PyAttributeError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use serde::Serialize;

use crate::failure::{guarded, spec_error};

/// Files of a report: their names and texts.
pub(crate) type Pages = Vec<(String, String)>;

/// Makes the files, when they are asked for.
type Make = Box<dyn Fn() -> Result<Pages, Diagnostics> + Send + Sync>;

/// What a job found: its fields have the names of `abbe … --json`, nested ones too. `str` of it is its text.
#[pyclass(frozen, module = "abbe")]
pub(crate) struct Report {
    kind: &'static str,
    json: String,
    text: Option<String>,
    html: Option<String>,
    notes: Vec<String>,
    pages: Option<Make>,
    fields: PyOnceLock<Py<PyAny>>,
}

impl Report {
    /// A report that is shown by its fields.
    pub(crate) fn new(kind: &'static str, report: &impl Serialize, notes: Vec<String>) -> PyResult<Self> {
        let json =
            serde_json::to_string(report).map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        Ok(Self { kind, json, notes, text: None, html: None, pages: None, fields: PyOnceLock::new() })
    }

    /// With a text, and tables for notebooks.
    pub(crate) fn shown(self, text: String, html: String) -> Self {
        Self { text: Some(text), html: Some(html), ..self }
    }

    /// With files.
    pub(crate) fn with_pages(
        self,
        pages: impl Fn() -> Result<Pages, Diagnostics> + Send + Sync + 'static,
    ) -> Self {
        Self { pages: Some(Box::new(pages)), ..self }
    }

    fn fields<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyAny>> {
        let read = || {
            let hook = PyDict::new(py);
            hook.set_item("object_hook", py.import("abbe._fields")?.getattr("Fields")?)?;
            PyResult::Ok(py.import("json")?.call_method("loads", (&self.json,), Some(&hook))?.unbind())
        };
        Ok(self.fields.get_or_try_init(py, read)?.bind(py))
    }

    fn pages(&self, py: Python<'_>) -> PyResult<Pages> {
        let Some(pages) = &self.pages else {
            return Err(PyValueError::new_err(format!("a report of {} has no pages", self.kind)));
        };
        guarded(|| py.detach(pages).map_err(|mistakes| spec_error(py, &mistakes)))
    }
}

#[pymethods]
impl Report {
    /// What was said on the way: notes and warnings.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    /// All fields, as plain dicts, lists, numbers and texts.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (&self.json,))
    }

    /// The same as the command prints with --json: one line.
    fn to_json(&self) -> &str {
        &self.json
    }

    /// Writes its pages and pictures into a folder, which is made; what is there already raises FileExistsError, unless `overwrite`.
    #[pyo3(signature = (folder, *, overwrite=false))]
    fn report(&self, py: Python<'_>, folder: PathBuf, overwrite: bool) -> PyResult<Vec<String>> {
        let pages = self.pages(py)?;
        py.detach(|| {
            fs::create_dir_all(&folder)?;
            let exists =
                pages.iter().map(|(name, _)| folder.join(name)).find(|path| !overwrite && path.exists());
            if let Some(path) = exists {
                let message = format!("{} is there already", path.display());
                return Err(std::io::Error::new(std::io::ErrorKind::AlreadyExists, message));
            }
            pages.iter().try_for_each(|(name, text)| write(&folder.join(name), text, overwrite))
        })?;
        Ok(pages.into_iter().map(|(name, _)| name).collect())
    }

    /// The figures as SVG, by their names.
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let figures = PyDict::new(py);
        for (name, text) in self.pages(py)? {
            if let Some(name) = name.strip_suffix(".svg") {
                figures.set_item(name, text)?;
            }
        }
        Ok(figures)
    }

    /// One figure: notebooks show it, `.svg` is its text.
    fn figure<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let figures = self.figures(py)?;
        let Some(svg) = figures.get_item(name)? else {
            let known: Vec<String> = figures.keys().iter().map(|name| name.to_string()).collect();
            return Err(PyValueError::new_err(format!(
                "there is no figure `{name}`; figures: {}",
                known.join(", ")
            )));
        };
        py.import("abbe._fields")?.call_method1("Figure", (svg,))
    }

    fn __getattr__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let missing =
            || PyAttributeError::new_err(format!("a report of {} has no field `{name}`", self.kind));
        if name.starts_with("_") {
            Err(missing())
        } else {
            self.fields(py)?.getattr(name).map_err(|_| missing())
        }
    }

    fn __dir__(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let own = ["figure", "figures", "notes", "report", "to_dict", "to_json"].map(str::to_owned);
        let fields: Vec<String> = self.fields(py)?.call_method0("__dir__")?.extract()?;
        Ok(own.into_iter().chain(fields).collect())
    }

    fn _repr_html_(&self) -> Option<&str> {
        self.html.as_deref()
    }

    fn __str__(&self, py: Python<'_>) -> PyResult<String> {
        match &self.text {
            Some(text) => Ok(text.clone()),
            None => py.import("abbe._fields")?.call_method1("text", (self.fields(py)?,))?.extract(),
        }
    }

    fn __repr__(&self) -> String {
        format!("<abbe report of {}>", self.kind)
    }
}

fn write(path: &Path, text: &str, overwrite: bool) -> std::io::Result<()> {
    let mut options = File::options();
    options.write(true).truncate(overwrite).create(overwrite).create_new(!overwrite);
    options.open(path)?.write_all(text.as_bytes())
}
