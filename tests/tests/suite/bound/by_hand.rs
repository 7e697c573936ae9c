//! Worst cases with closed-form solutions are enclosed.

use abbe_bound::{Bound, Effort};
use abbe_codegen::chain::{Magnitude, Magnitudes};
use abbe_spec::Spec;

use super::{bounded, kinds, moving};

/// Returns two bars in a plane with an error at each joint: `ΔX = e_1 (l_1 + l_2)` when stretched;
/// otherwise the maximum depends on the box.
pub(super) fn two_bars(limits: &str) -> Spec {
    let text = format!(
        r#"
        [manipulator]
        name = "bars"
        length = "mm"
        [[frame]]
        name = "shoulder"
        variable = {{ name = "q1", kind = "revolute", limits = ["-180 deg", "180 deg"] }}
        transform = "Rz(q1)"
        [[frame]]
        name = "elbow"
        variable = {{ name = "q2", kind = "revolute", limits = {limits}, home = "90 deg" }}
        transform = "Tx(400) Rz(q2)"
        [tool]
        transform = "Tx(300)"
        [[source]]
        name = "shoulder"
        class = "repeatable"
        joint = "q1"
        error = "1 mrad"
        [[source]]
        name = "elbow"
        class = "random"
        distribution = "uniform"
        joint = "q2"
        error = "2 mrad"
        "#
    );
    Spec::parse("bars.toml", &text).unwrap()
}

pub(super) fn is(bound: &Bound, exact: f64) {
    assert!(bound.complete, "{bound:?}");
    assert!(
        bound.found <= exact * (1.0 + 1e-15) && bound.certified >= exact * (1.0 - 1e-15),
        "{exact}: {bound:?}"
    );
    assert!(
        bound.certified <= exact * (1.0 + 1e-6) && bound.found >= exact * (1.0 - 1e-6),
        "{exact}: {bound:?}"
    );
}

/// Returns one joint with a tool 1 m from its axis, and random errors: angles of the joint in mrad,
/// and lengths along the arm (x) and along the axis (z) in mm.
fn one_joint(angles: &[f64], [x, z]: [f64; 2]) -> Spec {
    let mut text = String::from(
        "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[[frame]]\nname = \"a\"\n\
         variable = { name = \"q1\", kind = \"revolute\", limits = [\"-90 deg\", \"90 deg\"] }\n\
         transform = \"Rz(q1)\"\n[tool]\ntransform = \"Tx(1000)\"\n",
    );
    let angles = angles.iter().map(|angle| format!("joint = \"q1\"\nerror = \"{angle} mrad\""));
    let lengths = [("e_x", x), ("e_z", z)].into_iter().filter(|(_, length)| *length != 0.0);
    let lengths = lengths.map(|(error, length)| format!("frame = \"a\"\n{error} = \"{length} mm\""));
    for (i, source) in angles.chain(lengths).enumerate() {
        text += &format!(
            "[[source]]\nname = \"s{i}\"\nclass = \"random\"\ndistribution = \"uniform\"\n\
             {source}\n"
        );
    }
    Spec::parse("arm.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"))
}

/// Errors of two encoders of one joint may have the same sign: their worst case is the sum, not the
/// root sum of squares. Perpendicular errors add as a right angle.
#[test]
fn worst_cases_by_hand_are_enclosed() {
    let effort = Effort { gap: 1e-7, boxes: 200_000, ..Effort::default() };
    let cases = [
        (one_joint(&[0.1, 0.1], [0.0; 2]), 0.2),
        (one_joint(&[0.1, 0.2, 0.3], [0.0; 2]), 0.6),
        (one_joint(&[0.3], [0.4, 0.0]), 0.5),
        (one_joint(&[0.1, 0.2], [0.4, 1.2]), 1.3),
    ];
    for (spec, exact) in cases {
        let mut magnitudes = Magnitudes::new(&spec, &[]);
        let total = magnitudes.total[0].clone();
        is(&bounded(&spec, &mut magnitudes, &total, &moving(&spec), &effort), exact);
    }
}

#[test]
fn maxima_that_are_known_exactly_are_enclosed() {
    let effort = Effort { gap: 1e-7, boxes: 200_000, ..Effort::default() };
    // ‖ΔX‖ = e √(l₁² + l₂² + 2 l₁ l₂ cos q₂): stretched 700 mm, at 60° and beyond √(400² + 300² +
    // 400·300) mm.
    for (limits, reach) in
        [("[\"-150 deg\", \"150 deg\"]", 700.0), ("[\"60 deg\", \"150 deg\"]", 370_000.0_f64.sqrt())]
    {
        let along = 300.0 + (reach * reach - 250_000.0) / 600.0;
        let spec = two_bars(limits);
        let all = moving(&spec);
        let mut magnitudes = Magnitudes::new(&spec, &[]);
        let [repeatable, random, total] = kinds(&magnitudes);
        let across_z = magnitudes.across_z.clone();
        let mut bounded = |magnitude: &Magnitude| bounded(&spec, &mut magnitudes, magnitude, &all, &effort);
        is(&bounded(&repeatable[0]), 1e-3 * reach);
        is(&bounded(&random[0]), 2e-3 * 300.0);
        // The forearm, which has the random error, is turned by q₂ from the reach.
        let both = (1e-6 * reach * reach + 0.36 + 1.2e-3 * along).sqrt();
        is(&bounded(&total[0]), both);
        is(&bounded(&repeatable[4]), 1e-3);
        // The first joint can turn the maximum into x or y of F_0.
        is(&bounded(&repeatable[1]), 1e-3 * reach);
        is(&bounded(&random[2]), 0.6);
        is(&bounded(&across_z[0]), 1e-3 * reach);
        is(&bounded(&across_z[1]), 0.6);
        is(&bounded(&across_z[2]), both);
        assert!(bounded(&repeatable[3]).certified < 1e-150);
    }
}
