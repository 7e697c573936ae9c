//! Generated source code.

use abbe_study::generate::{Generate, Language};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::job::run;
use crate::machine::Machine;
use crate::options::named;

#[pymethods]
impl Machine {
    /// Returns the closed form as source code.
    ///
    /// `language`: "rust", "c", "js", "python" or "matlab". `real`: floating-point type of C,
    /// "double" (default) or "float". The text of C is the header followed by the source. The same
    /// spec always gives the same text.
    #[pyo3(signature = (language="rust", *, real=None))]
    fn generate(&self, py: Python<'_>, language: &str, real: Option<&str>) -> PyResult<String> {
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
        let job = Generate { machine: self.machine.clone(), language };
        let files = run(py, None, None, |notes| job.run(notes))?.0;
        Ok(files.into_iter().map(|file| file.text).collect())
    }
}
