//! The Python package `abbe`: what `abbe-study` and `abbe-interpreter` do, for NumPy arrays.
//!
//! `machine` is the class that users hold. `functions` evaluates a function of it: `layout` says where its numbers go,
//! `arrays` reads what it takes, `batch` runs it over many configurations. `failure` makes exceptions of mistakes.

mod arrays;
mod batch;
mod failure;
mod functions;
mod layout;
mod machine;

/// The compiled part of the package `abbe`.
#[pyo3::pymodule(gil_used = false)]
mod _abbe {
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::failure::SpecError;
    #[pymodule_export]
    use super::machine::{Machine, load, restore, shipped};

    #[pymodule_init]
    fn version(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
