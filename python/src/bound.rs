//! Certified upper bounds of the errors of a machine.

use std::sync::Arc;

use abbe_bound::Effort;
use abbe_report::views;
use abbe_study::bound::Bound as Job;
use abbe_study::bound::options::{BOXES, Gap};
use pyo3::{exceptions::PyValueError, prelude::*};

use crate::job::{self, GivenStudy, Tolerances, Whole, run, seconds, within};
use crate::{Machine, Report};

#[pymethods]
impl Machine {
    /// Certifies upper bounds of the errors over a box of joints, parameters and inputs.
    ///
    /// `study`, `study_text`, `tolerance`: as for `analyze`; the box encloses the workspace of the
    /// study. `gap`: relative gap between the certified bound and the largest error found at which
    /// the search stops. `boxes`: maximum number of boxes to examine for each error. `time`: time
    /// limit in seconds. `least`: also certify lower bounds, `.dexterity` and `.stiffness`.
    ///
    /// `.repeatable`, `.random` and `.total`, the worst case of all, have the errors `.norm`, `.x`,
    /// `.y`, `.z` and `.orientation`. To first order, the true maximum of each lies between
    /// `.found`, attained at `.at`, and `.certified`, which is None if nothing could be proved.
    /// `.remainder.certified` bounds the difference between the exact chain and first order for the
    /// repeatable sources. `.after_one_step.position` and `.orientation` bound what one step of
    /// compensation leaves. `.margin` and `.orientation_margin` are the differences to the
    /// tolerances of the study.
    ///
    /// `.dexterity.point` and `.pose` bound the least singular value of `J_q` from below (metres,
    /// rad). `.stiffness` bounds the ratio of a force at the tool point to its deflection, in N/m;
    /// None for a rigid machine.
    ///
    /// Lengths are in the unit of the spec, angles in rad, in F_0. Fields:
    /// `abbe.reports.BoundReport`.
    ///
    /// >>> import abbe
    /// >>> norm = abbe.load("machine3").bound().repeatable.norm
    /// >>> f"{norm.found:.3f} <= {norm.certified:.3f}", norm.complete
    /// ('0.155 <= 0.156', True)
    #[pyo3(signature = (study=None, *, study_text=None, tolerance=None, gap=0.01, least=false, boxes=300_000, time=None, threads=None, progress=None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn bound(
        &self,
        py: Python<'_>,
        study: Option<GivenStudy>,
        study_text: Option<&str>,
        tolerance: Option<Tolerances>,
        gap: f64,
        least: bool,
        boxes: Whole,
        time: Option<f64>,
        threads: Option<Whole>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<Report>> {
        let gap =
            Gap::new(gap).map_err(|message| PyValueError::new_err(format!("`gap`: {message}")))?.share();
        let boxes = within("boxes", boxes, BOXES.range)?;
        let time = seconds("time", time)?;
        let (study, study_text) = GivenStudy::or_text(study, study_text);
        let (report, notes) = run(py, threads, progress, |notes| {
            let machine = self.unchanged.clone();
            let mut study = job::study(study.as_deref(), study_text.as_deref(), &machine)?;
            study.limit(&Tolerances::texts(tolerance), &machine.spec)?;
            let mut job = Job::new(machine.clone(), study);
            self.changes()?.iter().for_each(|changes| job.change(changes));
            job.effort = Effort { gap, boxes, ..job.effort };
            job.least = least;
            job.time = time;
            job.run(notes)
        })?;
        Report::from_document("bound", &Arc::new(report), notes, views::bound)?.create(py)
    }
}
