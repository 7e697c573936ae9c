//! Profiles of joints: simulated cobots whose gears and encoders have errors of up to 48 cycles per
//! turn, identified, written, read back and measured on rows that were not fitted.

use abbe::identify::{Loss, Model, Role, Uncertainty};
use abbe::{Class, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Family, Identify, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_study::Machine;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use crate::thorough::thorough;

/// Standard deviation of a coordinate, in mm.
const NOISE: f64 = 0.05;

/// Constant errors of the simulated machines.
pub(crate) const CONSTANTS: &str = "[[source]]\nname = \"bent\"\nclass = \"repeatable\"\nframe = \"elbow\"\ne_s = \"0.8 mrad\"\n\
                         e_x = \"0.3 mm\"\n\n[[source]]\nname = \"zero\"\nclass = \"repeatable\"\njoint = \"q2\"\n\
                         error = \"1 mrad\"\n\n";

/// Returns a UR5 whose joints turn once, with these sources.
pub(crate) fn ur5(sources: &str) -> String {
    let machine = Machine::find("ur5").unwrap();
    let text = machine.text().unwrap();
    let nominal = &text[..text.find("[[source]]").expect("it has sources")];
    format!("{}{sources}", nominal.replace("360 deg", "180 deg"))
}

/// Draws two to five waves of 1 to 48 cycles per turn and 0.05 to 0.3 mrad for each joint.
pub(crate) fn drawn_waves(seed: u64) -> String {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let joint = |joint: usize| {
        let waves: Vec<String> = (0..random.random_range(2..=5))
            .map(|_| {
                let amplitude = random.random_range(0.5e-4..3e-4);
                let cycles = random.random_range(1..=48);
                let phase = random.random_range(0.0..core::f64::consts::TAU);
                format!("{amplitude:e}*sin({cycles}*q{joint} + {phase})")
            })
            .collect();
        let waves = waves.join(" + ");
        format!(
            "[[source]]\nname = \"gear {joint}\"\nclass = \"repeatable\"\njoint = \"q{joint}\"\nerror = \"{waves}\"\n\n"
        )
    };
    (1..=6).map(joint).collect()
}

pub(crate) fn machine(text: &str) -> Machine {
    Machine::of_spec(Spec::parse("ur5.toml", text).unwrap(), "ur5.toml")
}

/// Returns the map of a tracker whose placement, like that of its target, is known.
pub(crate) fn map(machine: &Machine) -> Map {
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"deg\" }}\n")).collect();
    let text = format!(
        "[data]\nuncertainty = \"{NOISE} mm\"\nbase = \"exact\"\nplacement = \"exact\"\n\n[joints]\n{joints}\n\
         [point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n"
    );
    Map::parse("map.toml", &text, &machine.spec).unwrap()
}

fn measured(truth: &str, rows: usize, seed: u64) -> Data {
    let machine = machine(truth);
    let map = map(&machine);
    let at = Places::Samples(rows);
    let job = Simulate { machine, map, at, noise: None, outliers: 0.0, random: false, seed };
    let observations = job.run(&mut ()).unwrap().observations;
    Data { file: "data.csv".to_owned(), observations, ..Data::default() }
}

fn identified(data: &Data, terms: &[Family]) -> Report {
    let machine = machine(&ur5(""));
    let map = map(&machine);
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 10,
        time: None,
        points: false,
        only_placement: false,
    };
    let (data, terms, harmonics) = (data.clone(), terms.to_vec(), Vec::new());
    let accept = Acceptance::default();
    let job = Identify { machine, map, data, test: None, terms, harmonics, settings, accept };
    job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"))
}

/// Returns the spec that is written.
fn written(report: &Report) -> String {
    let nominal = ur5("");
    report.found.identified_spec(&machine(&nominal).spec, &nominal, "found.toml").unwrap().text
}

/// Measures rows with a written spec: root mean square of what remains, in mm.
fn left(text: &str, data: &Data) -> f64 {
    let machine = machine(text);
    let map = map(&machine);
    let job = Measure { machine, map, data: data.clone(), accept: Acceptance::default() };
    job.run(&mut ()).unwrap().explained.left_rms
}

/// Returns the tool point at a row, with all repeatable sources of a spec.
fn point(model: &Model, data: &Data, row: usize) -> [f64; 3] {
    model.at(&[]).pose(&data.observations[row]).unwrap().position()
}

fn exact<'a>(manipulator: &'a Interpreter) -> Model<'a> {
    let mut model = Model::ideal(manipulator, vec![[0.0; 3]], Uncertainty { length: NOISE, angle: 1.0 });
    for (source, role) in manipulator.description().sources.iter().zip(&mut model.roles) {
        *role = if source.class == Class::Repeatable { Role::Known } else { Role::Off };
    }
    model
}

/// Returns the root mean square of error / standard deviation of predicted coordinates, from the
/// covariance that the written spec states.
fn z(truth: &str, text: &str, rows: &Data) -> f64 {
    let real = Interpreter::new(machine(truth).spec);
    let mut found = machine(text);
    found.add_uncertainties();
    let found = Interpreter::new(found.spec);
    let (real, model) = (exact(&real), exact(&found));
    let description = found.description();
    let mut squares = 0.0;
    for (i, row) in rows.observations.iter().enumerate() {
        let (truth, predicted) = (point(&real, rows, i), point(&model, rows, i));
        let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
        let mut values = vec![0.0; description.effects.len()];
        found.error_jacobian(&row.q, &[], &mut columns).unwrap();
        found.effects(&row.q, &[], &[], &mut values).unwrap();
        let mut moves = vec![[0.0; 3]; description.sources.len()];
        for (effect, value) in description.effects.iter().zip(values) {
            let column = columns[6 * effect.frame + effect.component as usize];
            (0..3).for_each(|axis| moves[effect.source][axis] += value * column[axis]);
        }
        for axis in 0..3 {
            let random = description.sources.iter().zip(&moves);
            let random = random.filter(|(source, _)| source.class != Class::Repeatable);
            let variance: f64 = random.map(|(_, moves)| moves[axis] * moves[axis]).sum();
            squares += (predicted[axis] - truth[axis]).powi(2) / variance;
        }
    }
    (squares / (3 * rows.observations.len()) as f64).sqrt()
}

/// Checks 2,000 rows by the way of the command: the written spec, read back, leaves on unseen rows
/// at most 1.3 times the noise of the instrument, and on its own rows what the fit says. Predicted
/// tool points are as uncertain as the covariance of the spec says.
#[test]
fn two_thousand_rows_recover_profiles() {
    let floor = NOISE * 3f64.sqrt();
    for seed in 0..if thorough() { 3 } else { 1 } {
        let truth = ur5(&format!("{CONSTANTS}{}", drawn_waves(seed)));
        let (data, unseen) = (measured(&truth, 2000, 2 * seed), measured(&truth, 500, 2 * seed + 1));
        let report = identified(&data, &[Family::Profile]);
        let profiles = report.profiles.as_ref().expect("there are profiles");
        let text = written(&report);
        let (own, new) = (left(&text, &data), left(&text, &unseen) / floor);
        let z = z(&truth, &text, &unseen);
        let crossed = profiles.after.rms / floor;
        let before = profiles.before.rms / floor;
        println!(
            "seed {seed}: {} profiles, unseen {new:.3}, cross-validation {crossed:.3}, without {before:.2} times the \
             noise, z {z:.3}",
            profiles.joints.len()
        );
        assert!(new < 1.3 && before > 1.8, "{new} {before}");
        assert!((crossed - new).abs() < 0.1, "{crossed} {new}");
        assert!((own - report.fit.after.rms).abs() < 1e-3 * own, "{own} {}", report.fit.after.rms);
        assert!((0.8..1.25).contains(&z), "{z}");
        assert!(profiles.gain.p < 1e-12 && report.cross_validation.after.mean == profiles.after.mean);
    }
}

/// Checks that nothing is claimed from 2,000 rows of a machine without periodic errors, and that
/// the report says why.
#[test]
fn without_profiles_nothing_is_claimed() {
    for seed in 0..if thorough() { 3 } else { 1 } {
        let data = measured(&ur5(CONSTANTS), 2000, 100 + seed);
        let report = identified(&data, &[Family::Profile]);
        assert!(report.profiles.is_none(), "{:?}", report.profiles);
        assert!(
            report.notes.iter().any(|note| note.contains("no profiles of joints: ")),
            "{:?}",
            report.notes
        );
        assert!(!written(&report).contains("[tables.") && written(&report).contains("[fitted]"));
    }
}

/// Measures rows of which none has a joint within its gap, in degrees.
fn measured_beside(gaps: &[(usize, f64)], truth: &str, rows: usize, seed: u64) -> Data {
    let mut data = measured(truth, 5 * rows / 4, seed);
    let is_in =
        |q: &[f64], (joint, from): &(usize, f64)| (0.0..20.0).contains(&(q[*joint].to_degrees() - from));
    data.observations.retain(|row| !gaps.iter().any(|gap| is_in(&row.q, gap)));
    data.observations.truncate(rows);
    assert_eq!(data.observations.len(), rows);
    data
}

/// Two joints never stand within 20° of their turn. Every joint that moves the target has a profile
/// all the same. On unseen rows, the written spec leaves at most 1.3 times the noise, those within
/// the gaps included.
#[test]
fn profiles_bridge_gaps() {
    let floor = NOISE * 3f64.sqrt();
    let gaps = [(1, 35.0), (4, -70.0)];
    for seed in 0..if thorough() { 3 } else { 1 } {
        let truth = ur5(&format!("{CONSTANTS}{}", drawn_waves(seed)));
        let report = identified(&measured_beside(&gaps, &truth, 2000, 2 * seed), &[Family::Profile]);
        let profiles = report.profiles.as_ref().expect("there are profiles");
        let text = written(&report);
        let unseen = [measured_beside(&gaps, &truth, 500, 2 * seed + 1), measured(&truth, 500, 2 * seed + 1)];
        let unseen = unseen.map(|unseen| left(&text, &unseen) / floor);
        println!("seed {seed}: {} profiles, unseen {unseen:.3?} times the noise", profiles.joints.len());
        assert!(unseen.into_iter().all(|unseen| unseen < 1.3), "{unseen:?}");
        assert_eq!(profiles.joints.len(), 5, "q6 turns about the target");
        assert!(profiles.joints.iter().all(|one| one.range[1] - one.range[0] > 6.2), "{profiles:?}");
    }
}

/// Few rows do no harm: on unseen rows, what is left is at most 1.03 times that of constants alone.
/// Hundreds of rows suffice where gears err by few numbers of cycles.
#[test]
fn profiles_of_few_rows_do_no_harm() {
    let floor = NOISE * 3f64.sqrt();
    for seed in 0..if thorough() { 6 } else { 1 } {
        let truth = ur5(&format!("{CONSTANTS}{}", drawn_waves(seed)));
        let unseen = measured(&truth, 500, 200 + seed);
        for (rows, most) in [(60, 20.0), (200, 1.5), (505, 1.3)] {
            let data = measured(&truth, rows, 100 + seed);
            let [constants, profiles] = [&[][..], &[Family::Profile]]
                .map(|terms| left(&written(&identified(&data, terms)), &unseen) / floor);
            println!(
                "seed {seed}, {rows} rows: constants {constants:.3}, profiles {profiles:.3} times the noise"
            );
            assert!(profiles < 1.03 * constants && profiles < most, "{rows}: {profiles} {constants}");
        }
    }
}

/// A joint that moves too little for a profile is named.
#[test]
fn joints_that_move_too_little_are_named() {
    let truth = ur5(&format!("{CONSTANTS}{}", drawn_waves(1)));
    let mut data = measured(&truth, 20_000, 3);
    data.observations.retain(|row| (0.0..3.0).contains(&row.q[2].to_degrees()));
    let report = identified(&data, &[Family::Profile]);
    let said =
        |note: &String| note.starts_with("note: no profile of q3: it turns by ") && note.ends_with("° only");
    assert!(report.notes.iter().any(said), "{:?}", report.notes);
}

/// An arm of 500 mm, a rail, and a profile of the arm that is known to 0.02 mrad.
const ARM: &str = r#"
[manipulator]
name = "arm"
length = "mm"

[[frame]]
name = "rail"
variable = { name = "d1", kind = "prismatic", limits = ["0 mm", "1000 mm"] }
transform = "Tx(d1)"

[[frame]]
name = "arm"
variable = { name = "q2", kind = "revolute", limits = ["-180 deg", "180 deg"] }
transform = "Rz(q2) Tx(500)"

[tables.profile]
interpolation = "cubic"
outside = "hold"
x = { values = [-90, 0, 90], unit = "deg" }
y = { values = [0, 100, 0], unit = "urad" }

[[source]]
name = "profile"
class = "repeatable"
joint = "q2"
error = "profile(q2)"

[fitted]
q2 = ["-90 deg", "90 deg"]

[covariance]
of = [{ source = "profile", joint = "q2" }]
rows = [[4e-10]]
"#;

/// The covariance of a joint's error is that of an addend: 0.02 mrad at 500 mm are 0.01 mm, where
/// the profile itself is zero as well. Warnings of extrapolation and calibration errors agree.
#[test]
fn the_covariance_of_a_joint_is_that_of_its_error() {
    let arm = machine(ARM);
    let text = "[data]\nbase = \"exact\"\nuncertainty = \"0.01 mm\"\n[joints]\nd1 = { column = \"d1\", unit = \"mm\" }\n\
                q2 = { column = \"q2\", unit = \"deg\" }\n[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n";
    let map = Map::parse("map.toml", text, &arm.spec).unwrap();
    let at = Places::Samples(50);
    let job = Simulate {
        machine: arm.clone(),
        map: map.clone(),
        at,
        noise: None,
        outliers: 0.0,
        random: false,
        seed: 1,
    };
    let observations = job.run(&mut ()).unwrap().observations;
    let data = Data { file: "data.csv".to_owned(), observations, ..Data::default() };
    let mut calibrated = arm.clone();
    calibrated.add_uncertainties();
    let calibrated = Interpreter::new(calibrated.spec);
    for row in &data.observations {
        let mut values = vec![0.0; calibrated.description().effects.len()];
        calibrated.effects(&row.q, &[], &[], &mut values).unwrap();
        let turn = values[values.len() - 1].abs();
        assert!((turn - 2e-5).abs() < 1e-12, "{values:?}");
    }
    let job = Measure { machine: arm, map, data, accept: Acceptance::default() };
    let report = job.run(&mut ()).unwrap();
    let known =
        report.extrapolated.expect("rows are outside").standard_deviation.expect("there is a covariance");
    assert!((known.within - 0.01).abs() < 1e-9 && (known.extrapolated - 0.01).abs() < 1e-9, "{known:?}");
}

/// Displacements between rows are refused if profiles are asked for by name.
#[test]
fn profiles_refuse_displacements() {
    let arm = machine(ARM.split("[fitted]").next().unwrap());
    let text = "[data]\nbase = \"exact\"\nplacement = \"exact\"\n[joints]\nd1 = { column = \"d1\", unit = \"mm\" }\n\
                q2 = { column = \"q2\", unit = \"deg\" }\n[[instrument]]\nname = \"laser\"\nkind = \"displacement\"\n\
                column = \"travelled\"\nunit = \"um\"\nuncertainty = \"0.1 um\"\n";
    let map = Map::parse("map.toml", text, &arm.spec).unwrap();
    let at = Places::Samples(60);
    let job = Simulate {
        machine: arm.clone(),
        map: map.clone(),
        at,
        noise: None,
        outliers: 0.0,
        random: false,
        seed: 1,
    };
    let observations = job.run(&mut ()).unwrap().observations;
    let data = Data { file: "data.csv".to_owned(), observations, ..Data::default() };
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 5,
        time: None,
        points: false,
        only_placement: false,
    };
    let (terms, harmonics, accept) = (vec![Family::Profile], Vec::new(), Acceptance::default());
    let job = Identify { machine: arm, map, data, test: None, terms, harmonics, settings, accept };
    let refused = job.run(&mut ()).unwrap_err().to_string();
    assert!(refused.contains("cannot be fitted to displacements") && refused.contains("help"), "{refused}");
}
