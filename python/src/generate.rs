//! Generated source code.

use abbe_study::generate::{Generate, Language};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

use crate::job::{named, run};
use crate::machine::Machine;

#[pymethods]
impl Machine {
    /// Returns the closed form as source code in one text.
    ///
    /// `language`: "rust", "c", "js", "python", "matlab", "st" or "plcopen". `real`: floating-point
    /// type of C, "double" (default) or "float". The text of C is the header followed by the
    /// source; `generate_files` returns them one by one. The same spec always gives the same text.
    ///
    /// `only`: functions to write, with what they need, separated by commas, for "c", "js",
    /// "python" and "matlab"; None for all. `name`: name in the code instead of the machine's.
    #[pyo3(signature = (language="rust", *, real=None, only=None, name=None))]
    fn generate(
        &self,
        py: Python<'_>,
        language: &str,
        real: Option<&str>,
        only: Option<String>,
        name: Option<String>,
    ) -> PyResult<String> {
        let files = self.generate_files(py, language, real, only, name)?;
        files.values().iter().map(|text| text.extract::<String>()).collect()
    }

    /// Returns the closed form as source files: their names and texts, to be written to one folder.
    ///
    /// Options as for `generate`.
    ///
    /// >>> import abbe
    /// >>> list(abbe.load("scara").generate_files("c"))
    /// ['scara.h', 'scara.c']
    #[pyo3(signature = (language="rust", *, real=None, only=None, name=None))]
    fn generate_files<'py>(
        &self,
        py: Python<'py>,
        language: &str,
        real: Option<&str>,
        only: Option<String>,
        name: Option<String>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let language = match named("language", language, Generate::LANGUAGES)? {
            Language::Fmu(_) => {
                return Err(PyValueError::new_err(
                    "language=\"fmu\" is an archive, not a text: `abbe generate` writes it",
                ));
            }
            language => language,
        };
        let real = real.map(|name| named("real", name, Generate::REALS)).transpose()?;
        let language = match (language, real) {
            (language, None) => language,
            (Language::C(_), Some(real)) => Language::C(real),
            (_, Some(_)) => return Err(PyValueError::new_err("`real` is for language=\"c\": leave it out")),
        };
        let job = Generate { machine: self.machine.clone(), language, only, name };
        let (files, _) = run(py, None, None, |notes| job.run(notes))?;
        files.into_iter().map(|file| (file.name, file.text)).into_py_dict(py)
    }
}
