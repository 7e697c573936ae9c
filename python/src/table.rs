//! Tables of reports for readers of Arrow: pandas, polars, pyarrow, duckdb.

use std::{collections::HashMap, fmt::Display, sync::Arc};

use abbe_metrology::data;
use arrow_array::{
    Array, ArrayRef, BooleanArray, Float64Array, Int64Array, ListArray, RecordBatch, RecordBatchIterator,
    RecordBatchOptions, StringArray,
};
use arrow_array::{ffi_stream::FFI_ArrowArrayStream, types::Float64Type};
use arrow_schema::{Field, Schema, ffi::FFI_ArrowSchema};
use pyo3::exceptions::{PyKeyError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyTuple};
use serde_json::{Map, Value};

/// Table with named columns of numbers, texts or booleans. Any Arrow reader takes it without a
/// copy: ``pandas.DataFrame.from_arrow``, ``polars.DataFrame``, ``pyarrow.table``, and duckdb by
/// the name of the variable.
///
/// Missing values are null, never NaN. Units are those of the fields of the report.
#[pyclass(frozen, module = "abbe")]
pub(crate) struct Table {
    batch: RecordBatch,
}

impl Table {
    /// Converts rows with a heading.
    pub(crate) fn new(table: &data::Table) -> PyResult<Self> {
        let labels = (!table.labels.is_empty())
            .then(|| Arc::new(StringArray::from_iter_values(&table.labels)) as ArrayRef);
        let first = usize::from(labels.is_some());
        let numbers = (first..table.heading.len()).map(|column| {
            let values = table.rows.iter().map(|row| row.get(column - first).copied().flatten());
            Arc::new(values.collect::<Float64Array>()) as ArrayRef
        });
        let columns = table.heading.iter().cloned().zip(labels.into_iter().chain(numbers));
        Self::from_columns(columns.collect(), table.rows.len())
    }

    /// Converts a list of records: one row per record, one column per field, named `outer.inner`
    /// for nested fields.
    pub(crate) fn from_records(rows: &[Value]) -> PyResult<Self> {
        let (mut columns, mut places) = (Vec::new(), HashMap::new());
        for (i, row) in rows.iter().enumerate() {
            let mut put = |name: String, value| {
                let place = *places.entry(name).or_insert_with_key(|name| {
                    columns.push((name.clone(), vec![None; rows.len()]));
                    columns.len() - 1
                });
                columns[place].1[i] = Some(value).filter(|value: &&Value| !value.is_null());
            };
            row.as_object().into_iter().for_each(|fields| flatten("", fields, &mut put));
        }
        let columns = columns.into_iter().map(|(name, cells)| (name, column(&cells)));
        Self::from_columns(columns.collect(), rows.len())
    }

    fn from_columns(columns: Vec<(String, ArrayRef)>, rows: usize) -> PyResult<Self> {
        let (fields, arrays): (Vec<_>, Vec<_>) = columns
            .into_iter()
            .map(|(name, array)| (Field::new(name, array.data_type().clone(), true), array))
            .unzip();
        let options = RecordBatchOptions::new().with_row_count(Some(rows));
        let batch = RecordBatch::try_new_with_options(Arc::new(Schema::new(fields)), arrays, &options);
        Ok(Self { batch: batch.map_err(|error| failed(&error))? })
    }
}

#[pymethods]
impl Table {
    /// Names of the columns.
    #[getter]
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.batch.schema().fields().iter().map(|field| field.name().as_str()))
    }

    /// Returns the columns by name, as lists with None for missing values.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        for (field, array) in self.batch.schema().fields().iter().zip(self.batch.columns()) {
            columns.set_item(field.name(), cells(py, array)?)?;
        }
        Ok(columns)
    }

    /// Returns a column: an array of numbers, with NaN for missing values, or a list.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let array = self.batch.column_by_name(name).ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
        let found = cells(py, array)?;
        match array.data_type().is_numeric() {
            true => py.import("numpy")?.call_method1("array", (found, "float64")),
            false => Ok(found),
        }
    }

    fn __len__(&self) -> usize {
        self.batch.num_rows()
    }

    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        let schema = FFI_ArrowSchema::try_from(&*self.batch.schema()).map_err(|error| failed(&error))?;
        PyCapsule::new_with_value(py, schema, c"arrow_schema")
    }

    /// Exports the table. `requested_schema` is ignored, as the protocol allows.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let _ = requested_schema;
        // The buffers are reference-counted: the reader shares them without a copy.
        let batches = RecordBatchIterator::new([Ok(self.batch.clone())], self.batch.schema());
        PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(batches)), c"arrow_array_stream")
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let restore = py.import("abbe._abbe")?.getattr("_table")?;
        let columns = py.import("json")?.call_method1("dumps", (self.to_dict(py)?,))?;
        Ok((restore, (columns.extract()?,)))
    }

    #[pyo3(name = "_repr_html_")]
    pub(crate) fn html(&self, py: Python<'_>) -> PyResult<String> {
        py.import("abbe._fields")?.call_method1("html", (self.to_dict(py)?,))?.extract()
    }

    fn __repr__(&self) -> String {
        format!("<abbe table of {} rows, {} columns>", self.batch.num_rows(), self.batch.num_columns())
    }
}

/// Recreates a pickled table.
#[pyfunction]
#[pyo3(name = "_table")]
pub(crate) fn restore(columns: &str) -> PyResult<Table> {
    let columns: Map<String, Value> = serde_json::from_str(columns).map_err(|error| failed(&error))?;
    let rows = columns.values().filter_map(Value::as_array).map(Vec::len).max().unwrap_or(0);
    let columns = columns.into_iter().map(|(name, cells)| {
        let cells: Vec<_> = cells
            .as_array()
            .into_iter()
            .flatten()
            .map(|cell| Some(cell).filter(|cell| !cell.is_null()))
            .collect();
        (name, column(&cells))
    });
    Table::from_columns(columns.collect(), rows)
}

/// Visits every field without nested fields, by its dotted path.
fn flatten<'v>(before: &str, fields: &'v Map<String, Value>, put: &mut impl FnMut(String, &'v Value)) {
    for (name, value) in fields {
        let name = format!("{before}{name}");
        match value {
            Value::Object(fields) => flatten(&format!("{name}."), fields, put),
            value => put(name, value),
        }
    }
}

/// Converts cells to one type: a column without values to numbers, mixed types to JSON text.
fn column(cells: &[Option<&Value>]) -> ArrayRef {
    let all = |is: fn(&Value) -> bool| cells.iter().flatten().all(|value| is(value));
    let cells = cells.iter();
    if all(Value::is_i64) && !all(|_| false) {
        Arc::new(cells.map(|cell| cell.and_then(Value::as_i64)).collect::<Int64Array>())
    } else if all(Value::is_number) {
        Arc::new(cells.map(|cell| cell.and_then(Value::as_f64)).collect::<Float64Array>())
    } else if all(Value::is_boolean) {
        Arc::new(cells.map(|cell| cell.and_then(Value::as_bool)).collect::<BooleanArray>())
    } else if all(Value::is_string) {
        Arc::new(cells.map(|cell| cell.and_then(Value::as_str)).collect::<StringArray>())
    } else if all(is_numbers) {
        let lists = cells.map(|cell| Some(cell.as_ref()?.as_array()?.iter().map(Value::as_f64)));
        Arc::new(ListArray::from_iter_primitive::<Float64Type, _, _>(lists))
    } else {
        Arc::new(cells.map(|cell| cell.map(Value::to_string)).collect::<StringArray>())
    }
}

fn is_numbers(value: &Value) -> bool {
    value.as_array().is_some_and(|list| list.iter().all(|one| one.is_number() || one.is_null()))
}

/// Converts a column to a Python list.
fn cells<'py>(py: Python<'py>, array: &ArrayRef) -> PyResult<Bound<'py, PyAny>> {
    let any = array.as_any();
    if let Some(array) = any.downcast_ref::<Float64Array>() {
        array.iter().collect::<Vec<_>>().into_pyobject(py)
    } else if let Some(array) = any.downcast_ref::<Int64Array>() {
        array.iter().collect::<Vec<_>>().into_pyobject(py)
    } else if let Some(array) = any.downcast_ref::<BooleanArray>() {
        array.iter().collect::<Vec<_>>().into_pyobject(py)
    } else if let Some(array) = any.downcast_ref::<StringArray>() {
        array.iter().collect::<Vec<_>>().into_pyobject(py)
    } else {
        let lists = any.downcast_ref::<ListArray>().into_iter().flat_map(ListArray::iter);
        let lists = lists.map(|list| list.map(|list| cells(py, &list)).transpose());
        lists.collect::<PyResult<Vec<_>>>()?.into_pyobject(py)
    }
}

fn failed(error: &impl Display) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}
