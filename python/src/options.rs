//! Options of jobs in Python. Their ranges and names are defined with each job in `abbe_study`.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::Path;
use std::time::Duration;

use abbe_metrology::Acceptance;
use abbe_metrology::data::Map;
use abbe_spec::expr::Dimension;
use abbe_spec::value::parse_value;
use abbe_spec::{Diagnostics, Document, Spec};
use abbe_study::Study;
use abbe_study::options::Choices;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::failure::spec_error;

/// Checks that a number is in the range of its option.
pub(crate) fn within<T: PartialOrd + Display>(name: &str, value: T, range: RangeInclusive<T>) -> PyResult<T> {
    if range.contains(&value) {
        return Ok(value);
    }
    Err(PyValueError::new_err(format!("`{name}` is from {} to {}", range.start(), range.end())))
}

/// Returns the value with this name.
pub(crate) fn named<T: Copy + PartialEq>(option: &str, name: &str, choices: Choices<T>) -> PyResult<T> {
    let names = || one_of(choices.0.iter().map(|(_, name, _)| *name));
    choices.find(name).ok_or_else(|| PyValueError::new_err(format!("{option}={name:?}: {}", names())))
}

/// Lists names: `"v" or "d"`.
pub(crate) fn one_of<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let names: Vec<String> = names.map(|name| format!("\"{name}\"")).collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, before)) => format!("{} or {last}", before.join(", ")),
        None => String::new(),
    }
}

/// Converts a time in seconds.
pub(crate) fn seconds(name: &str, value: Option<f64>) -> PyResult<Option<Duration>> {
    let time = value.map(Duration::try_from_secs_f64).transpose();
    time.map_err(|error| PyValueError::new_err(format!("`{name}`: {error}")))
}

/// Reads the study of a file or of a text; without both, returns the study that belongs to the
/// machine.
pub(crate) fn study(
    file: Option<&Path>,
    text: Option<&str>,
    machine: &abbe_study::Machine,
) -> Result<Study, Diagnostics> {
    match (text, file) {
        (Some(text), None) => Study::read(Document::new("study_text", text), &machine.spec),
        (_, file) => Study::find(file, machine),
    }
}

/// Tolerances: a text, or several.
#[derive(FromPyObject)]
pub(crate) enum Tolerances {
    One(String),
    All(Vec<String>),
}

impl Tolerances {
    /// Returns the texts of an argument.
    pub(crate) fn texts(given: Option<Self>) -> Vec<String> {
        match given {
            None => Vec::new(),
            Some(Self::One(text)) => vec![text],
            Some(Self::All(texts)) => texts,
        }
    }
}

/// Reads the given limits; without any, returns those of the map.
pub(crate) fn limits(text: Option<&str>, spec: &Spec, map: &Map) -> Result<Acceptance, Diagnostics> {
    text.map_or(Ok(map.accept.clone()), |text| Acceptance::read("accept", text, spec.length))
}

/// Reads a length that must not be negative: a number in the unit of the spec, or text with a unit.
pub(crate) fn length(name: &str, value: &Bound<'_, PyAny>, spec: &Spec) -> PyResult<f64> {
    let number: f64 = match value.cast::<PyString>() {
        Ok(text) => {
            let text = text.to_str()?;
            let document = Document::new(name, text);
            let number = parse_value(&document, 0..text.len(), spec.length, Dimension::LENGTH, "this");
            document.finish(number).map_err(|mistakes| spec_error(value.py(), &mistakes))?
        }
        Err(_) => value.extract()?,
    };
    match number.is_finite() && number >= 0.0 {
        true => Ok(number),
        false => Err(PyValueError::new_err(format!("`{name}` must be a length of zero or more"))),
    }
}
