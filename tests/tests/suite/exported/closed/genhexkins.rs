//! Six legs of a platform as parameters of LinuxCNC.

use std::collections::BTreeMap;
use std::fmt::Write;

use abbe::Manipulator;
use abbe::analysis::sampling;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_study::Machine;
use abbe_study::export::{Export, Format, Report};
use abbe_tests::closed_machines;
use nalgebra::{Matrix3, Vector3};

use super::{machine, numbers, shipped};
use crate::exported::{exported, matrix, urdf::all_errors};

/// Parameters of genhexkins in a HAL file, and the positions of its joints where the variables of
/// the spec are 0.
struct Hal {
    base: [Vector3<f64>; 6],
    platform: [Vector3<f64>; 6],
    offsets: [f64; 6],
    /// X, Y, Z in mm, A, B, C in degrees.
    home: [f64; 6],
}

impl Hal {
    fn read(text: &str) -> Self {
        let mut pins = BTreeMap::new();
        let mut offsets = [f64::NAN; 6];
        let mut home = [f64::NAN; 6];
        for line in text.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            match words[..] {
                ["setp", pin, value] => assert!(pins.insert(pin, value.parse().unwrap()).is_none()),
                ["#", joint, "HOME_OFFSET", "=", value, ..] => {
                    let joint: usize =
                        joint.trim_start_matches("[JOINT_").trim_end_matches(']').parse().unwrap();
                    offsets[joint] = value.parse().unwrap();
                }
                ["#", "[TRAJ]", "HOME", "=", ref values @ ..] => {
                    home = std::array::from_fn(|i| values[i].parse().unwrap());
                }
                _ => assert!(line.starts_with("# "), "{line}"),
            }
        }
        assert_eq!((pins["genhexkins.spindle-offset"], pins["genhexkins.screw-lead"]), (0.0, 0.0));
        assert_eq!(pins.len(), 38);
        let point = |of: &str, n: usize| {
            let [x, y, z] = ["x", "y", "z"].map(|axis| pins[&*format!("genhexkins.{of}.{n}.{axis}")]);
            Vector3::new(x, y, z)
        };
        let [base, platform] = ["base", "platform"].map(|of| std::array::from_fn(|n| point(of, n)));
        Self { base, platform, offsets, home }
    }

    /// Returns the positions of the joints by genhexkins, at the coordinates of the axes.
    fn joints(&self, [x, y, z, a, b, c]: [f64; 6]) -> [f64; 6] {
        let rotation = turned([a, b, c]);
        std::array::from_fn(|n| (Vector3::new(x, y, z) + rotation * self.platform[n] - self.base[n]).norm())
    }
}

/// Returns Rz(c) Ry(b) Rx(a), in degrees.
fn turned(angles: [f64; 3]) -> Matrix3<f64> {
    let [(sa, ca), (sb, cb), (sc, cc)] = angles.map(|angle| angle.to_radians().sin_cos());
    Matrix3::new(cc, -sc, 0.0, sc, cc, 0.0, 0.0, 0.0, 1.0)
        * Matrix3::new(cb, 0.0, sb, 0.0, 1.0, 0.0, -sb, 0.0, cb)
        * Matrix3::new(1.0, 0.0, 0.0, 0.0, ca, -sa, 0.0, sa, ca)
}

/// Checks that the real machine is in the pose for which genhexkins computes its joints.
fn is_where_genhexkins_has_it(machine: &Machine, seed: u64) -> Report {
    let report = exported(machine, Format::LinuxCncGenhexkins);
    let hal = Hal::read(&report.files[0].text);
    let real = Interpreter::new(machine.spec.clone());
    let description = real.description();
    let (s, u) = (sampling::nominal_parameters(description), sampling::nominal_inputs(description));
    let mm = machine.spec.length.in_metres() * 1e3;
    let mut random = numbers(seed);
    for sample in 0..50 {
        let range = if sample == 0 { [0.0; 6] } else { [15.0, 15.0, 15.0, 2.0, 2.0, 2.0] };
        let axes: [f64; 6] = std::array::from_fn(|i| hal.home[i] + range[i] * random());
        let joints = hal.joints(axes);
        let q: Vec<f64> =
            joints.iter().zip(hal.offsets).map(|(joint, offset)| (joint - offset) / mm).collect();
        if sample == 0 {
            let homes = description.variables.iter().map(|variable| variable.home);
            assert!(q.iter().zip(homes).all(|(q, home)| (q - home).abs() * mm < 1e-6), "{q:?}");
        }
        let found = matrix(&real.real_pose(&q, &s, &u).unwrap());
        let [x, y, z, a, b, c] = axes;
        let shift = (found.fixed_view::<3, 1>(0, 3) * mm - Vector3::new(x, y, z)).norm();
        let turn = (found.fixed_view::<3, 3>(0, 0) - turned([a, b, c])).norm();
        assert!(shift < 1e-9 * 750.0 && turn < 1e-9, "{seed} {sample}: {shift:e} mm, {turn:e}");
    }
    let [position, angle] = [report.remains.position.largest * mm, report.remains.angle.largest];
    assert!(position < 1e-6 && angle < 1e-8, "{:?}", report.remains);
    report
}

/// The joints of base and platform and the lengths, of random hexapods.
#[test]
fn six_legs_of_linuxcnc_are_the_real_ones() {
    for seed in 0..8 {
        let mut random = numbers(seed);
        let errors = std::array::from_fn(|_| std::array::from_fn(|_| 0.5 * random()));
        // Where it closes everywhere.
        let text = closed_machines::hexapod(&errors, "").replace("[-60, 150]", "[-30, 40]");
        let report = is_where_genhexkins_has_it(&machine(&text), seed);
        assert!(report.before.position.largest > 0.05, "{:?}", report.before);
        assert!(report.sign.contains(" mm from that of the nominal one"), "{}", report.sign);
    }
}

/// Errors of parameters, of every frame and of the tool, with constant legs; frames before the
/// platform have no effect.
#[test]
fn errors_of_every_part_are_in_the_six_legs() {
    let text = shipped("hexapod").replace("\"12e-6/K*leg*warming\"", "0.0137");
    let text = text.replace("Ty(900) Tz(250)", "Ty(900) Tz(250) Rx(0.3) Rz(-0.4)");
    let spec = Spec::parse("hexapod.toml", &text).unwrap();
    let mut random = numbers(77);
    let mut errors = all_errors(&spec);
    for (place, key) in [("parameter", "base_radius"), ("joint", "q2"), ("joint", "q5")] {
        let _ = write!(
            errors,
            "\n[[source]]\nname = \"{key}\"\nclass = \"repeatable\"\n{place} = \"{key}\"\nerror = {}\n",
            random()
        );
    }
    is_where_genhexkins_has_it(&machine(&(text + &errors)), 3);
}

/// A leg that warms up is as long as on average.
#[test]
fn varying_lengths_are_held_at_their_mean() {
    let report = exported(&machine(&shipped("hexapod")), Format::LinuxCncGenhexkins);
    assert!(report.left_out[0].contains("\"warm legs\""), "{:?}", report.left_out);
    let [before, remains] = [report.before.position.rms, report.remains.position.rms];
    assert!(0.01 < remains && remains < before, "{before} {remains}");
}

#[test]
fn what_six_legs_cannot_be_is_refused() {
    let hexapod = shipped("hexapod");
    for (text, message) in [
        (shipped("delta"), "the machine has 3 commanded joints and 6 loops"),
        (shipped("pps_hexapod"), "the machine has 12 commanded joints and 6 loops"),
        (hexapod.replace("\"leg + q3\"", "\"leg + 2*q3\""), "no leg has the length `q3` and a constant"),
        (hexapod.replace("\"leg + q3\"", "\"leg - q3\""), "no leg has the length `q3` and a constant"),
        (
            hexapod.replace(
                "\"platform joint 4\"\nparent = \"platform\"",
                "\"platform joint 4\"\nparent = \"platform pitch\"",
            ),
            "\"leg 4\" does not join the base and the part that carries the tool",
        ),
    ] {
        let job = Export { machine: machine(&text), format: Format::LinuxCncGenhexkins, samples: 5, seed: 0 };
        let mistake = job.run(&mut ()).unwrap_err();
        assert!(mistake.list[0].message.contains(message), "{mistake:?}");
        assert!(mistake.list[0].help.as_ref().unwrap().contains("`abbe generate`"), "{mistake:?}");
    }
}
