//! Report of a job as a Python object.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use abbe_metrology::data;
use abbe_report::{Document, Picture, text::Detail};
use abbe_study::Result;
use pyo3::exceptions::{PyAttributeError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use serde::Serialize;
use serde_json::Value;

use crate::explore::page;
use crate::failure::{guarded, spec_error};
use crate::job::{Whole, run};
use crate::machine::{Machine, restore as restore_machine};
use crate::table::Table;

/// Largest number of configurations whose errors a pickled report keeps.
const MOST_PICKLED: u64 = 100_000;

/// Files of a report: names and texts.
pub(crate) type Pages = Vec<(String, String)>;

/// Function that builds a part of the report on demand.
pub(crate) type Make<T> = Box<dyn Fn() -> Result<T> + Send + Sync>;

/// Figure: name, title, picture, and content as JSON.
type Figure = (String, String, String, String);

/// Heading, units, rows and labels of a table.
type Rows = (Vec<String>, Vec<String>, Vec<Vec<Option<f64>>>, Vec<String>);

/// Content of a pickled report.
type Saved =
    (String, String, [String; 2], Vec<String>, Option<Pages>, Option<String>, Vec<Figure>, Option<Rows>);

/// Result of a job. Its fields, also nested ones, have the names of the JSON report and are
/// described by its class in `abbe.reports`; `print` shows the answer on one screen, `full()` every
/// table.
#[pyclass(frozen, subclass, module = "abbe")]
pub(crate) struct Report {
    kind: String,
    json: String,
    text: Box<dyn Fn(Detail) -> String + Send + Sync>,
    messages: Vec<String>,
    pages: Option<Make<Pages>>,
    figures: Option<Box<dyn Fn() -> Vec<Figure> + Send + Sync>>,
    /// Table that is not among the fields.
    rows: Option<Make<data::Table>>,
    /// Name of the page that is a spec.
    spec: Option<String>,
    fields: PyOnceLock<Py<PyAny>>,
}

impl Report {
    /// Creates a report with its fields, and the text and the sentences of its document.
    pub(crate) fn from_document<R: Serialize + Send + Sync + 'static>(
        kind: &str,
        report: &Arc<R>,
        messages: Vec<String>,
        document: impl Fn(&R) -> Document + Send + Sync + 'static,
    ) -> PyResult<Self> {
        let json = serde_json::to_string(&document(report).worded(&**report)).map_err(failed)?;
        let text = move |report: &R, detail| document(report).text(detail);
        Ok(Self { json, ..Self::new(kind, report, messages, text)? })
    }

    /// Creates a report with its fields and its text.
    pub(crate) fn new<R: Serialize + Send + Sync + 'static>(
        kind: &str,
        report: &Arc<R>,
        messages: Vec<String>,
        text: impl Fn(&R, Detail) -> String + Send + Sync + 'static,
    ) -> PyResult<Self> {
        let json = serde_json::to_string(&**report).map_err(failed)?;
        let report = Arc::clone(report);
        let text = Box::new(move |detail| text(&report, detail));
        let fields = PyOnceLock::new();
        let (pages, figures, rows, spec) = (None, None, None, None);
        Ok(Self { kind: kind.to_owned(), json, text, messages, pages, figures, rows, spec, fields })
    }

    /// Creates the Python object, of the class of `abbe.reports` that has the fields of its kind.
    pub(crate) fn create(self, py: Python<'_>) -> PyResult<Py<Self>> {
        let class = class(py, &self.kind)?;
        let report = Bound::new(py, self)?;
        // A subclass without slots, whose instances Rust cannot create.
        report.setattr("__class__", class)?;
        Ok(report.unbind())
    }

    /// Adds files.
    pub(crate) fn with_pages(self, pages: impl Fn() -> Result<Pages> + Send + Sync + 'static) -> Self {
        Self { pages: Some(Box::new(pages)), ..self }
    }

    /// Marks one of the pages as a spec.
    pub(crate) fn with_spec(self, page: &str) -> Self {
        Self { spec: Some(page.to_owned()), ..self }
    }

    /// Adds figures.
    pub(crate) fn with_figures(self, figures: impl Fn() -> Vec<Picture> + Send + Sync + 'static) -> Self {
        let figure = |Picture { name, scene, svg }| {
            // Scenes have names and numbers, which have a form in JSON.
            let content = serde_json::to_string(&scene).unwrap_or_default();
            (name, scene.title, svg, content)
        };
        Self { figures: Some(Box::new(move || figures().into_iter().map(figure).collect())), ..self }
    }

    /// Adds a table of rows, which are not among the fields.
    pub(crate) fn with_rows(self, rows: data::Table) -> Self {
        self.with_made_rows(Some(Box::new(move || Ok(rows.clone()))))
    }

    /// Adds a table of rows that are computed when they are asked for.
    pub(crate) fn with_made_rows(self, rows: Option<Make<data::Table>>) -> Self {
        Self { rows, ..self }
    }

    /// Returns the name of the rows.
    fn rows_name(&self) -> &'static str {
        if self.kind == "analyze" { "configurations" } else { "rows" }
    }

    /// Returns the rows, if the report has any.
    fn rows(&self, py: Python<'_>) -> PyResult<Option<data::Table>> {
        self.rows.as_ref().map(|make| Ok(run(py, None, None, |_| make())?.0)).transpose()
    }

    /// Returns the name and the rows of every field that is a table.
    fn lists(&self) -> PyResult<Vec<(String, Vec<Value>)>> {
        let mut found = Vec::new();
        let fields = serde_json::from_str(&self.json);
        gather("", fields.map_err(failed)?, &mut found);
        Ok(found)
    }

    fn fields<'py>(&self, py: Python<'py>) -> PyResult<&Bound<'py, PyAny>> {
        let read = || {
            let read = py.import("abbe._fields")?.getattr("fields")?;
            PyResult::Ok(read.call1((&self.json, class(py, &self.kind)?))?.unbind())
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
    /// Notes and warnings of the job, in the order in which it gave them.
    #[getter]
    fn messages(&self) -> Vec<String> {
        self.messages.clone()
    }

    /// Sentences of the report by their names, which stay: `answer` is the first line of its text.
    #[getter]
    fn statements(&self) -> PyResult<BTreeMap<String, String>> {
        let fields: Value = serde_json::from_str(&self.json).map_err(failed)?;
        serde_json::from_value(fields.get("statements").cloned().unwrap_or_default()).or(Ok(BTreeMap::new()))
    }

    /// Returns all fields as plain dicts, lists, numbers and texts.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (&self.json,))
    }

    /// Returns every table and every sentence as text.
    fn full(&self, py: Python<'_>) -> PyResult<String> {
        guarded(|| Ok(py.detach(|| (self.text)(Detail::Full))))
    }

    /// Returns the JSON report of the command as one line.
    fn to_json(&self) -> &str {
        &self.json
    }

    /// Writes pages and figures into a folder, which is made if necessary. Returns the file names.
    /// Raises FileExistsError if a file exists, unless `overwrite` is true.
    #[pyo3(signature = (folder, *, overwrite=false))]
    fn report(&self, py: Python<'_>, folder: PathBuf, overwrite: bool) -> PyResult<Vec<String>> {
        py.import("abbe._fields")?.call_method1("write", (self.pages(py)?, folder, overwrite))?.extract()
    }

    /// Returns the page of the report, which notebooks show in a frame of this height in pixels.
    /// Its head is a live page of the machine.
    #[pyo3(signature = (*, height=900))]
    fn explore<'py>(&self, py: Python<'py>, height: Whole) -> PyResult<Bound<'py, PyAny>> {
        let pages = if self.pages.is_some() { self.pages(py)? } else { Vec::new() };
        match pages.into_iter().find(|(name, _)| name.ends_with(".html")) {
            Some((_, html)) => page(py, &format!("report of {}", self.kind), &html, height),
            None => Err(PyValueError::new_err(format!("a report of {} has no page", self.kind))),
        }
    }

    /// Returns the machine that was imported, identified, or corrected by the doctor. Raises
    /// ValueError if the report has none.
    fn load(&self, py: Python<'_>) -> PyResult<Machine> {
        match self.pages(py)?.into_iter().find(|(name, _)| self.spec.as_ref() == Some(name)) {
            Some((name, text)) => restore_machine(py, &name, Some(text), "[]"),
            None => Err(PyValueError::new_err(format!("a report of {} has no spec", self.kind))),
        }
    }

    /// Returns the figures by name. Notebooks show them; `.svg` is the picture, `.scene` its
    /// content as plain data.
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        let Some(make) = &self.figures else { return Ok(found) };
        let figure = py.import("abbe._fields")?.getattr("Figure")?;
        for (name, title, svg, content) in guarded(|| Ok(py.detach(make)))? {
            found.set_item(name, figure.call1((title, svg, content))?)?;
        }
        Ok(found)
    }

    /// Returns one figure, which notebooks show. `.svg` is the picture; `.scene` is its content as
    /// plain data: panels with axes and marks (lines, points, bands, bars, surfaces), all numbers
    /// in the units of the axes.
    fn figure<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let figures = self.figures(py)?;
        figures.get_item(name)?.ok_or_else(|| {
            let known: Vec<String> = figures.keys().iter().map(|name| name.to_string()).collect();
            none_of("figure", name, &known)
        })
    }

    /// Returns the names of the tables: fields that are lists of records; `rows` if the report has
    /// one row per measurement; `configurations`, the errors at each configuration of an analysis,
    /// which are computed again when they are asked for; and the `covariance` of an identification.
    fn tables(&self) -> PyResult<Vec<String>> {
        let mut names: Vec<String> = self.rows.iter().map(|_| self.rows_name().to_owned()).collect();
        let lists = self.lists()?.into_iter().filter(|(_, rows)| !rows.is_empty());
        names.extend(lists.map(|(name, _)| name));
        names.extend((self.kind == "identify").then(|| "covariance".to_owned()));
        // Rows of measurements come first, configurations last.
        names.rotate_left(usize::from(self.kind == "analyze" && self.rows.is_some()));
        Ok(names)
    }

    /// (p, p): covariance of the identified errors of the machine, relative to base and target, in
    /// the length unit and rad. The first column of `table("covariance")` has the names of its rows
    /// and columns: those of `Machine.columns`, `e_x0` … of the base, and names of sources.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let table =
            self.table(py, "covariance").map_err(|error| PyAttributeError::new_err(error.to_string()))?;
        py.import("abbe._arrays")?.call_method1("matrix", (table,))
    }

    /// Returns one table, which any Arrow reader takes without a copy. An empty list is a table
    /// without rows and columns.
    ///
    /// >>> import abbe
    /// >>> ledger = abbe.load("pps").analyze().table("ledger.sources")
    /// >>> len(ledger), ledger.columns
    /// (7, ('name', 'max', 'rms', 'share_of_tolerance', 'share', 'factor', 'class', 'rank'))
    fn table(&self, py: Python<'_>, name: &str) -> PyResult<Table> {
        if name == self.rows_name()
            && let Some(rows) = self.rows(py)?
        {
            return Table::new(&rows);
        }
        if name == "covariance" && self.kind == "identify" {
            return Table::new(&self.load(py)?.covariances());
        }
        match self.lists()?.into_iter().find(|(known, _)| known == name) {
            Some((_, rows)) => Table::from_records(&rows),
            None => Err(none_of("table", name, &self.tables()?)),
        }
    }

    fn __getattr__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        if !name.starts_with("_") {
            if let Ok(field) = self.fields(py)?.getattr(name) {
                return Ok(field);
            }
            // A field that does not apply to this report.
            if class(py, &self.kind)?.getattr("__annotations__")?.contains(name)? {
                return Ok(py.None().into_bound(py));
            }
        }
        Err(PyAttributeError::new_err(format!("a report of {} has no field `{name}`", self.kind)))
    }

    fn __dir__(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let own = py.get_type::<Self>().getattr("__dict__")?;
        py.import("abbe._fields")?.call_method1("names", (own, self.fields(py)?))?.extract()
    }

    /// Shows the first screen, and all tables below a heading that opens them.
    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        if self.kind == "simulate"
            && let Some(rows) = self.rows(py)?
        {
            // Its text is a file.
            let table = Table::new(&rows)?.html(py)?;
            return Ok(format!("<div><strong>{} simulated rows</strong>{table}</div>", rows.rows.len()));
        }
        guarded(|| {
            Ok(py.detach(|| abbe_report::notebook(&(self.text)(Detail::Answer), &(self.text)(Detail::Full))))
        })
    }

    /// Keeps the texts, pages and figures, which need the job, as they are now.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Saved,))> {
        let text = |detail| guarded(|| Ok(py.detach(|| (self.text)(detail))));
        let figures = self.figures.as_ref().map_or(Ok(Vec::new()), |make| guarded(|| Ok(py.detach(make))))?;
        let fields: Value = serde_json::from_str(&self.json).map_err(failed)?;
        let is_large = fields["configurations"].as_u64().is_some_and(|count| count > MOST_PICKLED);
        let rows = if is_large { None } else { self.rows(py)? };
        let saved = (
            self.kind.clone(),
            self.json.clone(),
            [text(Detail::Answer)?, text(Detail::Full)?],
            self.messages.clone(),
            // Pages that cannot be made are left out.
            self.pages.as_ref().and_then(|_| self.pages(py).ok()),
            self.spec.clone(),
            figures,
            rows.map(|rows| (rows.heading, rows.units, rows.rows, rows.labels)),
        );
        Ok((py.import("abbe._abbe")?.getattr("_report")?, (saved,)))
    }

    fn __str__(&self, py: Python<'_>) -> PyResult<String> {
        guarded(|| Ok(py.detach(|| (self.text)(Detail::Answer))))
    }

    fn __repr__(&self) -> String {
        format!("<abbe report of {}>", self.kind)
    }
}

/// Recreates a pickled report.
#[pyfunction]
#[pyo3(name = "_report")]
pub(crate) fn restore(py: Python<'_>, saved: Saved) -> PyResult<Py<Report>> {
    let (kind, json, [answer, full], messages, pages, spec, figures, rows) = saved;
    let text = move |detail| if detail == Detail::Full { full.clone() } else { answer.clone() };
    let report = Report {
        kind,
        json,
        text: Box::new(text),
        messages,
        pages: pages.map(|pages| Box::new(move || Ok(pages.clone())) as Make<Pages>),
        figures: Some(Box::new(move || figures.clone())),
        rows: None,
        spec,
        fields: PyOnceLock::new(),
    };
    let rows = rows.map(|(heading, units, rows, labels)| data::Table { heading, units, rows, labels });
    rows.into_iter().fold(report, Report::with_rows).create(py)
}

/// Returns the class of `abbe.reports` for a kind of report.
fn class<'py>(py: Python<'py>, kind: &str) -> PyResult<Bound<'py, PyAny>> {
    let (first, rest) = kind.split_at(1);
    py.import("abbe.reports")?.getattr(format!("{}{rest}Report", first.to_uppercase()))
}

fn failed(error: serde_json::Error) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// Collects every list of records with the dotted path of its field. An empty list may be one, too.
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
