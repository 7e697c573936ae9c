//! Jobs that are run on every readable input.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use abbe::analysis::sampling::{halton, nominal_inputs, nominal_parameters};
use abbe::identify::{Criterion, Loss};
use abbe::{Manipulator, real_pose};
use abbe_codegen::print::{Language, Real};
use abbe_interpreter::Interpreter;
use abbe_metrology::compensate::Compensate;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Family, Identify, Prior, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::plan::{Choice, Plan, Sets};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::diagnostic::Diagnostics;
use abbe_study::analyze::Analyze;
use abbe_study::check::Check;
use abbe_study::jacobian::Jacobian;
use abbe_study::{Machine, Notes, Study};

/// Number of steps after which a job is stopped, in the way an interruption stops it.
const STEPS: usize = 2000;

/// Notes that stop a job after [`STEPS`].
#[derive(Default)]
struct Impatient(AtomicUsize);

impl Notes for Impatient {
    fn stop(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) > STEPS
    }
}

fn notes() -> Impatient {
    Impatient::default()
}

/// Runs all jobs of a spec: its code, its errors at home and over a few samples, and its laws if
/// `with_laws`.
pub(crate) fn of_spec(machine: Machine, with_laws: bool) -> Result<(), Diagnostics> {
    for language in Language::ALL.into_iter().chain([Language::C(Real::Float)]) {
        assert!(language.files(&machine.spec).iter().all(|file| !file.text.is_empty()));
    }
    Jacobian { machine: machine.clone(), q: None }.run(&mut notes())?;
    let few = "[study]\ntitle = \"Few\"\n[workspace.joints]\nsamples = 20\n";
    let study = Study::read(abbe_spec::document::Document::new("few.toml", few), &machine.spec)?;
    analyze(&machine, study)?;
    if with_laws && machine.spec.frames.len() <= 6 {
        Check { machine }.run(&mut notes())?;
    }
    Ok(())
}

pub(crate) fn analyze(machine: &Machine, study: Study) -> Result<(), Diagnostics> {
    let mut job = Analyze::new(machine.clone(), study);
    job.figures = true;
    job.monte_carlo = Some(20);
    job.run(&mut notes()).map(drop)
}

/// Job on measurements.
pub(crate) enum Asked {
    Measure,
    Identify(Vec<Family>, Loss),
    Compensate,
    Simulate,
    Optimal,
}

impl Asked {
    pub(crate) fn numbered(number: u64) -> Self {
        match number % 6 {
            0 => Self::Identify(Vec::new(), Loss::Squares),
            1 => Self::Identify(vec![Family::Joint], Loss::Huber),
            2 => Self::Compensate,
            3 => Self::Simulate,
            4 => Self::Optimal,
            _ => Self::Measure,
        }
    }
}

pub(crate) fn of_data(machine: &Machine, map: &Map, data: &Path, asked: Asked) -> Result<(), Diagnostics> {
    let (machine, map) = (machine.clone(), map.clone());
    let accept = map.accept.clone();
    match asked {
        Asked::Measure => {
            let data = Data::read(data, &map)?;
            Measure { machine, map, data, accept }.run(&mut notes()).map(drop)
        }
        Asked::Identify(terms, loss) => {
            let data = Data::read(data, &map)?;
            let settings = Settings {
                loss,
                prior: Prior::default(),
                folds: 4,
                time: None,
                points: true,
                only_placement: false,
            };
            let job = Identify { machine, map, data, test: None, terms, harmonics: vec![], settings, accept };
            job.run(&mut notes()).map(drop)
        }
        Asked::Compensate => {
            let data = Data::read_commanded(data, &map)?;
            Compensate { machine, map, data, poses: false, tolerance: 1e-3, weight: None }
                .run(&mut notes())
                .map(drop)
        }
        Asked::Simulate => {
            let at = Places::Rows(Data::read_commanded(data, &map)?);
            let job = Simulate { machine, map, at, noise: None, outliers: 0.1, random: true, seed: 1 };
            job.run(&mut notes()).map(drop)
        }
        Asked::Optimal => {
            let choice = Choice::Optimal { criterion: Criterion::Variance, count: 12, candidates: 30 };
            let study = Study::find(None, &machine)?;
            Plan { machine, map, choice, study, model_error: 0.0, seed: None }.run(&mut notes()).map(drop)
        }
    }
}

pub(crate) fn plan(machine: &Machine, map: &Map, sets: Sets) -> Result<(), Diagnostics> {
    let study = Study::find(None, machine)?;
    let (machine, map, choice) = (machine.clone(), map.clone(), Choice::Sets(sets));
    Plan { machine, map, choice, study, model_error: 0.0, seed: None }.run(&mut notes()).map(drop)
}

/// Compares equation (6) by the interpreter and by products of transforms. Returns whether a pose
/// exists.
pub(crate) fn is_computed_alike(interpreter: &Interpreter, seed: u64, text: &str) -> bool {
    let description = interpreter.description();
    let q: Vec<f64> = (0..description.variables.len())
        .map(|i| {
            let [lower, upper] = description.variables[i].limits;
            lower + (upper - lower) * halton(seed as usize + 1, i)
        })
        .collect();
    let (s, u) = (nominal_parameters(description), nominal_inputs(description));
    let mut errors = vec![[0.0; 6]; description.frames.len()];
    let mut transforms = vec![abbe::Pose::IDENTITY; description.frames.len() + 1];
    let told = interpreter.generalized_errors(&q, &s, &u, &mut errors);
    let (Ok(()), Ok(()), Ok(Some(found))) = (
        told,
        interpreter.transforms(&q, &s, &mut transforms),
        interpreter.drawn_pose(&q, &s, &u, &abbe::repeatable_magnitudes(description)),
    ) else {
        return false;
    };
    let expected = real_pose(&transforms, &errors);
    let size =
        transforms.iter().flat_map(|pose| pose.0.as_flattened()).fold(1.0, |size: f64, x| size.max(x.abs()));
    for (a, b) in found.0.as_flattened().iter().zip(expected.0.as_flattened()) {
        assert!((a - b).abs() <= 1e-9 * size, "{a} {b} of {seed}:\n{text}");
    }
    true
}
