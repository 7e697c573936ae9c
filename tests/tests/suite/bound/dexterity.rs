//! The smallest singular value of `J_q` is never below its certified bound.

use abbe::{Manipulator, Orientation, VariableKind, deviation};
use abbe_bound::{Effort, Extreme, Moving, Singular, singular_value};
use abbe_codegen::chain::Dexterity;
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use nalgebra::DMatrix;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{given, home, moving, part, place, robot, robots};

/// Returns the certified values over a box, for the position and for the whole pose.
fn least(spec: &Spec, box_: &[Moving], effort: &Effort) -> Option<Vec<Singular>> {
    let Dexterity { graph, point, pose } = Dexterity::new(spec)?;
    let all = std::iter::once(point).chain(pose);
    let least = |rows: Vec<_>| {
        let still = |symbol| home(symbol, spec);
        singular_value(Extreme::Least, &graph, &rows, box_, &still, effort, &mut |_| true)
    };
    Some(all.map(least).collect())
}

/// Returns the singular values at a configuration, by central differences in metres and rad.
fn values(robot: &Interpreter, q: &[f64]) -> [f64; 2] {
    let description = robot.description();
    let metre = 1.0 / description.length.in_metres();
    let mut jacobian = DMatrix::zeros(6, q.len());
    for (j, variable) in description.variables.iter().enumerate() {
        let unit = if variable.kind == VariableKind::Revolute { 1.0 } else { metre };
        let moved = |step: f64| {
            let mut moved = q.to_vec();
            moved[j] += step * unit;
            robot.pose(&moved, &abbe::analysis::sampling::nominal_parameters(description)).unwrap()
        };
        let rows = deviation(Orientation::RotationVector, &moved(-1e-5), &moved(1e-5));
        for (i, row) in rows.into_iter().enumerate() {
            jacobian[(i, j)] = row / if i < 3 { 2e-5 * metre } else { 2e-5 };
        }
    }
    let least =
        |rows: usize| jacobian.rows(0, rows).singular_values().iter().copied().fold(f64::INFINITY, f64::min);
    [least(3), least(6)]
}

#[test]
fn nothing_is_below_what_is_certified() {
    let (mut known, mut looked) = (0, 0);
    for seed in robots() {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let spec = Spec::parse("robot.toml", &robot::spec(&mut random)).unwrap();
        let (robot, all) = (Interpreter::new(spec.clone()), moving(&spec));
        for _ in 0..given("ABBE_BOXES", 4) {
            let box_ = part(&all, &mut random);
            let Some(least) = least(&spec, &box_, &Effort { gap: 0.02, boxes: 2000, ..Effort::default() })
            else {
                continue;
            };
            for (k, least) in least.iter().enumerate() {
                let found = values(&robot, &least.at[..spec.variables.len()])[k];
                assert!((found - least.found.unwrap()).abs() < 1e-7, "robot {seed}: {found} {least:?}");
                assert!(
                    !least.complete || least.certified >= 0.98 * least.found.unwrap() - 1e-8,
                    "{least:?}"
                );
                known += usize::from(least.certified > 1e-6);
            }
            for _ in 0..given("ABBE_SAMPLES", 30) {
                let place = place(&box_, &mut random);
                let values = values(&robot, &place[..spec.variables.len()]);
                looked += 1;
                for (value, least) in values.into_iter().zip(&least) {
                    assert!(
                        value >= least.certified - 1e-8,
                        "robot {seed}: {value} below {least:?}\n{place:?}"
                    );
                }
            }
        }
    }
    let least = robots().count();
    assert!(known > least && looked > 33 * least, "{known} are above 0, {looked} places looked at");
}

/// Checks closed forms. The three perpendicular slides of the paper's positioner move the tool
/// point by at least 1. Two bars of 400 mm and 300 mm with a slide across them, at an elbow angle
/// β, have `σ² = (a ∓ √(a² − 4 (400·300 sin β)²))/2` with `a = 400² + 2·300² + 2·400·300 cos β` in
/// mm².
#[test]
fn what_is_known_is_found() {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap();
    let spec = Spec::parse("pps.toml", shipped.spec).unwrap();
    let [point, _] = &least(&spec, &moving(&spec), &Effort { boxes: 2000, ..Effort::default() }).unwrap()[..]
    else {
        panic!()
    };
    assert!(point.complete && point.certified > 0.99 && point.found.unwrap() < 1.0 + 1e-9, "{point:?}");

    let joint = |name: &str, limits: &str, kind: &str, transform: &str| {
        format!(
            "[[frame]]\nname = \"{name}\"\nvariable = {{ name = \"{name}\", kind = \"{kind}\", limits = {limits}, home = \"1\" }}\n\
             transform = \"{transform}\"\n"
        )
    };
    for (low, high) in [(0.2_f64, 1.4_f64), (0.0, 1.0), (2.0, 3.0)] {
        let text = format!(
            "[manipulator]\nname = \"bars\"\nlength = \"m\"\n{}{}{}[tool]\ntransform = \"Tx(0.3)\"\n",
            joint("shoulder", "[\"-3\", \"3\"]", "revolute", "Rz(shoulder)"),
            joint("elbow", "[\"-3\", \"3\"]", "revolute", "Tx(0.4) Rz(elbow)"),
            joint("slide", "[0, 1]", "prismatic", "Tz(slide)")
        );
        let spec = Spec::parse("bars.toml", &text).unwrap();
        let mut all = moving(&spec);
        all[1].range = [low, high];
        let value = |bend: f64| {
            let a = 0.16 + 2.0 * 0.09 + 2.0 * 0.12 * bend.cos();
            let root = (a * a - 4.0 * (0.12 * bend.sin()).powi(2)).sqrt();
            (0.5 * (a - root)).sqrt()
        };
        let exact = value(low).min(value(high));
        let [least] = &least(&spec, &all, &Effort::default()).unwrap()[..] else { panic!() };
        assert!(
            least.complete && least.certified <= exact + 1e-12 && least.found.unwrap() >= exact - 1e-8,
            "{exact} {least:?}"
        );
        assert!(
            least.certified >= 0.99 * exact - 1e-8 && least.found.unwrap() <= exact / 0.99 + 1e-8,
            "{exact} {least:?}"
        );
    }
}
