//! Factors of the error sources that keep a tolerance at least cost.

use std::sync::Arc;

use abbe_report::views;
use abbe_study::allocate::Allocate;
use pyo3::prelude::*;

use crate::job::{self, GivenStudy, Tolerances, Whole, run};
use crate::{Machine, Report};

#[pymethods]
impl Machine {
    /// Allocates the tolerance: factors of the error sources that keep it at least cost.
    ///
    /// `study`, `study_text`, `tolerance`: as for `analyze`; the study also has the costs.
    /// `loosen`: allow factors above 1.
    ///
    /// `.sources` have the `.factor` of each `.source`. The tolerance is kept by the criterion of
    /// the study with these factors and with all smaller ones. `.cost` is the sum of the costs,
    /// `.one_factor_cost` that with the same factor for all, and `.active` has the configurations
    /// at which the tolerance is reached. `scale` applies a factor to a machine, and `text` is its
    /// spec.
    ///
    /// Lengths are in the unit of the spec, angles in rad. Fields: `abbe.reports.AllocateReport`.
    ///
    /// >>> import abbe
    /// >>> report = abbe.load("pps").allocate()
    /// >>> min((source.factor, source.source) for source in report.sources)[1]
    /// 'assembly'
    #[pyo3(signature = (study=None, *, study_text=None, tolerance=None, loosen=false, threads=None, progress=None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn allocate(
        &self,
        py: Python<'_>,
        study: Option<GivenStudy>,
        study_text: Option<&str>,
        tolerance: Option<Tolerances>,
        loosen: bool,
        threads: Option<Whole>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<Report>> {
        let (study, study_text) = GivenStudy::or_text(study, study_text);
        let (report, notes) = run(py, threads, progress, |notes| {
            let machine = self.unchanged.clone();
            let mut study = job::study(study.as_deref(), study_text.as_deref(), &machine)?;
            study.limit(&Tolerances::texts(tolerance), &machine.spec)?;
            let mut job = Allocate::new(machine, study);
            self.changes()?.iter().for_each(|changes| job.change(changes));
            job.loosen = loosen;
            job.run(notes)
        })?;
        Report::from_document("allocate", &Arc::new(report), notes, views::allocation)?.create(py)
    }
}
