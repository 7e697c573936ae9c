//! Live pages.

use std::borrow::Cow;
use std::path::PathBuf;

use abbe_study::explore::Explore;
use pyo3::prelude::*;

use crate::job::{GivenStudy, Whole, within};
use crate::{Machine, run};

#[pymethods]
impl Machine {
    /// Returns a live page of the machine: joints, inputs, parameters and the factor of each source
    /// can be varied, and it shows the errors there by the generated code. Notebooks show it in a
    /// frame; `.save(path)` writes it as a file that needs no network.
    ///
    /// `study`, `study_text`: as for `analyze`; the page has the tolerance and some configurations
    /// of the study. `height`: of the frame in a notebook, in pixels.
    ///
    /// >>> import abbe
    /// >>> abbe.load("ur5").explore()
    /// <abbe page: Universal Robots UR5 with a tracker target>
    #[pyo3(signature = (study=None, *, study_text=None, height=900))]
    fn explore<'py>(
        &self,
        py: Python<'py>,
        study: Option<GivenStudy>,
        study_text: Option<&str>,
        height: Whole,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (study, study_text) = GivenStudy::or_text(study, study_text);
        let (report, _) = run(py, None, None, |notes| {
            let analysis = Cow::Owned(self.job(study.as_deref(), study_text.as_deref(), &[], notes)?);
            let name = |study: &PathBuf| study.to_string_lossy().into_owned();
            let study = study_text.map(|_| String::new()).or_else(|| study.as_ref().map(name));
            Explore { analysis, study, residuals: None }.run(notes)
        })?;
        page(py, &report.title, &abbe_report::explore(std::slice::from_ref(&report)), height)
    }
}

/// Creates a page for notebooks.
pub(crate) fn page<'py>(
    py: Python<'py>,
    title: &str,
    html: &str,
    height: Whole,
) -> PyResult<Bound<'py, PyAny>> {
    let height = within("height", height, 1..=u32::MAX)?;
    py.import("abbe._fields")?.getattr("Page")?.call1((title, html, height))
}
