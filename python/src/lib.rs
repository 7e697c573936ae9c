//! Python package `abbe`: the jobs of `abbe-study` and the functions of `abbe-interpreter` for
//! NumPy arrays.
//!
//! `machine` is the class `Machine`, `evaluated` its functions, and `commands` its inverse
//! kinematics and compensation. Each job has a file with the name of its command; `exchange` has
//! imports and exports. `functions` evaluates functions: `layout` maps results to arrays, `arrays`
//! converts arguments, `measured` reads measurements, `batch` loops over configurations. `job`
//! checks the arguments of a job and runs it, `report` is its result, `table` exports tables to
//! Arrow, `part` is a part of an analysis, and `failure` converts errors to exceptions.

mod allocate;
mod analyze;
mod arrays;
mod batch;
mod bound;
mod check;
mod commands;
mod derivatives;
mod doctor;
mod evaluated;
mod exchange;
mod explore;
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
mod part;
mod plan;
mod positioning;
mod report;
mod simulate;
mod table;

use failure::{guarded, spec_error};
use job::run;
use machine::Machine;
use measured::Measured;
use report::Report;

/// Compiled part of the package `abbe`.
#[pyo3::pymodule(gil_used = false)]
mod _abbe {
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::exchange::{import_dh, import_urdf};
    #[pymodule_export]
    use super::failure::SpecError;
    #[pymodule_export]
    use super::machine::{Machine, load, restore, shipped};
    #[pymodule_export]
    use super::part::{Part, merge, restore as restore_part};
    #[pymodule_export]
    use super::positioning::positioning;
    #[pymodule_export]
    use super::report::{Report, restore as restore_report};
    #[pymodule_export]
    use super::table::{Table, restore as restore_table};

    #[pymodule_init]
    fn begin(module: &Bound<'_, PyModule>) -> PyResult<()> {
        abbe_spec::option::word_for_python();
        // The commit is set by `build_backend.py`.
        abbe_study::set_version(match option_env!("ABBE_COMMIT") {
            Some(commit) => format!("{} ({commit})", env!("CARGO_PKG_VERSION")).leak(),
            None => env!("CARGO_PKG_VERSION"),
        });
        module.add("__version__", abbe_study::version())
    }
}
