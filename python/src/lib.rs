//! The Python package `abbe`: what `abbe-study` and `abbe-interpreter` do, for NumPy arrays.
//!
//! `machine` is the class that users hold, `evaluated` its functions, `commands` single commands. A job of the same name as
//! the command has a file of that name; `exchange` are imports and exports. `options` reads what jobs are given. `functions`
//! evaluates: `layout` says where numbers go, `arrays` reads what users give, `measured` what they measured, `batch` runs over many
//! configurations. `job` runs a job beside Python, `report` is what it found, `table` what Arrow reads of it, `part` a part of an
//! analysis; `failure` makes exceptions of mistakes.

mod analyze;
mod arrays;
mod batch;
mod bound;
mod check;
mod commands;
mod doctor;
mod evaluated;
mod exchange;
mod failure;
mod functions;
mod generate;
mod identify;
mod job;
mod layout;
mod machine;
mod measure;
mod measured;
mod monitor;
mod options;
mod part;
mod plan;
mod report;
mod simulate;
mod table;

/// The compiled part of the package `abbe`.
#[pyo3::pymodule(gil_used = false)]
mod _abbe {
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::commands::Commands;
    #[pymodule_export]
    use super::exchange::{import_dh, import_urdf};
    #[pymodule_export]
    use super::failure::SpecError;
    #[pymodule_export]
    use super::machine::{Machine, load, restore, shipped};
    #[pymodule_export]
    use super::part::{Part, merge, restore as restore_part};
    #[pymodule_export]
    use super::report::Report;
    #[pymodule_export]
    use super::table::Table;

    #[pymodule_init]
    fn version(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
