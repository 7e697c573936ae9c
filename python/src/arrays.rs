//! NumPy arrays of arguments and results.

use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyReadwriteArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;

/// Returns a C-contiguous float64 array as it is, and converts everything else by `abbe._arrays`.
/// `names` are the columns to read if a table is given.
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
    let array = CONVERT.import(value.py(), "abbe._arrays", "numbers")?.call1((value, what, names))?;
    readonly(array.cast::<PyArrayDyn<f64>>().map_err(PyErr::from)?, what)
}

fn readonly<'py>(array: &Bound<'py, PyArrayDyn<f64>>, what: &str) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    array
        .try_readonly()
        .map_err(|_| PyValueError::new_err(format!("`{what}` is being written by another call")))
}

/// Borrows `out` for writing.
///
/// # Errors
///
/// Another dtype, shape or memory order; a read-only array; an overlap with an argument.
pub(crate) fn output_array<'py>(
    out: &Bound<'py, PyAny>,
    shape: &[usize],
) -> PyResult<PyReadwriteArrayDyn<'py, f64>> {
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

/// Creates an uninitialized array.
pub(crate) fn empty<'py>(py: Python<'py>, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    static EMPTY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    EMPTY.import(py, "numpy", "empty")?.call1((PyTuple::new(py, shape)?,))
}

/// Formats a shape as a Python tuple.
pub(crate) fn tuple(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => format!("({})", shape.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
    }
}
