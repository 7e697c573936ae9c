//! Measurements: the path of a CSV file, or a table in memory.

use std::path::PathBuf;

use abbe_spec::diagnostic::Diagnostics;
use abbe_study::Notes;
use abbe_study::data::{Cells, Columns, Data, Map, Source};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

use crate::failure::{guarded, spec_error};
use crate::machine::Machine;

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
        let read = py.import("abbe._arrays")?.getattr("columns")?;
        let read = read.call1((value, what, wanted))?;
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
    /// Reads the map in a file, or the shipped map of that name.
    pub(crate) fn map(&self, py: Python<'_>, map: &std::path::Path) -> PyResult<Map> {
        let find = || -> Result<Map, Diagnostics> { Map::find(map, &self.machine.spec) };
        guarded(|| py.detach(find).map_err(|mistakes| spec_error(py, &mistakes)))
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
