//! Data of a live page: the machine's generated JavaScript, and what a page shows of its spec and
//! study.
//!
//! `report` is the data, `command` the options of the commands that give the page's figures, and
//! `configurations` some configurations of the study's workspace.

mod command;
mod configurations;
mod report;

use std::borrow::Cow;
use std::sync::Arc;

use abbe_codegen::print::Language;
use abbe_interpreter::Interpreter;
use abbe_spec::{Diagnostics, Spec};

use crate::analyze::Analyze;
use crate::finite;
use crate::notes::Notes;
use crate::{Machine, Residuals, Study};
pub use report::{
    Configurations, ErrorUnit, FrameName, LiveInput, LiveParameter, LiveSource, LiveVariable, Report,
    StudyFacts,
};

/// Functions of the generated code that a page calls, if the manipulator has them.
const FUNCTIONS: [&str; 6] =
    ["transforms", "pose", "real_pose", "error_jacobian", "effects", "source_displacements"];

/// Job of `abbe explore`: collects the data of a live page.
#[derive(Clone)]
pub struct Explore<'a> {
    /// Analysis of the machine over its study, with all changes.
    pub analysis: Cow<'a, Analyze>,
    /// Study as it was given; `None` for that of the machine.
    pub study: Option<String>,
    /// Measured rows, whose configurations replace those of the study.
    pub residuals: Option<Residuals>,
}

crate::reads! { Explore<'_>: analysis, without study residuals; }

impl Explore<'_> {
    /// Creates the job for a machine without a study, with measured rows if they have points.
    pub fn measured(machine: Machine, residuals: Option<Residuals>) -> Explore<'static> {
        let study = Study::joint_samples(&machine.spec);
        Explore { analysis: Cow::Owned(Analyze::new(machine, study)), study: None, residuals }
    }

    /// Generates the code and collects the data.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let machine = self.analysis.machine();
        let tunable = tunable(&machine.spec);
        let functions = Language::JavaScript.functions(&tunable);
        let functions: Vec<&str> = FUNCTIONS.into_iter().filter(|name| functions.contains(name)).collect();
        let code = Language::JavaScript.files_of(&tunable, &functions);
        let code = code.into_iter().map(|file| file.text).collect();
        notes.go_on()?;
        let configurations = match &self.residuals {
            Some(residuals) => configurations::measured(residuals, &machine.spec),
            None => configurations::configurations(&self.analysis)?,
        };
        let interpreter = Interpreter::new(Arc::new(tunable.clone()));
        let effects = report::effects(&interpreter);
        let options = [self.analyze_options(), self.jacobian_options()];
        let report = Report::new(&self.analysis, options, &tunable, effects, configurations, code);
        finite(&machine.origin, Report { residuals: self.residuals.clone(), ..report })
    }
}

/// Returns the spec with every source enabled, and a factor of each repeatable one as an input. The
/// beams of disabled sources have no weight: it would load the structure at a factor of 0, too.
fn tunable(spec: &Spec) -> Spec {
    let mut spec = spec.clone();
    for source in spec.sources.iter_mut().filter(|source| !source.enabled) {
        source.remove_weight();
        source.enabled = true;
    }
    spec.with_magnitudes_as_inputs()
}
