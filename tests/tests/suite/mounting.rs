//! Mounting of targets: a plan names what a target hides, and a place where it does not.

use abbe::analysis::sampling::stream;
use abbe::identify::Criterion;
use abbe::{Manipulator, Pose};
use abbe_interpreter::Interpreter;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::plan::{Choice, Plan, Report, TargetMounting};
use abbe_metrology::simulate::Places;
use abbe_spec::Spec;
use abbe_study::{Machine, Study};
use abbe_tests::sample_size;
use nalgebra::{DMatrix, Vector3};
use rand::RngExt;

use super::alternatives::{ARM, ZERO_OF_Q5, arm, identified_at, point_map};
use super::other_tool::arm_length;

/// Distance of the tool point from the wrist, in mm.
const WRIST: f64 = 206.0;

fn planned(machine: Machine, map: Map) -> Report {
    let study = Study::find(None, &machine).expect("a study");
    let choice = Choice::Optimal { criterion: Criterion::Variance, count: 60, candidates: 200 };
    Plan { machine, map, choice, study, model_error: 0.0, seed: None }.run(&mut ()).expect("a plan")
}

/// Plans 60 points of a target beside the axis of q6 by `tool` mm; `data` are more keys of the map.
fn planned_point(tool: f64, data: &str) -> Report {
    let machine = arm(tool, "");
    let map = point_map(&machine, data);
    planned(machine, map)
}

/// Plans with a map whose tables after those of the joints are `rest`.
fn planned_by(rest: &str) -> Report {
    let machine = arm(0.0, "");
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"rad\" }}\n")).collect();
    let text = format!("[joints]\n{joints}{rest}");
    let map = Map::parse("map.toml", &text, &machine.spec).unwrap_or_else(|refused| panic!("{refused}"));
    planned(machine, map)
}

/// Returns whether two numbers are confused with each other alone.
fn is_hidden_by(mounting: &TargetMounting, one: &str, other: &str) -> bool {
    let is_pair = |a: &str, b: &str| {
        mounting
            .numbers
            .iter()
            .any(|number| number.is_hidden && number.name == a && number.confused_with == [b])
    };
    is_pair(one, other) || is_pair(other, one)
}

fn placement([x, y, z]: [f64; 3]) -> String {
    format!("[placement]\ntargets = [[\"{x} mm\", \"{y} mm\", \"{z} mm\"]]\n")
}

/// A target on the axis of q6 is named as the reason, with both pairs of numbers that it cannot
/// tell apart and with a place that does.
#[test]
fn plan_names_what_a_target_on_an_axis_hides() {
    let mounting = planned_point(0.0, "").mounting.expect("hidden numbers");
    assert_eq!(mounting.target_on_axis.as_deref(), Some("q6"));
    for (one, other) in [("zero of q5", "a of A5"), ("alpha of A5", "d of A5")] {
        assert!(is_hidden_by(&mounting, one, other), "{one} {other}: {mounting:?}");
    }
    let [x, y, _] = mounting.position;
    // A target 2 mm beside the axis is of no use.
    assert!(x.hypot(y) > 30.0 && mounting.distance <= 0.1 * arm_length(), "{mounting:?}");
    assert!(!mounting.is_additional);
    let hidden = mounting.numbers.iter().filter(|number| number.is_hidden);
    assert_eq!(hidden.map(|number| &number.name[..]).collect::<Vec<_>>(), ["zero of q5", "alpha of A5"]);
}

/// The promise: machines with these errors, simulated at the planned configurations with the target
/// at the advised place, are identified with the promised standard deviations, and the errors are
/// within them. No other cause is named. At the planned place the zero of q5 is not told apart.
#[test]
fn advised_place_shows_the_numbers_with_the_promised_standard_deviations() {
    let report = planned_point(0.0, "");
    let mounting = report.mounting.as_ref().expect("hidden numbers");
    let truth = [("zero of q5", 1e-3), ("a of A5", -0.3)];
    let sources = format!(
        "{ZERO_OF_Q5}\n[[source]]\nname = \"length\"\nclass = \"repeatable\"\nframe = \"A5\"\n\
         dh = {{ a = \"-0.3 mm\" }}\n"
    );
    let data = placement(mounting.position);
    let seeds = sample_size(100);
    let (mut squares, mut ratios) = ([0.0; 2], [0.0; 2]);
    for seed in 0..seeds as u64 {
        let at = || {
            let observations = report.observations.clone();
            Places::Rows(Data { file: "plan.csv".to_owned(), observations, ..Data::default() })
        };
        let found = identified_at(at(), arm(0.0, &sources), arm(0.0, ""), &data, 0.01, seed);
        for (i, (name, value)) in truth.into_iter().enumerate() {
            let promised = mounting.numbers.iter().find(|number| number.name == name).expect("the number");
            let one = found.joint_errors.iter().find(|one| one.number == name);
            let one = one.unwrap_or_else(|| panic!("{seed}: {:?}", found.joint_errors));
            assert!(one.alternatives.is_empty(), "{one:?}");
            squares[i] += ((one.value - value) / promised.standard_deviation_there).powi(2);
            ratios[i] += one.standard_deviation / promised.standard_deviation_there;
        }
        if seed == 0 {
            let found = identified_at(at(), arm(0.0, &sources), arm(0.0, ""), "", 0.01, seed);
            assert!(
                found
                    .joint_errors
                    .iter()
                    .all(|one| one.number != "zero of q5" || !one.alternatives.is_empty())
            );
        }
    }
    let n = seeds as f64;
    let (z, ratio) = (squares.map(|sum| (sum / n).sqrt()), ratios.map(|sum| sum / n));
    println!("{seeds} machines: rms error / promised σ {z:?}, stated / promised σ {ratio:?}");
    // Standard error of a root mean square: 1/√(2n).
    let scatter = 3.0 / (2.0 * n).sqrt();
    assert!(z.iter().all(|z| (z - 1.0).abs() <= scatter), "{z:?}");
    assert!(ratio.iter().all(|ratio| (ratio - 1.0).abs() <= 0.05), "{ratio:?}");
}

/// The posterior by differences of the exact chain, for a target anywhere.
struct ByDifferences {
    /// Names and sizes of the errors, and their prior standard deviations.
    errors: Vec<(String, f64, f64)>,
    /// Pose at each configuration: nominal, and with each error added and subtracted.
    poses: Vec<(Pose, Vec<[Pose; 2]>)>,
}

impl ByDifferences {
    /// Differentiates by all Denavit-Hartenberg numbers, and by the errors of frames that these
    /// cannot represent.
    fn new(report: &Report) -> Self {
        let prior = |is_angle: bool| if is_angle { 0.01 } else { 0.01 * arm_length() };
        let (mut errors, mut text) = (Vec::new(), String::new());
        let mut add = |name: String, site: String, is_angle: bool, unit: &str| {
            let size = if is_angle { 1e-5 } else { 1e-2 };
            let site = site.replace("SIZE", &format!("\"{size} {unit}\""));
            text += &format!("\n[[source]]\nname = \"{name}\"\nclass = \"repeatable\"\n{site}\n");
            errors.push((name, size, prior(is_angle)));
        };
        for i in 1..=6 {
            add(format!("zero of q{i}"), format!("joint = \"q{i}\"\nerror = SIZE"), true, "rad");
            for (number, is_angle, unit) in [("d", false, "mm"), ("a", false, "mm"), ("alpha", true, "rad")] {
                let site = format!("frame = \"A{i}\"\ndh = {{ {number} = SIZE }}");
                add(format!("{number} of A{i}"), site, is_angle, unit);
            }
        }
        for (component, frame, is_angle) in [("e_s", 2, true), ("e_y", 6, false), ("e_s", 6, true)] {
            let unit = if is_angle { "rad" } else { "mm" };
            let site = format!("frame = \"A{frame}\"\n{component} = SIZE");
            add(format!("{component} of A{frame}"), site, is_angle, unit);
        }
        let spec = Spec::parse("arm.toml", &(ARM.replace("TOOL", "0") + &text));
        let machine = Interpreter::new(spec.unwrap_or_else(|refused| panic!("{refused}")));
        let pose = |q: &[f64], error: Option<usize>, sign: f64| {
            let magnitudes: Vec<f64> =
                (0..errors.len()).map(|i| if error == Some(i) { sign } else { 0.0 }).collect();
            machine.drawn_pose(q, &[], &[], &magnitudes).expect("a pose").expect("a pose")
        };
        let poses = report.observations.iter().map(|row| {
            let each = (0..errors.len()).map(|i| [pose(&row.q, Some(i), 1.0), pose(&row.q, Some(i), -1.0)]);
            (pose(&row.q, None, 0.0), each.collect())
        });
        let poses = poses.collect();
        Self { errors, poses }
    }

    /// Returns the standard deviations of the errors with a target at a place of unknown position,
    /// a base of unknown placement, and an instrument of 0.02 mm.
    fn deviations(&self, place: [f64; 3]) -> Vec<f64> {
        let count = self.errors.len();
        let mut jacobian = DMatrix::zeros(3 * self.poses.len(), count + 9);
        for (row, (nominal, each)) in self.poses.iter().enumerate() {
            let mut set = |column: usize, by: Vector3<f64>| {
                jacobian.fixed_view_mut::<3, 1>(3 * row, column).copy_from(&by);
            };
            for (i, [more, less]) in each.iter().enumerate() {
                let [more, less] = [more, less].map(|pose| Vector3::from(pose.apply(place)));
                set(i, (more - less) / (2.0 * self.errors[i].1));
            }
            let (point, origin) = (Vector3::from(nominal.apply(place)), Vector3::from(nominal.position()));
            for axis in 0..3 {
                let unit = Vector3::ith(axis, 1.0);
                set(count + axis, unit);
                set(count + 3 + axis, unit.cross(&point));
                set(count + 6 + axis, Vector3::from(nominal.apply(unit.into())) - origin);
            }
        }
        let placement = [[1e4; 3], [10.0; 3], [1e4; 3]].concat();
        let priors: Vec<f64> = self.errors.iter().map(|error| error.2).chain(placement).collect();
        for (mut column, prior) in jacobian.column_iter_mut().zip(&priors) {
            column.scale_mut(prior / 0.02);
        }
        let identity = DMatrix::identity(priors.len(), priors.len());
        let covariance = (jacobian.tr_mul(&jacobian) + identity).cholesky().expect("a covariance").inverse();
        (0..count).map(|i| covariance[(i, i)].sqrt() * priors[i]).collect()
    }

    fn deviation(&self, name: &str, place: [f64; 3]) -> f64 {
        let i = self.errors.iter().position(|error| error.0 == name).expect("an error");
        self.deviations(place)[i]
    }

    /// Returns the largest displacement of the tool point by one standard deviation of an error.
    /// The tool point is on the axis of q6, so that angles displace it by its distance from the
    /// wrist.
    fn largest(&self, mounting: &TargetMounting, place: [f64; 3]) -> f64 {
        let deviations = self.deviations(place);
        let of = |name: &str| {
            let i = self.errors.iter().position(|error| error.0 == name).expect("an error");
            deviations[i] * if self.errors[i].2 == 0.01 { WRIST } else { 1.0 }
        };
        mounting.numbers.iter().map(|number| of(&number.name)).fold(0.0, f64::max)
    }
}

/// The printed standard deviations are those of an independent computation. The advised place
/// brings 90 % of the information of the best place that the plan compares, which is at least 88 %
/// of that of any place within the limit; no much nearer one does, and one 2 mm beside the axis is
/// useless.
#[test]
fn advised_place_is_the_nearest_that_brings_most_of_the_information() {
    let report = planned_point(0.0, "");
    let mounting = report.mounting.as_ref().expect("hidden numbers");
    let independent = ByDifferences::new(&report);
    for number in &mounting.numbers {
        for (place, stated) in
            [([0.0; 3], number.standard_deviation), (mounting.position, number.standard_deviation_there)]
        {
            let expected = independent.deviation(&number.name, place);
            println!("{} at {place:?}: {stated} for {expected}", number.name);
            assert!((stated / expected - 1.0).abs() < 0.01, "{number:?}: {expected}");
        }
    }
    let before = independent.largest(mounting, [0.0; 3]);
    let gain = |place: [f64; 3]| (before / independent.largest(mounting, place)).ln();
    let here = gain(mounting.position);
    let mut random = stream(1, 0);
    let limit = 0.1 * arm_length();
    let (mut best, mut near) = (0.0_f64, 0.0_f64);
    for _ in 0..sample_size(400) {
        let direction: Vector3<f64> = Vector3::from_fn(|_, _| random.random_range(-1.0..1.0)).normalize();
        // Places near the axis on the side of the flange are inside the tool.
        if direction.z < 0.0 && direction.x.hypot(direction.y) < 0.5 {
            continue;
        }
        let at = |distance: f64| gain((direction * distance).into());
        best = best.max(at(limit * random.random_range(0.0..1.0_f64)));
        near = near.max(at(0.7 * mounting.distance * random.random_range(0.0..1.0_f64)));
    }
    println!("gain {here} of {best} nats, {near} nearer; {} mm of {limit}", mounting.distance);
    // The places that the plan compares are not dense: their best one misses a little.
    assert!(here >= 0.88 * best && near < 0.88 * best, "{here} of {best}, {near} nearer");
    let useless = independent.deviation("zero of q5", [2.0, 0.0, 0.0]);
    let there = independent.deviation("zero of q5", mounting.position);
    assert!(useless > 20.0 * there, "{useless} {there}");
}

/// A target beside the axis, at the advised place, three targets, and whole poses hide nothing that
/// another place would show.
#[test]
fn targets_that_hide_nothing_need_no_other_place() {
    let advised = planned_point(0.0, "").mounting.expect("hidden numbers").position;
    assert!(planned_point(0.0, &placement(advised)).mounting.is_none());
    assert!(planned_point(100.0, "").mounting.is_none());
    let target = |[x, y]: [f64; 2], name: &str| {
        format!(
            "[[target]]\ncolumns = [\"x{name}\", \"y{name}\", \"z{name}\"]\nunit = \"mm\"\n\
             position = [\"{x} mm\", \"{y} mm\", \"0 mm\"]\n"
        )
    };
    let three = [([50.0, 0.0], "a"), ([0.0, 50.0], "b"), ([-50.0, 0.0], "c")];
    let three: String = three.map(|(place, name)| target(place, name)).concat();
    let three = planned_by(&format!("[data]\nuncertainty = \"0.02 mm\"\n{three}")).mounting;
    assert!(three.is_none(), "{three:?}");
    let pose = "[data]\nuncertainty = \"0.02 mm\"\nangle_uncertainty = \"0.1 mrad\"\nplacement = \"exact\"\n\
        [pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\nrotation_vector = { columns = [\"rx\", \"ry\", \"rz\"], unit = \"rad\" }\n";
    assert!(planned_by(pose).mounting.is_none());
}

fn tracked(data: &str, targets: &[(&str, &str)]) -> String {
    let each = targets.iter().map(|(name, position)| {
        format!(
            "[[target]]\nname = \"{name}\"\nposition = {position}\n\
             [[instrument]]\nname = \"tracker of {name}\"\nkind = \"point\"\ntarget = \"{name}\"\n\
             columns = [\"{name}x\", \"{name}y\", \"{name}z\"]\nunit = \"mm\"\nuncertainty = \"0.02 mm\"\n"
        )
    });
    format!("[data]\n{data}\n{}", each.collect::<String>())
}

/// Two targets show no rotation about the line through them: an additional one is advised, and with
/// it nothing is hidden.
#[test]
fn two_targets_need_another_one() {
    let exact = "placement = \"exact\"";
    let two = [("one", "[\"0 mm\", \"0 mm\", \"0 mm\"]"), ("two", "[\"0 mm\", \"50 mm\", \"0 mm\"]")];
    let mounting = planned_by(&tracked(exact, &two)).mounting.expect("hidden numbers");
    assert!(is_hidden_by(&mounting, "e_s of A6", "a of A6"), "{mounting:?}");
    assert!(mounting.is_additional && mounting.target_on_axis.is_none());
    assert!(mounting.is_exact && mounting.planned_targets == 2, "{mounting:?}");
    let [x, y, z] = mounting.position.map(|x| format!("\"{x} mm\""));
    let added = format!("[{x}, {y}, {z}]");
    let there = planned_by(&tracked(exact, &[two[0], two[1], ("three", &added)])).mounting;
    assert!(there.is_none(), "{there:?}");
}

/// The place of the advised target must be known as exactly as that of the planned one.
#[test]
fn advice_for_a_known_place_needs_a_known_place() {
    let mounting = planned_point(0.0, "placement = \"exact\"\n").mounting.expect("hidden numbers");
    assert!(mounting.is_additional && mounting.is_exact, "{mounting:?}");
    assert!(mounting.numbers.iter().any(|one| one.is_hidden && one.name == "e_s of A6"), "{mounting:?}");
}
