//! What a job found, as an object of Python's.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use abbe_report::Picture;
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::data;
use pyo3::exceptions::{PyAttributeError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use serde::Serialize;
use serde_json::Value;

use crate::failure::{guarded, spec_error};
use crate::machine::{Machine, restore};
use crate::table::Table;

/// Files of a report: their names and texts.
pub(crate) type Pages = Vec<(String, String)>;

/// Makes something, when it is asked for.
type Make<T> = Box<dyn Fn() -> Result<T, Diagnostics> + Send + Sync>;

/// What a job found: its fields have the names of `abbe … --json`, nested ones too. `print` shows the same text as the command.
#[pyclass(frozen, module = "abbe")]
pub(crate) struct Report {
    kind: &'static str,
    json: String,
    text: Box<dyn Fn() -> String + Send + Sync>,
    html: Option<String>,
    notes: Vec<String>,
    pages: Option<Make<Pages>>,
    figures: Option<Box<dyn Fn() -> Vec<Picture> + Send + Sync>>,
    rows: Option<data::Table>,
    /// Which of its pages is a spec.
    spec: Option<String>,
    fields: PyOnceLock<Py<PyAny>>,
}

impl Report {
    /// A report with its fields and its text.
    pub(crate) fn new<R: Serialize + Send + Sync + 'static>(
        kind: &'static str,
        report: &Arc<R>,
        notes: Vec<String>,
        text: impl Fn(&R) -> String + Send + Sync + 'static,
    ) -> PyResult<Self> {
        let json = serde_json::to_string(&**report);
        let json = json.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        let report = Arc::clone(report);
        let (text, fields) = (Box::new(move || text(&report)), PyOnceLock::new());
        let (html, pages, figures, rows, spec) = (None, None, None, None, None);
        Ok(Self { kind, json, text, html, notes, pages, figures, rows, spec, fields })
    }

    /// With tables for notebooks.
    pub(crate) fn with_html(self, html: String) -> Self {
        Self { html: Some(html), ..self }
    }

    /// With files.
    pub(crate) fn with_pages(
        self,
        pages: impl Fn() -> Result<Pages, Diagnostics> + Send + Sync + 'static,
    ) -> Self {
        Self { pages: Some(Box::new(pages)), ..self }
    }

    /// One of its pages is a spec.
    pub(crate) fn with_spec(self, page: &str) -> Self {
        Self { spec: Some(page.to_owned()), ..self }
    }

    /// With figures.
    pub(crate) fn with_figures(self, figures: impl Fn() -> Vec<Picture> + Send + Sync + 'static) -> Self {
        Self { figures: Some(Box::new(figures)), ..self }
    }

    /// With a table of rows, which are not among the fields.
    pub(crate) fn with_rows(self, rows: data::Table) -> Self {
        Self { rows: Some(rows), ..self }
    }

    /// All that is a table: what it is called, and its rows.
    fn lists(&self) -> PyResult<Vec<(String, Vec<Value>)>> {
        let mut found = Vec::new();
        let fields = serde_json::from_str(&self.json);
        gather("", fields.map_err(|error| PyRuntimeError::new_err(error.to_string()))?, &mut found);
        Ok(found)
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

    /// The manipulator that was imported, identified, or corrected by the doctor, as `abbe.load` gives it; ValueError if there is none.
    fn load(&self, py: Python<'_>) -> PyResult<Machine> {
        let pages = self.pages(py)?;
        match pages.into_iter().find(|(name, _)| self.spec.as_ref() == Some(name)) {
            Some((name, text)) => restore(py, &name, Some(text), Vec::new()),
            None => Err(PyValueError::new_err(format!("a report of {} has no spec", self.kind))),
        }
    }

    /// The figures by their names: notebooks show them, `.svg` is the picture, `.scene` what is drawn as plain data.
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        let Some(make) = &self.figures else { return Ok(found) };
        let pictures = guarded(|| Ok(py.detach(make)))?;
        let figure = py.import("abbe._fields")?.getattr("Figure")?;
        for Picture { name, scene, svg } in pictures {
            let data =
                serde_json::to_string(&scene).map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
            found.set_item(name, figure.call1((scene.title, svg, data))?)?;
        }
        Ok(found)
    }

    /// One figure, which notebooks show. `.svg` is its text; `.scene` is what is drawn as plain data: its panels, each with axes and
    /// marks (lines, points, bands, bars, surfaces), all numbers in the units of the axes.
    fn figure<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let figures = self.figures(py)?;
        figures.get_item(name)?.ok_or_else(|| {
            let known: Vec<String> = figures.keys().iter().map(|name| name.to_string()).collect();
            none_of("figure", name, &known)
        })
    }

    /// The names of its tables: lists of fields that are alike, and `rows` where it has a row for each of what was measured.
    fn tables(&self) -> PyResult<Vec<String>> {
        let rows = self.rows.iter().map(|_| "rows".to_owned());
        let lists = self.lists()?.into_iter().filter(|(_, rows)| !rows.is_empty());
        Ok(rows.chain(lists.map(|(name, _)| name)).collect())
    }

    /// One table, for any reader of Arrow, without a copy. A list that is empty here is a table without rows and columns.
    ///
    /// >>> import abbe
    /// >>> ledger = abbe.load("pps").analyze().table("ledger.sources")
    /// >>> len(ledger), ledger.columns
    /// (7, ('name', 'max', 'rms', 'share_of_tolerance', 'class', 'rank'))
    fn table(&self, name: &str) -> PyResult<Table> {
        if let Some(rows) = self.rows.as_ref().filter(|_| name == "rows") {
            return Table::new(rows);
        }
        match self.lists()?.into_iter().find(|(known, _)| known == name) {
            Some((_, rows)) => Table::of_fields(&rows),
            None => Err(none_of("table", name, &self.tables()?)),
        }
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
        let own = ["figure", "figures", "load", "notes", "report", "table", "tables", "to_dict", "to_json"]
            .map(str::to_owned);
        let fields: Vec<String> = self.fields(py)?.call_method0("__dir__")?.extract()?;
        Ok(own.into_iter().chain(fields).collect())
    }

    fn _repr_html_(&self) -> Option<&str> {
        self.html.as_deref()
    }

    fn __str__(&self, py: Python<'_>) -> PyResult<String> {
        guarded(|| Ok(py.detach(&self.text)))
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

/// Every list of fields, by the names of the fields on the way to it; an empty list may have been one.
fn gather(before: &str, value: Value, found: &mut Vec<(String, Vec<Value>)>) {
    match value {
        Value::Object(fields) => {
            let dot = if before.is_empty() { "" } else { "." };
            fields
                .into_iter()
                .for_each(|(name, value)| gather(&format!("{before}{dot}{name}"), value, found));
        }
        Value::Array(rows) if rows.iter().all(Value::is_object) => found.push((before.to_owned(), rows)),
        _ => {}
    }
}

fn none_of(what: &str, name: &str, known: &[String]) -> PyErr {
    PyValueError::new_err(format!("there is no {what} `{name}`; {what}s: {}", known.join(", ")))
}
