//! Errors as Python exceptions.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use abbe_spec::Diagnostics;
use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

create_exception!(
    abbe,
    SpecError,
    PyValueError,
    "A mistake in a spec, a study, a map, data or an option, as rustc would show it.\n\n\
     ``str(error)`` is the whole text. ``file`` names the file or option; ``line`` and ``column`` count from 1 and are None if \
     the mistake is about the file as a whole; ``help`` is the way out, if there is one. They are those of the first mistake."
);

/// Creates a SpecError from the diagnostics of a file.
pub(crate) fn spec_error(py: Python<'_>, diagnostics: &Diagnostics) -> PyErr {
    let text = diagnostics.render(false);
    let first = diagnostics.list.first();
    let is_missing = first.is_some_and(|first| first.message.starts_with("cannot read this file"))
        && !Path::new(&diagnostics.path).exists();
    let missing = || -> PyResult<Bound<'_, PyAny>> {
        py.import("abbe._errors")?.getattr("MissingFileError")?.call1((&text,))
    };
    let error = match is_missing {
        true => missing().map_or_else(|error| error, PyErr::from_value),
        false => SpecError::new_err(text),
    };
    let place = first.and_then(|first| first.span.as_ref()).map(|span| {
        let before = &diagnostics.text[..diagnostics.text.floor_char_boundary(span.start)];
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        (before.matches('\n').count() + 1, before[start..].chars().count() + 1)
    });
    let value = error.value(py);
    let set = || {
        value.setattr("file", &diagnostics.path)?;
        value.setattr("line", place.map(|(line, _)| line))?;
        value.setattr("column", place.map(|(_, column)| column))?;
        value.setattr("help", first.and_then(|first| first.help.as_deref()))
    };
    set().err().unwrap_or(error)
}

/// Converts a panic, which is a bug in abbe, to a Python exception.
pub(crate) fn guarded<T>(work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(panicked(&*panic)))
}

pub(crate) fn panicked(panic: &(dyn std::any::Any + Send)) -> PyErr {
    let message = panic.downcast_ref::<String>().map(String::as_str);
    let message = message.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
    PyRuntimeError::new_err(format!("internal error of abbe, please report it: {message}"))
}
