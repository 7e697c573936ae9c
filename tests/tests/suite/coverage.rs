//! Coverage of the figures of a compensated machine: machines are drawn from their error sources,
//! calibrated by planned measurements, and compensated. What then happens is compared with P and U
//! of the specs that the calibrations wrote.

use abbe::analysis::{
    Configuration, Correction, Goal, Measurand, Residual, Workspace, errors_at, random_joint_samples,
};
use abbe::identify::{Criterion, Loss};
use abbe::{Class, Manipulator, drawn_pose};
use abbe_interpreter::Interpreter;
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, Prior, Settings};
use abbe_metrology::plan::{Choice, Plan};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::{Cause, Spec};
use abbe_study::{Machine, Study};

use abbe_tests::thorough;
use rand::{Rng, RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// An arm of three joints, a gear error of unknown size, and play of two joints.
const ARM: &str = r#"
[manipulator]
name = "arm"
length = "mm"

[[frame]]
name = "turn"
variable = { name = "q1", kind = "revolute", limits = ["-150 deg", "150 deg"] }
transform = "Rz(q1) Tz(300)"

[[frame]]
name = "shoulder"
variable = { name = "q2", kind = "revolute", limits = ["-100 deg", "100 deg"] }
transform = "Rx(pi/2) Rz(q2) Tx(400)"

[[frame]]
name = "elbow"
variable = { name = "q3", kind = "revolute", limits = ["20 deg", "140 deg"], home = "90 deg" }
transform = "Rz(q3) Tx(300)"

[tool]
transform = "Tx(120) Ty(40)"

[[source]]
name = "gear"
class = "repeatable"
joint = "q2"
error = "0.3 mrad * sin(5*q2)"
magnitude = { value = 0, standard_deviation = 1 }

[[source]]
name = "play of the turn"
class = "random"
distribution = "normal"
joint = "q1"
error = "0.04 mrad"

[[source]]
name = "play of the elbow"
class = "random"
distribution = "normal"
joint = "q3"
error = "0.06 mrad"
"#;

/// Standard deviations of the hidden errors of each frame.
const HIDDEN: [&str; 6] = ["0.3 mm", "0.3 mm", "0.3 mm", "0.5 mrad", "0.5 mrad", "0.5 mrad"];

const MAP: &str = r#"
[data]
uncertainty = "0.03 mm"
base = "exact"
placement = "exact"

[joints]
q1 = { column = "j1", unit = "rad" }
q2 = { column = "j2", unit = "rad" }
q3 = { column = "j3", unit = "rad" }

[point]
columns = ["x", "y", "z"]
unit = "mm"
"#;

/// Share of errors within the tolerance and within U95, as claimed and as it happens.
#[derive(Clone, Copy, Debug, Default)]
struct Coverage {
    claimed: f64,
    within: f64,
    covered: f64,
}

/// Normal number by Box and Muller.
fn normal(numbers: &mut impl Rng) -> f64 {
    let [radius, angle]: [f64; 2] = [numbers.random(), numbers.random()];
    (-2.0 * (1.0 - radius).ln()).sqrt() * (std::f64::consts::TAU * angle).cos()
}

fn machine(text: &str) -> Machine {
    Machine::of_spec(Spec::parse("arm.toml", text).expect("a spec"), "arm.toml")
}

/// Returns a machine with errors drawn from the sources, as a spec. `added` are sources that no
/// model knows.
fn drawn(numbers: &mut impl Rng, added: &str) -> String {
    let mut text = ARM.replace("value = 0,", &format!("value = {},", normal(numbers)));
    for frame in ["turn", "shoulder", "elbow"] {
        let head =
            format!("\n[[source]]\nname = \"hidden {frame}\"\nclass = \"repeatable\"\nframe = \"{frame}\"\n");
        text += &head;
        for (component, deviation) in ["e_x", "e_y", "e_z", "e_s", "e_r", "e_p"].iter().zip(HIDDEN) {
            text += &format!("{component} = \"{} * {deviation}\"\n", normal(numbers));
        }
    }
    text + added
}

/// Plans a measurement of the nominal machine.
fn planned(count: usize) -> Data {
    let machine = machine(ARM);
    let map = Map::parse("map.toml", MAP, &machine.spec).expect("a map");
    let choice = Choice::Optimal { criterion: Criterion::Variance, count, candidates: 300 };
    let study = Study::joint_samples(&machine.spec);
    let plan = Plan { machine, map, choice, study, model_error: 0.0, seed: None };
    let observations = plan.run(&mut ()).expect("a plan").observations;
    Data { file: "plan.csv".to_owned(), observations, ..Data::default() }
}

/// Calibrates a machine by measurements at planned or random configurations, and returns the
/// written spec.
fn calibrated(truth: &str, at: Places, seed: u64) -> Machine {
    let real = machine(truth);
    let map = Map::parse("map.toml", MAP, &real.spec).expect("a map");
    let simulate = Simulate { machine: real, map, at, noise: None, outliers: 0.0, random: true, seed };
    let observations = simulate.run(&mut ()).expect("it is simulated").observations;
    let data = Data { file: "data.csv".to_owned(), observations, ..Data::default() };
    let nominal = machine(ARM);
    let map = Map::parse("map.toml", MAP, &nominal.spec).expect("a map");
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 10,
        time: None,
        points: false,
        only_placement: false,
    };
    let (terms, harmonics, accept) = (Vec::new(), Vec::new(), Acceptance::default());
    let job = Identify { machine: nominal, map, data, test: None, terms, harmonics, settings, accept };
    let report = job.run(&mut ()).expect("it is identified");
    let spec = Spec::parse("arm.toml", ARM).expect("a spec");
    machine(&report.found.identified_spec(&spec, ARM, "found.toml").expect("it is written").text)
}

/// Compares the claims of a calibration with draws of the compensated machine, at configurations
/// within the joint limits.
fn coverage(truth: &str, found: &Machine, tolerance: f64, numbers: &mut impl Rng) -> Coverage {
    let mut uncertain = found.clone();
    uncertain.add_uncertainties();
    let uncertain = uncertain.evaluator(false);
    let (found, truth, nominal) = (
        found.evaluator(false),
        Interpreter::new(machine(truth).spec.clone()),
        Interpreter::new(machine(ARM).spec.clone()),
    );
    let description = uncertain.description();
    let residuals = vec![Some(Residual::Share(0.0)); description.sources.len()];
    let correction = Correction { residuals: &residuals, together: None };
    let samples = random_joint_samples(&*found, &[0, 1, 2], CONFIGURATIONS, numbers.random());
    let configurations: Vec<Configuration> = samples.expect("samples").reached();
    let mut sum = Coverage::default();
    for configuration in &configurations {
        let errors = errors_at(&*uncertain, configuration).expect("errors");
        let claimed = errors.distribution(Measurand::Position, Some(correction)).coverage(tolerance, 0);
        sum.claimed += claimed.0.probability;
        let Configuration { q, s, u } = configuration;
        let command = abbe::analysis::compensated(&*found, Goal::default(), q, s, u).expect("a command").q;
        let ideal = nominal.pose(q, s).expect("a pose").position();
        for _ in 0..DRAWS {
            let magnitudes = truth.description().sources.iter().map(|source| match source.class {
                Class::Repeatable => 1.0,
                Class::Tolerance(_) | Class::Random(_) => normal(numbers),
            });
            let magnitudes = magnitudes.collect::<Vec<_>>();
            let real = drawn_pose(&truth, &command, s, u, &magnitudes).expect("a pose").position();
            let error = (0..3).map(|i| (real[i] - ideal[i]).powi(2)).sum::<f64>().sqrt();
            sum.within += f64::from(u8::from(error <= tolerance)) / DRAWS as f64;
            sum.covered += f64::from(u8::from(error <= claimed.1)) / DRAWS as f64;
        }
    }
    let count = configurations.len() as f64;
    Coverage { claimed: sum.claimed / count, within: sum.within / count, covered: sum.covered / count }
}

const CONFIGURATIONS: usize = 12;
const DRAWS: usize = 100;

/// Returns the mean of numbers and its standard error.
fn mean(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares = values.map(|value| (value - mean).powi(2)).sum::<f64>();
    [mean, (squares / (count - 1.0) / count).sqrt()]
}

/// P and U95 of many machines: the mean difference of what happens and what is claimed, and its
/// standard error over the machines.
#[derive(Debug)]
struct Holds {
    probability: [f64; 2],
    u95: [f64; 2],
    claimed: f64,
}

impl Holds {
    /// Checks that claims hold within `room`, or four standard errors if that is more.
    fn within(&self, room: f64) {
        for [difference, error] in [self.probability, self.u95] {
            assert!(difference.abs() <= room.max(if thorough() { 0.0 } else { 4.0 * error }), "{self:?}");
        }
    }
}

fn simulated(machines: u64, rows: usize, tolerance: f64) -> Holds {
    let plan = planned(rows);
    let one = |seed| {
        let mut numbers = Xoshiro256PlusPlus::seed_from_u64(seed);
        let truth = drawn(&mut numbers, "");
        let found = calibrated(&truth, Places::Rows(plan.clone()), seed);
        coverage(&truth, &found, tolerance, &mut numbers)
    };
    let all: Vec<Coverage> = (0..machines).map(one).collect();
    let holds = Holds {
        probability: mean(all.iter().map(|one| one.within - one.claimed)),
        u95: mean(all.iter().map(|one| one.covered - 0.95)),
        claimed: mean(all.iter().map(|one| one.claimed))[0],
    };
    println!("{machines} machines, {rows} rows, {tolerance} mm: {holds:?}");
    holds
}

/// An error of the elbow that no model has: 0.2 mrad, seven cycles a turn.
const HARMONIC: &str = "\n[[source]]\nname = \"harmonic\"\nclass = \"repeatable\"\njoint = \"q3\"\n\
                        error = \"0.2 mrad * sin(7*q3)\"\n";

/// Holds P and U95 of compensated machines within 1 % in 100 simulated calibrations, whose standard
/// error is about 0.4 %; an ordinary run has six, and holds them within four standard errors.
#[test]
fn claims_on_compensated_machines_hold() {
    let machines = if thorough() { 100 } else { 6 };
    let holds = simulated(machines, 30, 0.07);
    holds.within(0.01);
    // The tolerance is one that decides.
    assert!((0.6..0.98).contains(&holds.claimed), "{holds:?}");
}

/// Returns a spec without the random sources of what the model does not explain.
fn without_unexplained(found: &Machine) -> Machine {
    let mut spec = Spec::clone(&found.spec);
    spec.sources.retain(|source| !source.name.starts_with("not identified"));
    Machine::of_spec(spec, "found.toml")
}

/// Holds that a position error that the model does not have is written as random sources of its
/// size, and that the claims are closer to what happens by them. At 60 random configurations, the
/// harmonic moves the tool point by 0.2 mrad × 422 mm/√2 = 0.060 mm, 0.034 mm along each axis, of
/// which constant errors imitate a part. Without it nothing is written.
#[test]
fn errors_that_the_model_does_not_have_are_counted() {
    let machines = if thorough() { 10 } else { 3 };
    let mut counted = Vec::new();
    for seed in 0..machines {
        let mut numbers = Xoshiro256PlusPlus::seed_from_u64(100 + seed);
        let truth = drawn(&mut numbers, HARMONIC);
        let found = calibrated(&truth, Places::Samples(60), seed);
        let written: Vec<_> =
            found.spec.sources.iter().filter(|source| source.name.starts_with("not identified")).collect();
        assert_eq!(written.len(), 3, "{seed}");
        let Cause::Errors(errors) = &written[0].effects[0].cause else { panic!("an error") };
        let size = errors[0].1.constant().expect("a constant");
        assert!((0.015..0.045).contains(&size), "{seed}: {size}");
        let with = coverage(&truth, &found, 0.1, &mut numbers);
        let without = coverage(&truth, &without_unexplained(&found), 0.1, &mut numbers);
        counted.push([with.covered, without.covered]);
    }
    let [with, without] = [0, 1].map(|i| mean(counted.iter().map(|covered| covered[i])));
    println!("{machines} machines: U95 covers {with:?}, without these sources {without:?}");
    assert!(with[0] > without[0] + 0.05 && (0.85..0.99).contains(&with[0]), "{with:?} {without:?}");

    let mut numbers = Xoshiro256PlusPlus::seed_from_u64(7);
    let found = calibrated(&drawn(&mut numbers, ""), Places::Samples(60), 7);
    assert!(found.spec.sources.iter().all(|source| !source.name.starts_with("not identified")));
}
