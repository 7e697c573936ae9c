//! How large the errors of a machine are at most.

use std::path::PathBuf;
use std::sync::Arc;

use abbe_bound::Effort;
use abbe_report::text;
use abbe_study::bound::Bound as Job;
use abbe_study::bound::options::{BOXES, Gap};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::job::run;
use crate::machine::Machine;
use crate::options::{self, seconds, within};
use crate::report::Report;

#[pymethods]
impl Machine {
    /// How large the errors are at most, over a box of joints, parameters and inputs, with a proof.
    ///
    /// `study`, `study_text`: as for `analyze`; the box is the one that contains its workspace. `gap`: by which share of what is found
    /// what is certified may exceed it. `least`: whether `.dexterity` is added: of the tool's `.point` and of its `.pose` the least
    /// singular value of `J_q`, in metres and rad, is no less than `.certified` in the box, and `.found` at `.at`; and `.stiffness`, the same
    /// of a force at the tool point over what it moves it by, N/m, None if nothing gives way. `boxes`: the most
    /// that are looked at for each error; `time`: seconds, after which no more are.
    ///
    /// Of `.repeatable`, `.random` and `.radius`, the errors `.norm`, `.x`, `.y`, `.z` and `.orientation`: the true maximum, to first
    /// order, lies between `.found`, at `.at`, and `.certified`, which is None if nothing could be proved. `.remainder.certified`: how far
    /// the exact chain of the repeatable sources differs from first order at most; `.after_one_step.position` and `.orientation`: what
    /// one step of compensation leaves of them at most; `.margin` and `.orientation_margin`: what is left of the study's tolerances.
    /// Lengths in the unit of the spec, angles in rad, in F_0; fields as those of `abbe bound --json`.
    ///
    /// >>> import abbe
    /// >>> norm = abbe.load("machine3").bound().repeatable.norm
    /// >>> f"{norm.found:.3f} <= {norm.certified:.3f}", norm.complete
    /// ('0.155 <= 0.156', True)
    #[pyo3(signature = (study=None, *, study_text=None, gap=0.01, least=false, boxes=300_000, time=None, threads=None, progress=None))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn bound(
        &self,
        py: Python<'_>,
        study: Option<PathBuf>,
        study_text: Option<&str>,
        gap: f64,
        least: bool,
        boxes: usize,
        time: Option<f64>,
        threads: Option<usize>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Report> {
        let gap =
            Gap::new(gap).map_err(|message| PyValueError::new_err(format!("`gap`: {message}")))?.share();
        let boxes = within("boxes", boxes, BOXES.range)?;
        let time = seconds("time", time)?;
        let (report, notes) = run(py, threads, progress, |notes| {
            let machine = self.unchanged.clone();
            let mut job = Job::new(machine.clone(), options::study(study.as_deref(), study_text, &machine)?);
            self.changes()?.iter().for_each(|changes| job.change(changes));
            job.effort = Effort { gap, boxes, ..job.effort };
            job.least = least;
            job.time = time;
            job.run(notes)
        })?;
        Report::new("bound", &Arc::new(report), notes, text::bound)
    }
}
