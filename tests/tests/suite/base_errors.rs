//! Errors of `F_0`, such as the levelling of the base: those of a first frame without a transform.

use abbe::analysis::sampling::halton;
use abbe::analysis::{BudgetOptions, Configuration, error_budget, joint_samples};
use abbe::{Manipulator, drawn_pose};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

const ERRORS: &str = r#"
    [[source]]
    name = "levelling"
    class = "repeatable"
    frame = "BASE"
    at = "Tx(100) Rz(20 deg)"
    e_p = "0.3 mrad"
    e_z = "0.2 mm"
    [[source]]
    name = "floor"
    class = "tolerance"
    frame = "BASE"
    e_s = "0.4 mrad"
    [[source]]
    name = "zero"
    class = "repeatable"
    joint = "q1"
    error = "2 mrad"
    [[source]]
    name = "first link"
    class = "random"
    distribution = "uniform"
    frame = "shoulder"
    at = "Tz(150)"
    e_r = "0.1 mrad"
    [[source]]
    name = "mounts"
    class = "repeatable"
    frame = "BASE"
    compliance = { diagonal = [0, 0, 0, "0.002 mrad / (N*m)", 0, "0.001 mrad / (N*m)"] }
    [[load]]
    frame = "elbow"
    mass = "20 kg"
    [gravity]
"#;

/// Returns an arm with a first frame without a transform, or with errors of `F_0` instead.
fn arm(own: bool, first: &str) -> Interpreter {
    let head = "[manipulator]\nname = \"arm\"\nlength = \"mm\"\ngravity = [0, 0, \"-9.81 m/s^2\"]\n";
    let base = if own { "[[frame]]\nname = \"base\"\ntransform = \"Tx(0)\"\n" } else { "" };
    let frames = format!(
        "{base}[[frame]]\nname = \"shoulder\"\nvariable = {{ name = \"q1\", kind = \"revolute\", limits = [-3, 3] }}\n{first}\n\
         [[frame]]\nname = \"elbow\"\nvariable = {{ name = \"q2\", kind = \"revolute\", limits = [-2, 2] }}\n\
         transform = \"Tx(400) Rx(q2)\"\n[tool]\ntransform = \"Tx(300) Ty(50)\"\n"
    );
    let errors = ERRORS.replace("BASE", "base").replace("    [gravity]\n", "");
    Interpreter::new(Spec::parse("arm.toml", &(head.to_owned() + &frames + &errors)).expect("a spec"))
}

#[test]
fn errors_of_the_base_are_those_of_a_frame_before_all_others() {
    for first in [
        "transform = \"Tz(300) Rz(q1) Rx(30 deg)\"",
        "dh = { theta = \"q1\", d = 300, a = 20, alpha = \"90 deg\" }",
        "matrix = [[\"cos(q1)\", \"-sin(q1)\", 0, 10], [\"sin(q1)\", \"cos(q1)\", 0, 20], [0, 0, 1, 300], [0, 0, 0, 1]]",
    ] {
        let [with, without] = [true, false].map(|own| arm(own, first));
        let figures = |robot: &Interpreter| {
            let samples = joint_samples(robot, &[0, 1], 100).unwrap();
            let budget = error_budget(robot, &samples, BudgetOptions::default(), &mut ()).unwrap();
            let sources = budget.sources.iter().map(|source| source.plain_max.norm);
            let all = &budget.combined;
            sources.chain([all.worst_case_radius.value, all.radius.value]).collect::<Vec<f64>>()
        };
        for (a, b) in figures(&with).into_iter().zip(figures(&without)) {
            assert!((a - b).abs() <= 1e-12 * a.abs(), "{first}: {a} {b}");
        }
        // The exact pose, too, with any magnitudes.
        let home = Configuration::home(with.description());
        for seed in 0..20 {
            let q = [5.0 * halton(1 + seed, 0) - 2.5, 4.0 * halton(1 + seed, 1) - 2.0];
            let magnitudes: Vec<f64> = (0..5).map(|i| 2.0 * halton(1 + seed, 2 + i) - 1.0).collect();
            let [a, b] =
                [&with, &without].map(|robot| drawn_pose(robot, &q, &home.s, &home.u, &magnitudes).unwrap());
            for (a, b) in a.0.as_flattened().iter().zip(b.0.as_flattened()) {
                assert!((a - b).abs() <= 1e-12 * 1000.0, "{first}: {a} {b}");
            }
        }
    }
}
