//! The class `Machine`: a manipulator and its functions.

use std::path::{Path, absolute};
use std::{iter, sync::OnceLock};

use abbe::{Function, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_metrology::data::Table;
use abbe_spec::edit::{Edits, write::quoted};
use abbe_spec::{Identified, Spec};
use abbe_study::{Changes, Result, analyze::parts::Change, changed_text};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyBool, PyDict, PyString, PyTuple};

use crate::failure::{guarded, spec_error};
use crate::job::toml;
use crate::layout::Layout;

/// Manipulator, read from a spec and ready to be evaluated. Immutable: methods that change it
/// return another machine.
///
/// Lengths are in the unit of the spec (`length`), angles in rad, everything in the base frame F_0.
/// `q` has one number per joint variable in the order of `variables`, or is a table with columns of
/// these names. Leading dimensions, written as …, are those of the result.
#[pyclass(frozen, module = "abbe")]
pub(crate) struct Machine {
    pub(crate) machine: abbe_study::Machine,
    /// The machine without changes.
    pub(crate) unchanged: abbe_study::Machine,
    pub(crate) interpreter: Interpreter,
    /// Nominal values of the parameters.
    pub(crate) parameters: Vec<f64>,
    pub(crate) variable_names: Py<PyTuple>,
    /// Text of the spec, unless it is a shipped one.
    pub(crate) text: Option<String>,
    /// Changes in the order of their application.
    pub(crate) changes: Vec<Change>,
    layouts: [OnceLock<Layout>; Function::COUNT],
}

/// Arguments of [`restore`].
type Restored<'a> = (&'a str, Option<&'a str>, String);

impl Machine {
    /// Creates a machine with changes. `same` is an interpreter of a spec that differs in the
    /// values of parameters and inputs only, if there is one.
    fn new(
        py: Python<'_>,
        unchanged: abbe_study::Machine,
        text: Option<String>,
        changes: Vec<Change>,
        same: Option<&Interpreter>,
    ) -> PyResult<Self> {
        let mut machine = unchanged.clone();
        for change in &changes {
            let changes = change.read(&machine.spec);
            machine.change(&changes.map_err(|mistakes| spec_error(py, &mistakes))?);
        }
        let interpreter = match same {
            Some(interpreter) => interpreter.with_values(machine.spec.clone()),
            None => Interpreter::new(machine.spec.clone()),
        };
        let description = interpreter.description();
        Ok(Self {
            parameters: description.parameters.iter().map(|parameter| parameter.nominal).collect(),
            variable_names: PyTuple::new(py, description.variables.iter().map(|one| &*one.name))?.unbind(),
            machine,
            unchanged,
            interpreter,
            text,
            changes,
            layouts: [const { OnceLock::new() }; Function::COUNT],
        })
    }

    /// Returns a machine with further changes.
    fn changed(&self, py: Python<'_>, more: Vec<Change>) -> PyResult<Self> {
        let named = |change: &Change| match change {
            Change::Number(value) | Change::Set(value) => value.split('=').next().map(str::to_owned),
            _ => None,
        };
        // A new value replaces the last one.
        let is_kept = |old: &&Change| named(old).is_none() || more.iter().all(|new| named(new) != named(old));
        let mut changes: Vec<Change> = self.changes.iter().filter(is_kept).cloned().collect();
        let same = more.iter().all(|new| named(new).is_some()).then_some(&self.interpreter);
        changes.extend(more);
        guarded(|| Self::new(py, self.unchanged.clone(), self.text.clone(), changes, same))
    }

    /// Reads the changes, one by one, for a job.
    pub(crate) fn changes(&self) -> Result<Vec<Changes>> {
        self.changes.iter().map(|change| change.read(&self.unchanged.spec)).collect()
    }

    /// Returns the text of the spec without changes.
    pub(crate) fn text(&self) -> Result<String> {
        self.text.clone().map_or_else(|| self.unchanged.text(), Ok)
    }

    /// Returns the covariance of an identified machine, with the names of its rows.
    pub(crate) fn covariances(&self) -> Table {
        let spec = &self.machine.spec;
        let name = |one: &Identified| match *one {
            Identified::Error(frame, component) => format!("{}{}", component.name(), frame + 1),
            Identified::Base(component) => format!("{}0", component.name()),
            Identified::Magnitude(source) => spec.sources[source].name.clone(),
            Identified::Joint(joint) => spec.variables[joint].name.clone(),
        };
        let labels: Vec<String> = spec.covariance.of.iter().map(name).collect();
        let heading = iter::once("error".to_owned()).chain(labels.iter().cloned()).collect();
        let rows = spec.covariance.rows.iter().map(|row| row.iter().copied().map(Some).collect()).collect();
        Table { heading, rows, labels, ..Table::default() }
    }

    pub(crate) fn layout(&self, function: Function) -> &Layout {
        self.layouts[function as usize].get_or_init(|| Layout::new(function, self.interpreter.description()))
    }
}

/// Returns the text of a spec in a folder with absolute paths of its tables, to be read anywhere.
fn anywhere(text: &str, folder: &Path) -> String {
    let edited = Edits::apply(text, |root, edits| {
        for table in root.get("tables")?.as_table()?.items() {
            let file = table.as_table().and_then(|table| table.get("file"));
            if let Some((path, item)) = file.and_then(|item| Some((item.text()?.to_owned(), item))) {
                edits.replace(item.span(), quoted(&absolute(folder.join(path)).ok()?.to_string_lossy()));
            }
        }
        Some(())
    });
    edited.unwrap_or_else(|| text.to_owned())
}

/// Finds a shipped manipulator or reads a spec file; with `text`, parses the text.
fn find_machine(origin: &str, text: Option<&str>) -> Result<abbe_study::Machine> {
    match text {
        None => abbe_study::Machine::find(origin),
        Some(text) => Ok(abbe_study::Machine::of_spec(Spec::parse_in(Path::new(""), origin, text)?, origin)),
    }
}

/// Loads a manipulator from a spec file, by a shipped name (see `abbe.shipped()`), from an
/// `abbe.spec.Manipulator`, or from the `text` of a spec.
///
/// Raises SpecError, with place and remedy, if the spec is wrong.
///
/// >>> import abbe
/// >>> abbe.load("pps")
/// Machine('pps': 6 frames, 6 joint variables, mm)
#[pyfunction]
#[pyo3(signature = (spec=None, *, text=None))]
pub(crate) fn load(
    py: Python<'_>,
    spec: Option<&Bound<'_, PyAny>>,
    text: Option<String>,
) -> PyResult<Machine> {
    guarded(|| match (spec, text) {
        (Some(spec), None) if spec.hasattr("to_toml")? => {
            let text = spec.call_method0("to_toml")?.extract()?;
            restore(py, "text", Some(text), "[]")
        }
        (Some(spec), None) => {
            let path: String = py.import("os")?.call_method1("fspath", (spec,))?.extract()?;
            let read = || {
                let machine = abbe_study::Machine::find(&path)?;
                let folder = machine.file.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
                let text = match machine.shipped {
                    Some(_) => None,
                    None => Some(anywhere(&machine.text()?, folder)),
                };
                Ok((machine, text))
            };
            let (machine, text) = py.detach(read).map_err(|mistakes| spec_error(py, &mistakes))?;
            Machine::new(py, machine, text, Vec::new(), None)
        }
        (None, Some(text)) => restore(py, "text", Some(text), "[]"),
        _ => Err(PyTypeError::new_err("give a spec file or a shipped name, or else text=…")),
    })
}

/// Recreates a pickled machine; see `Machine.__reduce__`.
#[pyfunction]
#[pyo3(name = "_restore")]
pub(crate) fn restore(
    py: Python<'_>,
    origin: &str,
    text: Option<String>,
    changes: &str,
) -> PyResult<Machine> {
    guarded(|| {
        let changes = serde_json::from_str(changes);
        let changes = changes.map_err(|error| PyValueError::new_err(error.to_string()))?;
        let machine = py.detach(|| find_machine(origin, text.as_deref()));
        let text = text.map(|text| anywhere(&text, Path::new("")));
        Machine::new(py, machine.map_err(|mistakes| spec_error(py, &mistakes))?, text, changes, None)
    })
}

/// Returns the names of the shipped manipulators that have compiled code; `load` also finds the
/// mechanisms that `abbe list` shows.
#[pyfunction]
pub(crate) fn shipped() -> Vec<&'static str> {
    SHIPPED.iter().map(|shipped| shipped.name).collect()
}

#[pymethods]
impl Machine {
    /// Name of the manipulator.
    #[getter]
    fn name(&self) -> &str {
        &self.machine.spec.name
    }

    /// Text of the spec with the changes of `with_parameters`, `enable`, `disable` and `scale`, as
    /// `abbe.load(text=…)` reads it. Raises ValueError if the text has no place for a change.
    ///
    /// >>> import abbe
    /// >>> changed = abbe.load("pps").with_parameters(x="25 cm").disable("assembly")
    /// >>> abbe.load(text=changed.text).parameters["x"]
    /// 250.0
    #[getter(text)]
    pub(crate) fn spec_text(&self, py: Python<'_>) -> PyResult<String> {
        let text = guarded(|| py.detach(|| self.text()).map_err(|mistakes| spec_error(py, &mistakes)))?;
        if self.changes.is_empty() {
            return Ok(text);
        }
        changed_text(&text, &self.unchanged.spec, &self.machine.spec).ok_or_else(|| {
            PyValueError::new_err("the text of this spec has no place for the changes of this machine")
        })
    }

    /// Returns a machine with one more error source: an `abbe.spec.Source`, or a dict of its keys.
    ///
    /// >>> import abbe
    /// >>> bent = {"name": "bent", "class": "repeatable", "frame": "elbow", "e_z": "0.1 mm"}
    /// >>> abbe.load("ur5").with_source(bent).sources[-1]
    /// 'bent'
    fn with_source(&self, py: Python<'_>, source: &Bound<'_, PyAny>) -> PyResult<Self> {
        let sources = PyDict::new(py);
        sources.set_item("source", [source])?;
        let text = format!("{}\n{}", self.spec_text(py)?, toml(&sources)?);
        restore(py, &self.unchanged.origin, Some(text), "[]")
    }

    /// Title of the manipulator.
    #[getter]
    fn title(&self) -> &str {
        &self.machine.spec.title
    }

    /// Unit of every length: "mm" or "m".
    #[getter]
    fn length(&self) -> &'static str {
        self.machine.spec.length.symbol()
    }

    /// Representation of orientations in rows 4 to 6: "rotation-vector", "euler-yzx" or
    /// "iec-61217".
    #[getter]
    fn orientation(&self) -> &'static str {
        self.interpreter.description().orientation.name()
    }

    /// Names of the six rows of displacements and Jacobians.
    #[getter]
    fn rows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.interpreter.description().orientation.rows())
    }

    /// Names of the 6n columns of the error Jacobian: e_x1 e_y1 e_z1 e_s1 e_r1 e_p1, then those of
    /// frame 2 …
    #[getter]
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, abbe_study::jacobian::column_names(self.interpreter.description().frames.len()))
    }

    /// Names of the joint variables, in the order of q.
    #[getter]
    fn variables(&self, py: Python<'_>) -> Py<PyTuple> {
        self.variable_names.clone_ref(py)
    }

    /// Names of the passive variables, which loops determine, in the order of `passive`.
    #[getter]
    fn passive_variables<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let names = self.interpreter.description().passive().map(|variable| &*variable.name);
        PyTuple::new(py, names.collect::<Vec<&str>>())
    }

    /// Lower and upper limit of each joint variable in the length unit or rad; infinite if the spec
    /// has none.
    #[getter]
    fn limits(&self) -> Vec<(f64, f64)> {
        self.interpreter.description().variables.iter().map(|one| (one.limits[0], one.limits[1])).collect()
    }

    /// Home configuration, in the length unit and rad.
    #[getter]
    pub(crate) fn home(&self) -> Vec<f64> {
        self.interpreter.description().variables.iter().map(|variable| variable.home).collect()
    }

    /// Names of the frames F_1 … F_n.
    #[getter]
    fn frames<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.interpreter.description().frames.iter().map(|frame| &*frame.name))
    }

    /// Structural parameters by name, in coherent units (`units`): the length unit, kg, s, rad, K.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parameters = self.interpreter.description().parameters.iter();
        parameters.map(|one| (&*one.name, one.nominal)).into_py_dict(py)
    }

    /// Units of `parameters` and `inputs` by name: "mm", "kg", "mm*kg/s^2" …; "" for pure numbers
    /// and for angles, which are in rad.
    ///
    /// >>> import abbe
    /// >>> abbe.load("pps").units["x"]
    /// 'mm'
    #[getter]
    pub(crate) fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let spec = &self.machine.spec;
        let parameters = spec.parameters.iter().map(|one| (&one.name, &one.unit));
        parameters.chain(spec.inputs.iter().map(|one| (&one.name, &one.unit))).into_py_dict(py)
    }

    /// Nominal inputs by name, in coherent units (`units`).
    #[getter]
    fn inputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.interpreter.description().inputs.iter().map(|one| (&*one.name, one.nominal)).into_py_dict(py)
    }

    /// Names of the enabled error sources, in the order of `source_displacements`.
    #[getter]
    fn sources<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.interpreter.description().sources.iter().map(|source| &*source.name))
    }

    /// Returns a machine with other nominal values of parameters and inputs: numbers in coherent
    /// units, or text with a unit.
    ///
    /// >>> import abbe
    /// >>> abbe.load("pps").with_parameters(x=250, y="25 cm").parameters["y"]
    /// 250.0
    #[pyo3(signature = (**values))]
    fn with_parameters(&self, py: Python<'_>, values: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut changes = Vec::new();
        for (name, value) in values.into_iter().flatten() {
            changes.push(match value.cast::<PyString>() {
                Ok(text) => Change::Set(format!("{name}={}", text.to_str()?)),
                Err(_) if value.is_instance_of::<PyBool>() => {
                    return Err(PyTypeError::new_err(format!(
                        "`{name}` must be a number, or text with a unit"
                    )));
                }
                Err(_) => Change::Number(format!("{name}={:?}", value.extract::<f64>()?)),
            });
        }
        self.changed(py, changes)
    }

    /// Returns a machine with these error sources enabled.
    #[pyo3(signature = (*sources))]
    fn enable(&self, py: Python<'_>, sources: Vec<String>) -> PyResult<Self> {
        self.changed(py, sources.into_iter().map(Change::Enable).collect())
    }

    /// Returns a machine with these error sources disabled.
    #[pyo3(signature = (*sources))]
    fn disable(&self, py: Python<'_>, sources: Vec<String>) -> PyResult<Self> {
        self.changed(py, sources.into_iter().map(Change::Disable).collect())
    }

    /// Returns a machine with the errors of this source multiplied by `factor`, which is not
    /// negative.
    fn scale(&self, py: Python<'_>, source: &str, factor: f64) -> PyResult<Self> {
        self.changed(py, vec![Change::Scale(format!("{source}={factor:?}"))])
    }

    fn __repr__(&self) -> String {
        let description = self.interpreter.description();
        let many = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        let frames = many(description.frames.len(), "frame");
        let joints = many(description.variables.len(), "joint variable");
        format!("Machine('{}': {frames}, {joints}, {})", description.name, description.length.symbol())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Restored<'_>)> {
        let restore = py.import("abbe._abbe")?.getattr("_restore")?;
        let changes =
            serde_json::to_string(&self.changes).map_err(|e| PyValueError::new_err(e.to_string()))?;
        Ok((restore, (&self.machine.origin, self.text.as_deref(), changes)))
    }
}
