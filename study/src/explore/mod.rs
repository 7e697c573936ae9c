//! Data of a live page: the machine's generated JavaScript, and what a page shows of its spec and
//! study.
//!
//! `report` is the data. Here are the options of the commands that give the page's figures, and
//! configurations of the study's workspace, or of measured rows.

mod report;

pub use report::{
    Configurations, ErrorUnit, FrameName, LiveInput, LiveParameter, LiveSource, LiveVariable, Report,
    StudyFacts,
};

use std::{borrow::Cow, sync::Arc};

use abbe::analysis::{Configuration, Subset, Workspace};
use abbe_codegen::print::Language;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

use crate::{About, Machine, Notes, Residuals, Result, Study, analyze::Analyze, finite};

/// Functions of the generated code that a page calls, if the manipulator has them.
const FUNCTIONS: [&str; 6] =
    ["transforms", "pose", "real_pose", "error_jacobian", "effects", "source_displacements"];

/// Job of `abbe explore`: collects the data of a live page.
#[derive(Clone)]
pub struct Explore<'a> {
    /// Analysis of the machine over its study, with all changes.
    pub analysis: Cow<'a, Analyze>,
    /// Study as it was given, empty for a text, which no command can name; `None` for that of the
    /// machine.
    pub study: Option<String>,
    /// Measured rows, whose configurations replace those of the study.
    pub residuals: Option<Residuals>,
}

crate::reads! { Explore<'_>: analysis, without study residuals; }

impl Explore<'_> {
    /// Creates the job for a machine without a study, with measured rows if they have points. What
    /// these found takes the place of the machine.
    pub fn measured(mut machine: Machine, residuals: Option<Residuals>) -> Explore<'static> {
        if let Some(found) = residuals.as_ref().and_then(|residuals| residuals.found.as_deref()) {
            machine = Machine::of_spec(found.clone(), &machine.origin);
        }
        let study = Study::joint_samples(&machine.spec);
        Explore { analysis: Cow::Owned(Analyze::new(machine, study)), study: None, residuals }
    }

    /// Generates the code and collects the data.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let machine = self.analysis.machine();
        let tunable = tunable(&machine.spec);
        let functions = Language::JavaScript.functions(&tunable);
        let functions: Vec<&str> = FUNCTIONS.into_iter().filter(|name| functions.contains(name)).collect();
        let code = Language::JavaScript.files_of(&tunable, &functions);
        let code = code.into_iter().map(|file| file.text).collect();
        notes.go_on()?;
        let configurations = match &self.residuals {
            Some(residuals) => measured(residuals, &machine.spec),
            None => configurations(&self.analysis)?,
        };
        let effects = report::effects(&Interpreter::new(Arc::new(tunable.clone())));
        let options = [self.analyze_options(), self.jacobian_options()];
        let report = Report::new(&self.analysis, options, &tunable, effects, configurations, code);
        let is_named = self.study.as_deref() != Some("") && machine.is_named();
        let spec = if is_named { report.spec } else { String::new() };
        finite(&machine.origin, Report { spec, residuals: self.residuals.clone(), ..report })
    }

    /// Returns the options of `abbe analyze`, in the order of a command line: the study, its
    /// tolerances, then the changes, as they were given.
    fn analyze_options(&self) -> Vec<String> {
        let study = self.study.iter().map(|study| ("study", study.clone()));
        let tolerances = self.analysis.study().stated_tolerances.iter();
        let tolerances = tolerances.map(|tolerance| ("tolerance", tolerance.clone()));
        options(study.chain(tolerances).chain(self.analysis.machine().options_with([])))
    }

    /// Returns the options of `abbe jacobian`, which has no study: the study's own changes, then
    /// those that were given.
    fn jacobian_options(&self) -> Vec<String> {
        let machine = self.analysis.machine();
        let changes = self.analysis.study().changes.options(&machine.spec);
        options(changes.into_iter().chain(machine.options_with([])))
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

fn options(named: impl IntoIterator<Item = (&'static str, String)>) -> Vec<String> {
    named.into_iter().flat_map(|(name, value)| [format!("--{name}"), value]).collect()
}

/// Largest number of configurations on a page.
const COUNT: usize = 1000;

/// Returns reachable configurations, evenly chosen.
fn configurations(analysis: &Analyze) -> Result<Configurations> {
    let machine = analysis.machine();
    let manipulator = machine.evaluator(true);
    let region = &analysis.study().region;
    let workspace = region.workspace(&*manipulator, analysis.seed).about(&machine.origin)?;
    let reached = Subset { workspace: &*workspace, count: COUNT }.reached();
    let home = workspace.home();
    Ok(Configurations {
        q: reached.iter().map(|one| one.q.clone()).collect(),
        u: unless_nominal(&home.u, &reached, |one| &one.u),
        s: unless_nominal(&home.s, &reached, |one| &one.s),
    })
}

/// Returns the configurations of measured rows, with nominal parameters.
fn measured(residuals: &Residuals, spec: &Spec) -> Configurations {
    let inputs = spec.inputs.len();
    let u = residuals.rows.iter().map(|row| row.u[..inputs].to_vec());
    Configurations {
        q: residuals.rows.iter().map(|row| row.q.clone()).collect(),
        u: if inputs > 0 { u.collect() } else { Vec::new() },
        s: Vec::new(),
    }
}

/// Returns values of each configuration; none if all are nominal.
fn unless_nominal(
    nominal: &Vec<f64>,
    reached: &[Configuration],
    values: fn(&Configuration) -> &Vec<f64>,
) -> Vec<Vec<f64>> {
    match reached.iter().all(|one| values(one) == nominal) {
        true => Vec::new(),
        false => reached.iter().map(|one| values(one).clone()).collect(),
    }
}
