//! Frames of a machine as a URDF, and its loops beside it.

use std::collections::BTreeMap;
use std::fmt::Write;

use abbe::Manipulator;
use abbe::analysis::sampling;
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_study::export::{Export, Format, Report};
use abbe_tests::closed_machines;
use abbe_tests::mechanisms::{Mechanism, is_regular};
use nalgebra::{DMatrix, DVector, Isometry3, Matrix4, Translation3, UnitQuaternion, Vector3};

use super::{machine, numbers, shipped};
use crate::exported::{matrix, urdf::all_errors};

/// Joint of a URDF.
struct Joint {
    name: String,
    parent: String,
    origin: Isometry3<f64>,
    /// Rotation or translation, and its axis.
    motion: Option<(bool, Vector3<f64>)>,
}

/// A URDF and the file of its loops.
struct Closed {
    /// Joints by their child links.
    joints: BTreeMap<String, Joint>,
    /// Keys of the tables of its loops.
    loops: Vec<BTreeMap<String, String>>,
}

impl Closed {
    fn read(report: &Report) -> Self {
        let text = &report.files[0].text;
        let of = |text: &str, key: &str| {
            let (_, rest) = text.split_once(&format!("{key}=\"")).unwrap();
            rest.split('"').next().unwrap().replace("&quot;", "\"").replace("&lt;", "<").replace("&amp;", "&")
        };
        let three = |text: &str| -> [f64; 3] {
            let numbers: Vec<f64> = text.split(' ').map(|number| number.parse().unwrap()).collect();
            numbers.try_into().unwrap()
        };
        let mut joints = BTreeMap::new();
        for joint in text.split("<joint ").skip(1) {
            let joint = joint.split("</joint>").next().unwrap();
            let tag = |name: &str| joint.split_once(&format!("<{name} ")).unwrap().1;
            let [x, y, z] = three(&of(tag("origin"), "xyz"));
            let [roll, pitch, yaw] = three(&of(tag("origin"), "rpy"));
            let axis = || Vector3::from(three(&of(tag("axis"), "xyz")));
            let motion = match &*of(joint, "type") {
                "fixed" => None,
                "prismatic" => Some((false, axis())),
                _ => Some((true, axis())),
            };
            let origin = Translation3::new(x, y, z) * UnitQuaternion::from_euler_angles(roll, pitch, yaw);
            let read = Joint { name: of(joint, "name"), parent: of(tag("parent"), "link"), origin, motion };
            assert!(joints.insert(of(tag("child"), "link"), read).is_none());
        }
        let mut names: Vec<&str> = joints.values().map(|joint| &*joint.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!((names.len(), text.matches("<link name").count()), (joints.len(), joints.len() + 1));
        let keys = |table: &str| -> BTreeMap<String, String> {
            let lines = table.lines().filter_map(|line| line.split_once(" = "));
            lines.map(|(key, value)| (key.to_owned(), value.to_owned())).collect()
        };
        let loops = report
            .files
            .get(1)
            .map_or(Vec::new(), |file| file.text.split("[[loop]]").skip(1).map(keys).collect());
        Self { joints, loops }
    }

    /// Returns the pose of a link in the base.
    fn pose(&self, link: &str, values: &BTreeMap<String, f64>) -> Isometry3<f64> {
        let Some(joint) = self.joints.get(link) else {
            assert!(link.trim_end_matches('_') == "base");
            return Isometry3::identity();
        };
        let motion = match joint.motion {
            None => Isometry3::identity(),
            Some((true, axis)) => Isometry3::rotation(axis * values[&joint.name]),
            Some((false, axis)) => Translation3::from(axis * values[&joint.name]).into(),
        };
        self.pose(&joint.parent, values) * joint.origin * motion
    }

    /// Returns the link of the tool point: frames may have its name.
    fn tool(&self) -> &str {
        let named = self.joints.keys().filter(|link| link.trim_end_matches('_') == "tool");
        named.max_by_key(|link| link.len()).unwrap()
    }

    /// Returns the equations of the loops.
    fn residual(&self, values: &BTreeMap<String, f64>) -> Vec<f64> {
        let mut all = Vec::new();
        for closed in &self.loops {
            // Strings stand between quotation marks.
            let strings = |key: &str| closed[key].split('"').skip(1).step_by(2);
            let mut links = strings("links").map(|link| self.pose(link, values));
            let [a, b] = [links.next().unwrap(), links.next().unwrap()];
            let difference = a.translation.vector - b.translation.vector;
            if closed["closes"] == "\"distance\"" {
                let joint = closed.get("joint").map_or(0.0, |joint| {
                    closed["factor"].parse::<f64>().unwrap() * values[joint.trim_matches('"')]
                });
                all.push(difference.norm() - closed["length"].parse::<f64>().unwrap() - joint);
                continue;
            }
            let axes = self.pose(strings("axes").next().unwrap(), values).rotation;
            let position = axes.inverse() * difference;
            let turn = (a.rotation * b.rotation.inverse()).to_rotation_matrix();
            let turn = turn.matrix() - turn.matrix().transpose();
            let turn = axes.inverse() * Vector3::new(turn[(2, 1)], turn[(0, 2)], turn[(1, 0)]) / 2.0;
            for name in strings("closes") {
                let index =
                    ["x", "y", "z", "rx", "ry", "rz"].into_iter().position(|one| one == name).unwrap();
                all.push(if index < 3 { position[index] } else { turn[index - 3] });
            }
        }
        all
    }

    /// Moves the passive joints until the loops close.
    fn close(&self, values: &mut BTreeMap<String, f64>, passive: &[String]) {
        for _ in 0..6 {
            let residual = DVector::from_vec(self.residual(values));
            let column = |name: &String| {
                let [above, below] = [1e-6, -1e-6].map(|step| {
                    let mut moved = values.clone();
                    *moved.get_mut(name).unwrap() += step;
                    DVector::from_vec(self.residual(&moved))
                });
                (above - below) / 2e-6
            };
            let columns: Vec<_> = passive.iter().map(column).collect();
            let step = DMatrix::from_columns(&columns).svd(true, true).solve(&residual, 1e-12).unwrap();
            passive.iter().zip(step.iter()).for_each(|(name, step)| *values.get_mut(name).unwrap() -= step);
        }
    }
}

/// Checks a URDF at random commands: the passive variables of the nominal machine close its loops,
/// and with loops closed the tool is that of the real machine.
fn is_its_urdf(nominal: &str, errors: &str, reach: f64) {
    let [without, with] = [nominal.to_owned(), format!("{nominal}{errors}")].map(|text| machine(&text));
    let [of_nominal, of_real] = [&without, &with].map(|machine| {
        let job = Export { machine: machine.clone(), format: Format::UrdfTree, samples: 20, seed: 1 };
        let report = job.run(&mut ()).unwrap_or_else(|mistakes| panic!("{mistakes:?}\n{nominal}"));
        (Closed::read(&report), report)
    });
    assert_eq!(of_nominal.1.files.len(), 1 + usize::from(!without.spec.loops.is_empty()));
    let metres = with.spec.length.in_metres();
    let remains = of_real.1.remains;
    assert!(
        remains.position.largest * metres < 1e-9 && remains.angle.largest < 1e-8,
        "{remains:?}\n{nominal}"
    );
    let real = Interpreter::new(with.spec.clone());
    let description = real.description();
    let (s, u) = (sampling::nominal_parameters(description), sampling::nominal_inputs(description));
    let mut random = numbers(5);
    let named = |variables: &[abbe_spec::Variable], values: &[f64]| -> Vec<(String, f64)> {
        let unit = |kind| if kind == abbe::VariableKind::Prismatic { metres } else { 1.0 };
        let named = variables.iter().zip(values);
        named.map(|(variable, value)| (variable.name.clone(), value * unit(variable.kind))).collect()
    };
    for _ in 0..10 {
        let within = |variable: &abbe_spec::Variable| {
            let [lower, upper] = variable.limits;
            let share = 0.3 * random();
            if (upper - lower).is_finite() {
                variable.home + share * (upper - lower) / 2.0
            } else {
                variable.home + share
            }
        };
        let q: Vec<f64> = with.spec.variables.iter().map(within).collect();
        let mut p = vec![0.0; with.spec.passive.len()];
        real.passive(&q, &s, &mut p).unwrap();
        let mut values: BTreeMap<String, f64> =
            named(&with.spec.variables, &q).into_iter().chain(named(&with.spec.passive, &p)).collect();
        let open = of_nominal.0.residual(&values).into_iter().fold(0.0, |most: f64, one| most.max(one.abs()));
        assert!(open < 1e-9, "{open:e}\n{nominal}");
        let passive: Vec<String> = with.spec.passive.iter().map(|one| one.name.clone()).collect();
        if !passive.is_empty() {
            of_real.0.close(&mut values, &passive);
        }
        let open = of_real.0.residual(&values).into_iter().fold(0.0, |most: f64, one| most.max(one.abs()));
        let mut found: Matrix4<f64> = of_real.0.pose(of_real.0.tool(), &values).to_homogeneous();
        found.fixed_view_mut::<3, 1>(0, 3).scale_mut(1.0 / metres);
        let expected = matrix(&real.real_pose(&q, &s, &u).unwrap());
        let shift = (found - expected).fixed_view::<3, 1>(0, 3).norm() * metres;
        let turn = (found - expected).fixed_view::<3, 3>(0, 0).norm();
        assert!(open < 1e-9 && shift < 1e-9 * reach && turn < 1e-8, "{open:e} {shift:e} {turn:e}\n{nominal}");
    }
}

#[test]
fn urdfs_of_shipped_mechanisms_close_as_the_real_machines() {
    for name in ["hexapod", "palletizer", "delta"] {
        let text = shipped(name);
        let nominal = text.split("[[source]]").next().unwrap();
        let spec = Spec::parse(name, nominal).unwrap();
        let mut errors = all_errors(&spec);
        let mut random = numbers(1);
        let parameters = spec.parameters.iter().map(|one| ("parameter", &one.name, "mm"));
        let joints = spec.variables.iter().map(|one| {
            ("joint", &one.name, if one.kind == abbe::VariableKind::Prismatic { "mm" } else { "mrad" })
        });
        for (place, key, unit) in parameters.chain(joints) {
            let _ = write!(
                errors,
                "\n[[source]]\nname = \"{key}\"\nclass = \"repeatable\"\n{place} = \"{key}\"\nerror = \"{} {unit}\"\n",
                random()
            );
        }
        is_its_urdf(nominal, &errors, 10.0);
    }
}

/// Loops of every kind, joints in general position, errors of every frame.
#[test]
fn urdfs_of_random_mechanisms_close_as_the_real_machines() {
    let mut held = 0;
    for seed in 0.. {
        let Mechanism { text, .. } = Mechanism::new(seed);
        let spec = Spec::parse("mechanism.toml", &text).unwrap();
        let errors = all_errors(&spec);
        // Where it closes everywhere.
        let real = machine(&format!("{text}{errors}"));
        let job = Export { machine: real, format: Format::UrdfTree, samples: 20, seed: 1 };
        if is_regular(&Interpreter::new(spec)) && job.run(&mut ()).is_ok() {
            is_its_urdf(&text, &errors, 10.0);
            held += 1;
        }
        assert!(seed < 60, "{held}");
        if held == 12 {
            break;
        }
    }
}

/// Denavit-Hartenberg frames, branches, names that XML escapes, and those of other links.
#[test]
fn urdfs_of_chains_and_branches_are_the_real_machines() {
    let dh = |name: &str, theta: &str| {
        format!(
            "[[frame]]\nname = \"{name}\"\nvariable = {{ name = \"{theta}\", kind = \"revolute\", limits = [-2, 2] }}\n\
             dh = {{ theta = \"{theta}\", d = 40, a = 300, alpha = \"80 deg\" }}\n"
        )
    };
    let text = format!(
        "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n{}{}",
        dh("a < b & c", "q1"),
        dh("arm", "q2")
    );
    let names = format!(
        "[manipulator]\nname = \"arm\"\nlength = \"m\"\n{}{}{}",
        dh("base", "q1").replace("limits = [-2, 2] ", "").replace("\"revolute\", ", "\"revolute\""),
        dh("tool", "q2"),
        dh("tool joint", "q3")
    );
    for text in [text, names] {
        let errors = all_errors(&Spec::parse("arm.toml", &text).unwrap());
        is_its_urdf(&text, &errors, 1e3);
    }
    let text = closed_machines::TWO_ARMS.split("[[source]]").next().unwrap();
    is_its_urdf(text, &all_errors(&Spec::parse("arms.toml", text).unwrap()), 10.0);
}

/// Every shipped machine has a URDF, but that whose joints are matrices.
#[test]
fn shipped_machines_have_urdfs() {
    for shipped in SHIPPED {
        let job = Export { machine: machine(shipped.spec), format: Format::UrdfTree, samples: 5, seed: 0 };
        let exported = job.run(&mut ());
        if shipped.name == "puma560" {
            let message = &exported.unwrap_err().list[0].message;
            assert!(message.contains("\"waist\" is a matrix: give it as `transform` or `dh`"), "{message}");
            continue;
        }
        let report = exported.unwrap_or_else(|mistakes| panic!("{}: {mistakes:?}", shipped.name));
        let urdf = Closed::read(&report);
        assert!(urdf.joints.len() > machine(shipped.spec).spec.frames.len(), "{}", shipped.name);
    }
}

/// The page shows a loop of the file.
#[test]
fn the_page_has_a_loop_of_the_shipped_hexapod() {
    let text = shipped("hexapod").replace("value = \"2 K\", range = [\"-5 K\", \"5 K\"]", "value = \"0 K\"");
    let job = Export { machine: machine(&text), format: Format::UrdfTree, samples: 5, seed: 0 };
    let report = job.run(&mut ()).unwrap();
    let page = include_str!("../../../../../docs/export.md");
    let shown = page.split("```").find(|block| block.starts_with("text\n[[loop]]")).unwrap();
    assert!(report.files[1].text.contains(&shown["text".len()..]), "{}", report.files[1].text);
}

#[test]
fn what_a_urdf_cannot_hold_is_refused() {
    let bar = closed_machines::FOUR_BAR;
    for (text, message) in [
        (bar.replace("\"Rz(p1) Tx(120)\"", "\"Rz(2*p1) Tx(120)\""), "\"coupler\" does not move as a joint"),
        (bar.replace("\"Rz(p1) Tx(120)\"", "\"Rz(p1 + q1) Tx(120)\""), "\"coupler\" does not move as a joint"),
        (shipped("hexapod").replace("\"leg + q3\"", "\"leg + 2*q3\""), "\"leg 3\" is longer than"),
        (
            "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[[frame]]\nname = \"arm\"\n\
             variable = { name = \"q1\", kind = \"revolute\", limits = [-2, 2] }\n\
             dh = { theta = \"q1\", d = 40, a = 300, alpha = 0 }\n\
             [[source]]\nname = \"dh\"\nclass = \"repeatable\"\nframe = \"arm\"\ndh = { theta = \"1 mrad\" }\n"
                .to_owned(),
            "takes no errors of Denavit-Hartenberg numbers",
        ),
    ] {
        let job = Export { machine: machine(&text), format: Format::UrdfTree, samples: 5, seed: 0 };
        let mistake = job.run(&mut ()).unwrap_err();
        assert!(mistake.list[0].message.contains(message), "{mistake:?}");
    }
}
