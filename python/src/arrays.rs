//! What users give as numbers, read as arrays of NumPy's.

use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyReadwriteArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;

/// An array as it is, if it is one of double numbers in NumPy's usual order; all else is converted by `abbe._arrays`, with columns
/// of these names where a table may be given.
pub(crate) fn numbers<'py>(
    value: &Bound<'py, PyAny>,
    what: &str,
    names: Option<&Bound<'py, PyTuple>>,
) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    static CONVERT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    if let Ok(array) = value.cast_exact::<PyArrayDyn<f64>>()
        && array.is_c_contiguous()
        && array.is_aligned()
    {
        return readonly(array, what);
    }
    let convert = CONVERT.import(value.py(), "abbe._arrays", "numbers")?;
    let array = convert.call1((value, what, names))?;
    readonly(array.cast::<PyArrayDyn<f64>>().map_err(PyErr::from)?, what)
}

fn readonly<'py>(array: &Bound<'py, PyArrayDyn<f64>>, what: &str) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    array
        .try_readonly()
        .map_err(|_| PyValueError::new_err(format!("`{what}` is being written by another call")))
}

/// The array that a result is written to.
pub(crate) fn room<'py>(out: &Bound<'py, PyAny>, shape: &[usize]) -> PyResult<PyReadwriteArrayDyn<'py, f64>> {
    let array = out.cast::<PyArrayDyn<f64>>().map_err(|_| {
        PyTypeError::new_err("`out` must be a NumPy array of dtype float64 in the byte order of this machine")
    })?;
    if array.shape() != shape {
        let message = format!("`out` has shape {}, and {} is needed", tuple(array.shape()), tuple(shape));
        return Err(PyValueError::new_err(message));
    }
    if !array.is_c_contiguous() || !array.is_aligned() {
        return Err(PyValueError::new_err(
            "`out` must be C-contiguous and aligned: numpy.empty makes such arrays",
        ));
    }
    let busy = |error: numpy::BorrowError| match error {
        numpy::BorrowError::NotWriteable => PyValueError::new_err("`out` is read-only"),
        _ => PyValueError::new_err("`out` overlaps an argument, or another call is using it"),
    };
    array.try_readwrite().map_err(busy)
}

/// A new array, not filled yet.
pub(crate) fn empty<'py>(py: Python<'py>, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    static EMPTY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    EMPTY.import(py, "numpy", "empty")?.call1((PyTuple::new(py, shape)?,))
}

/// A shape as Python writes it.
pub(crate) fn tuple(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => format!("({})", shape.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
    }
}
