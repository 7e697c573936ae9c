//! Limits of sums of joints, joints that move together, and inputs at levels.

use abbe::analysis::sampling::{halton, home, nominal_parameters};
use abbe::analysis::{Axis, ReachError};
use abbe::analysis::{Target, Workspace, inverse, joint_grid, joint_samples, random_joint_samples};
use abbe::{Manipulator, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::number::beyond_sum_limit;

use crate::reach::random_spec;

/// Returns a random chain whose first two joints of a kind have a limit of their sum, and whose
/// next one of that kind, if any, follows them.
fn limited(seed: usize) -> Interpreter {
    let text = random_spec(seed);
    let spec = Spec::parse("any.toml", &text).expect("a spec");
    let of = |kind: VariableKind| spec.variables.iter().filter(move |one| one.kind == kind);
    let slides = of(VariableKind::Prismatic).count() > of(VariableKind::Revolute).count();
    let kind = if slides { VariableKind::Prismatic } else { VariableKind::Revolute };
    let alike: Vec<&str> = of(kind).map(|one| &*one.name).collect();
    let number = |i| halton(3 + seed, i);
    let mut limits = format!(
        "[[limit]]\nsum = \"{} - {:.3}*{}\"\nlimits = [{:.3}, {:.3}]\n",
        alike[0],
        number(0),
        alike[1],
        -0.2 - number(1),
        0.1 + number(2)
    );
    if let Some(third) = alike.get(2).filter(|_| seed.is_multiple_of(2)) {
        limits += &format!("[[limit]]\nsum = \"{third} + 0.5*{}\"\nequals = 0\n", alike[0]);
    }
    Interpreter::new(Spec::parse("any.toml", &(text + &limits)).expect("a spec with limits"))
}

/// Checks that each sample is within all limits, and that the inverse finds a configuration within
/// all limits for its pose.
#[test]
fn samples_and_solutions_are_within_the_limits_of_sums() {
    let (mut reached, mut refused) = (0, 0);
    for seed in 0..20 {
        let manipulator = limited(seed);
        let description = manipulator.description();
        let all: Vec<usize> = (0..description.variables.len()).collect();
        let within = |q: &[f64]| {
            let mut variables = description.variables.iter().zip(q);
            description.sum_limits.iter().all(|limit| limit.permits(q))
                && variables.all(|(one, q)| (one.limits[0]..=one.limits[1]).contains(q))
        };
        let (s, start) = (nominal_parameters(description), home(description));
        for samples in [
            joint_samples(&manipulator, &all, 200).unwrap(),
            random_joint_samples(&manipulator, &all, 200, 5).unwrap(),
        ] {
            let samples = samples.reached();
            assert_eq!(samples.len(), 200, "{seed}");
            assert!(samples.iter().all(|sample| within(&sample.q)), "{seed}");
            assert!(samples.windows(2).all(|two| two[0].q != two[1].q), "{seed}");
            for sample in samples.iter().take(8) {
                let pose = manipulator.pose(&sample.q, &s).unwrap();
                match inverse(&manipulator, &s, &start, &all, &Target::Pose(pose)) {
                    Ok(q) => {
                        reached += 1;
                        assert!(within(&q), "{seed}: {q:?}");
                        let there = manipulator.pose(&q, &s).unwrap();
                        let entries = there.0.as_flattened().iter().zip(pose.0.as_flattened());
                        assert!(entries.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-8, "{seed}");
                    }
                    Err(_) => refused += 1,
                }
            }
        }
    }
    assert!(refused <= 16, "{refused} of {}", reached + refused);
}

const GANTRY: &str = r#"
    [manipulator]
    name = "gantry"
    length = "mm"
    [inputs.payload]
    value = "0 kg"
    levels = ["8 kg", "0 kg"]
    [[frame]]
    name = "left"
    variable = { name = "x1", kind = "prismatic", limits = [0, 1000] }
    transform = "Tx(x1)"
    [[frame]]
    name = "bridge"
    variable = { name = "x2", kind = "prismatic", limits = [0, 1000] }
    transform = "Ty(800) Rz((x2 - x1) / (800 mm)) Ty(-800)"
    [[frame]]
    name = "carriage"
    variable = { name = "y", kind = "prismatic", limits = [0, 700] }
    transform = "Ty(y)"
    [[limit]]
    sum = "x1 - x2"
    equals = 0
    [[limit]]
    sum = "x1 + 2*y"
    limits = [0, 1500]
"#;

/// Checks that the racks of a gantry move together: in samples, in grids of one rack, and for a
/// point that both reach.
#[test]
fn racks_of_a_gantry_move_together() {
    let gantry = Interpreter::new(Spec::parse("gantry.toml", GANTRY).unwrap());
    let samples = joint_samples(&gantry, &[0, 1, 2], 500).unwrap().inputs(&gantry, &[0]).unwrap().reached();
    assert_eq!(samples.len(), 500);
    assert!(samples.iter().all(|one| one.q[0] == one.q[1] && one.q[0] + 2.0 * one.q[2] <= 1500.0));
    // Payloads between the levels do not exist.
    for level in [0.0, 8.0] {
        let here = samples.iter().filter(|one| one.u == [level]).count();
        assert!((225..=275).contains(&here), "{here}");
    }
    let axis = |index: usize, values: &[f64]| Axis { index, values: values.to_vec() };
    let grid = joint_grid(&gantry, &[axis(0, &[0.0, 900.0]), axis(2, &[100.0, 600.0])]).unwrap();
    let q: Vec<Vec<f64>> = grid.reached().into_iter().map(|one| one.q).collect();
    assert_eq!(q, [[0.0, 0.0, 100.0], [0.0, 0.0, 600.0], [900.0, 900.0, 100.0]]);
    let reason = grid.configuration(3).unwrap_err();
    assert_eq!(reason, ReachError::OutsideSumLimit { limit: 1, value: 2100.0 });
    let unit = gantry.description().length;
    let limits = &gantry.description().sum_limits;
    assert_eq!(beyond_sum_limit(&limits[0], 1.0, unit), "x1 - x2 = 1 mm, which must be 0 mm");
    assert_eq!(
        beyond_sum_limit(&limits[1], 2100.0, unit),
        "x1 + 2*y = 2100 mm, outside its limits 0 mm … 1500 mm"
    );
    // A grid of both racks has what the racks cannot do.
    let both = joint_grid(&gantry, &[axis(0, &[0.0, 10.0]), axis(1, &[0.0, 10.0])]).unwrap();
    assert_eq!(both.reached().len(), 2);
    let target = Target::Point([400.0, 300.0, 0.0]);
    let found = inverse(&gantry, &[], &[0.0; 3], &[0, 1, 2], &target).unwrap();
    assert!(found[0] == found[1] && (found[0] - 400.0).abs() < 1e-6, "{found:?}");
    let far = inverse(&gantry, &[], &[0.0; 3], &[0, 1, 2], &Target::Point([900.0, 600.0, 0.0]));
    assert!(matches!(far, Err(ReachError::OutsideSumLimit { limit: 1, .. })), "{far:?}");
}

/// Checks that a sum is an angle or a length by its dimension, whatever its first joint is.
#[test]
fn a_sum_of_an_angle_and_a_length_has_the_unit_of_its_whole() {
    let text = |limit: &str| {
        format!(
            "[manipulator]\nname = \"lift\"\nlength = \"mm\"\n\
             [[frame]]\nname = \"turn\"\nvariable = {{ name = \"q\", kind = \"revolute\" }}\ntransform = \"Rz(q)\"\n\
             [[frame]]\nname = \"lift\"\nvariable = {{ name = \"d\", kind = \"prismatic\" }}\ntransform = \"Tz(d)\"\n\
             [[limit]]\n{limit}\n"
        )
    };
    for (limit, kind, shown) in [
        (
            "sum = \"5 mm * q +\\n d\"\nlimits = [0, 10]",
            VariableKind::Prismatic,
            "5 mm * q + d = 20 mm, outside",
        ),
        (
            "sum = \"q + d/(100 mm)\"\nlimits = [0, 1]",
            VariableKind::Revolute,
            "q + d/(100 mm) = 1145.9156°, outside",
        ),
    ] {
        let spec = Spec::parse("lift.toml", &text(limit)).expect("a spec");
        assert_eq!(spec.sum_limits[0].kind, kind);
        let found = beyond_sum_limit(&spec.sum_limits[0], 20.0, spec.length);
        assert!(found.starts_with(shown), "{found}");
    }
}
