//! Arms whose gears wind up under their links and a payload: their largest deflection over all
//! joints is certified closely. The product of a pose and a weight makes this hard.

use std::fmt::Write as _;

use abbe_bound::Effort;
use abbe_codegen::chain::Magnitudes;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::{sample_size, thorough};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{ROUNDING, bounded, moving, place, sizes};

/// Joint of an arm: limits in degrees, or in mm of a slide; matrix; compliance of its gear in
/// 1/(N·mm).
type Joint = (&'static str, [i32; 2], &'static str, f64);

/// Returns an arm with gears, weights at its links, and a payload on its last frame. A joint `d`
/// is a slide.
fn arm(
    joints: &[Joint],
    masses: &[(&str, &str, [i32; 3])],
    [payload, tool]: [&str; 2],
    point: [i32; 3],
) -> Spec {
    let last = joints.last().map_or("", |(name, ..)| name);
    let mut text = format!(
        "[manipulator]\nname = \"arm\"\nlength = \"mm\"\ngravity = [0, 0, \"-9.81 m/s^2\"]\n\
         [inputs]\npayload = {{ value = \"{payload}\", range = [\"0 kg\", \"{payload}\"] }}\n\
         [tool]\ntransform = \"{tool}\"\n\
         [[load]]\nmass = \"payload\"\nframe = \"{last}\"\npoint = {point:?}\n"
    );
    for (joint, [low, high], transform, compliance) in joints {
        let (kind, unit) = if *joint == "d" { ("prismatic", "mm") } else { ("revolute", "deg") };
        let _ = write!(
            text,
            "[[frame]]\nname = \"{joint}\"\ntransform = \"{transform}\"\n\
             variable = {{ name = \"{joint}\", kind = \"{kind}\", limits = [\"{low} {unit}\", \"{high} {unit}\"] }}\n"
        );
        if *compliance > 0.0 {
            let _ = write!(
                text,
                "[[source]]\nname = \"gear of {joint}\"\nclass = \"repeatable\"\nframe = \"{joint}\"\n\
                 compliance = {{ diagonal = [0, 0, 0, 0, \"{compliance:e} /(N*mm)\", 0] }}\n"
            );
        }
    }
    for (mass, frame, point) in masses {
        let _ = write!(text, "[[load]]\nmass = \"{mass}\"\nframe = \"{frame}\"\npoint = {point:?}\n");
    }
    Spec::parse("arm.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"))
}

/// Holds that the largest deflection is attained, certified within `gap` times what is found in a
/// number of boxes, more of them in a thorough run, and exceeded at no drawn place.
fn is_certified_closely(name: &str, spec: &Spec, [few, many]: [(usize, f64); 2]) {
    let (robot, all) = (Interpreter::new(spec.clone()), moving(spec));
    let mut magnitudes = Magnitudes::new(spec, &[]);
    let norm = magnitudes.repeatable[0].clone();
    let (boxes, gap) = if thorough() { many } else { few };
    let bound = bounded(spec, &mut magnitudes, &norm, &all, &Effort { boxes, ..Effort::default() });
    let ratio = bound.certified / bound.found;
    println!(
        "{name}: found {:.4} mm, certified {:.4} mm, {ratio:.4} times, {} boxes",
        bound.found, bound.certified, bound.boxes
    );
    assert!((1.0 - ROUNDING..=gap).contains(&ratio), "{name}: {ratio}");
    let size = |at: &[f64]| {
        let (q, u) = at.split_at(spec.variables.len());
        sizes(&robot, q, u).unwrap()[0][0]
    };
    let attained = size(&bound.at);
    assert!((attained / bound.found - 1.0).abs() < 1e-9, "{name}: {attained} at {:?}", bound.at);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(3);
    for _ in 0..sample_size(20_000) {
        let at = place(&all, &mut random);
        let drawn = size(&at);
        assert!(drawn <= bound.certified * (1.0 + ROUNDING), "{name}: {drawn} at {at:?}");
    }
}

/// A six-axis arm of 0.9 m reach for 6 kg.
#[test]
fn a_small_six_axis_arm() {
    let joints = [
        ("q1", [-170, 170], "Tz(400) Rz(q1)", 2e-9),
        ("q2", [-190, 45], "Tx(25) Rx(-90 deg) Rz(q2)", 2.5e-9),
        ("q3", [-120, 156], "Tx(455) Rz(q3)", 5e-9),
        ("q4", [-185, 185], "Tx(420) Ty(-35) Rx(90 deg) Ry(90 deg) Rz(q4)", 2e-8),
        ("q5", [-120, 120], "Rx(-90 deg) Rz(q5)", 3e-8),
        ("q6", [-350, 350], "Rx(90 deg) Rz(q6) Tz(80)", 5e-8),
    ];
    let masses = [("15 kg", "q2", [220, 0, 50]), ("12 kg", "q3", [60, -20, 0])];
    let spec = arm(&joints, &masses, ["6 kg", "Tx(40) Tz(150)"], [30, 20, 60]);
    is_certified_closely("small six-axis arm", &spec, [(400, 1.5), (4000, 1.05)]);
}

/// A six-axis arm with three parallel axes, as large as a UR5, with joints of two turns: a few
/// hundred boxes certify nothing.
#[test]
fn a_six_axis_arm_with_three_parallel_axes() {
    let joints = [
        ("q1", [-360, 360], "Rz(q1) Tz(89) Rx(90 deg)", 4e-9),
        ("q2", [-360, 360], "Rz(q2) Tx(-425)", 4e-9),
        ("q3", [-360, 360], "Rz(q3) Tx(-392)", 6e-9),
        ("q4", [-360, 360], "Rz(q4) Tz(109) Rx(90 deg)", 3e-8),
        ("q5", [-360, 360], "Rz(q5) Tz(95) Rx(-90 deg)", 3e-8),
        ("q6", [-360, 360], "Rz(q6) Tz(82)", 3e-8),
    ];
    let masses = [("8 kg", "q2", [212, 0, 110]), ("2.3 kg", "q3", [150, 0, 25]), ("1.2 kg", "q5", [0, 0, 0])];
    let spec = arm(&joints, &masses, ["5 kg", "Tz(60)"], [0, 20, 40]);
    is_certified_closely("three parallel axes", &spec, [(400, f64::INFINITY), (4000, 1.13)]);
}

/// A seven-axis arm on a rail: eight joints.
#[test]
fn an_arm_of_seven_axes_on_a_rail() {
    let joints = [
        ("d", [0, 3000], "Ty(d)", 0.0),
        ("q1", [-170, 170], "Tz(340) Rz(q1)", 2e-9),
        ("q2", [-120, 120], "Rx(-90 deg) Rz(q2)", 2e-9),
        ("q3", [-170, 170], "Rx(90 deg) Tz(400) Rz(q3)", 5e-9),
        ("q4", [-120, 120], "Rx(90 deg) Rz(q4)", 5e-9),
        ("q5", [-170, 170], "Rx(-90 deg) Tz(400) Rz(q5)", 2e-8),
        ("q6", [-120, 120], "Rx(-90 deg) Rz(q6)", 2e-8),
        ("q7", [-175, 175], "Rx(90 deg) Rz(q7)", 3e-8),
    ];
    let masses = [("6 kg", "q2", [0, -200, 20]), ("5 kg", "q4", [0, 180, 20])];
    let spec = arm(&joints, &masses, ["7 kg", "Tx(20) Tz(126)"], [20, 0, 80]);
    is_certified_closely("seven axes on a rail", &spec, [(400, 2.96), (1000, 2.96)]);
}
