//! Measurements: the path of a CSV file, or a table in memory.

use std::path::PathBuf;

use abbe_metrology::data::{Cells, Columns, Data, Map, Source};
use abbe_study::Notes;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString, PyTuple};

use crate::{Machine, guarded, spec_error};

/// Rows of measurements.
pub(crate) enum Measured {
    /// Path of a CSV file.
    File(PathBuf),
    /// Columns in memory: those that the map names.
    Table(Columns),
}

impl Measured {
    /// Converts an argument with this name to measurements.
    pub(crate) fn new(what: &str, value: &Bound<'_, PyAny>, map: &Map) -> PyResult<Self> {
        if let Ok(file) = value.extract() {
            return Ok(Self::File(file));
        }
        Self::table(what, value, Some(map.columns()))
    }

    /// Converts an argument without a map: all columns are read.
    pub(crate) fn all(what: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        value.extract().map_or_else(|_| Self::table(what, value, None), |file| Ok(Self::File(file)))
    }

    fn table(what: &str, value: &Bound<'_, PyAny>, wanted: Option<Vec<&str>>) -> PyResult<Self> {
        let py = value.py();
        let read = py.import("abbe._arrays")?.getattr("columns")?.call1((value, what, wanted))?;
        let (columns, others): (Vec<(String, Bound<'_, PyAny>)>, Vec<String>) = read.extract()?;
        let columns = columns.into_iter().map(|(name, cells)| Ok((name, cells_of(&cells)?)));
        let columns = Columns::new(what, columns.collect::<PyResult<_>>()?, others);
        Ok(Self::Table(columns.map_err(|mistakes| spec_error(py, &mistakes))?))
    }

    /// Converts a list or tuple of measurements, or a single one.
    pub(crate) fn several(what: &str, value: &Bound<'_, PyAny>, map: &Map) -> PyResult<Vec<Self>> {
        if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
            return value.try_iter()?.map(|one| Self::new(what, &one?, map)).collect();
        }
        Ok(vec![Self::new(what, value, map)?])
    }

    pub(crate) fn source(&self) -> Source<'_> {
        match self {
            Self::File(file) => file.into(),
            Self::Table(columns) => columns.into(),
        }
    }
}

impl Machine {
    /// Reads the map in a file, the shipped map of that name, or a map as a dict or text of several
    /// lines.
    pub(crate) fn map(&self, map: &Bound<'_, PyAny>) -> PyResult<Map> {
        let (py, spec) = (map.py(), &self.machine.spec);
        let text = match map.cast::<PyString>() {
            Ok(text) => Some(text.to_str()?.to_owned()).filter(|text| text.contains('\n')),
            Err(_) => None,
        };
        let text = match text {
            None if map.is_instance_of::<PyDict>() => Some(crate::job::toml(map)?),
            text => text,
        };
        let read = match text {
            Some(text) => guarded(|| Ok(py.detach(|| Map::parse("map", &text, spec)))),
            None => {
                let file: PathBuf = map.extract()?;
                guarded(|| Ok(py.detach(|| Map::find(&file, spec))))
            }
        };
        read?.map_err(|mistakes| spec_error(py, &mistakes))
    }
}

/// Notes which rows cannot be used, as the command does.
pub(crate) fn unusable(data: &Data, notes: &mut dyn Notes) {
    if !data.unusable.is_empty() {
        notes.note(&data.summary().lines().join("\n"));
    }
}

fn cells_of(cells: &Bound<'_, PyAny>) -> PyResult<Cells> {
    match cells.cast::<PyArray1<f64>>() {
        Ok(array) => Ok(Cells::Numbers(array.try_readonly()?.as_slice()?.to_vec())),
        Err(_) => Ok(Cells::Texts(cells.extract()?)),
    }
}
