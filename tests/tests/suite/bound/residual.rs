//! The error after one step of compensation never exceeds its certified bound.

use abbe::analysis::{Goal, compensated, sampling};
use abbe::compensator::norms;
use abbe::{Class, Manipulator, Orientation, VariableKind, deviation, drawn_pose};
use abbe_bound::{Bound, Effort, Moving, largest};
use abbe_codegen::chain::{CompensationResidual, Magnitude};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{given, home, moving, part, place, robot, robots};

/// Returns the bounds of ½ ‖p″‖ and ½ ‖ω′‖ over a box.
fn bounded(spec: &Spec, box_: &[Moving], effort: &Effort) -> Option<[Bound; 2]> {
    let CompensationResidual { mut graph, point, turn, share } = CompensationResidual::new(spec)?;
    let share = Moving { symbol: share, range: [0.0, 1.0], home: 0.0, start: 0.0 };
    let moving = [box_, &[share]].concat();
    let mut of = |magnitude: &Magnitude| {
        largest(&mut graph, magnitude, &[], &moving, &|symbol| home(symbol, spec), effort, &mut |_| true)
    };
    let none = Bound {
        found: 0.0,
        certified: f64::INFINITY,
        at: Vec::new(),
        boxes: 0,
        complete: false,
        unbounded: None,
    };
    Some([of(&point), turn.as_ref().map_or(none, of)])
}

/// Returns the errors of the exact chain after one step of an independent solver.
fn left(robot: &Interpreter, q: &[f64], u: &[f64]) -> Option<[f64; 2]> {
    let description = robot.description();
    let repeatable = description.sources.iter().map(|source| match source.class {
        Class::Repeatable => 1.0,
        Class::Tolerance(_) | Class::Random(_) => 0.0,
    });
    let repeatable: Vec<f64> = repeatable.collect();
    let metre = 1.0 / description.length.in_metres();
    let target = robot.pose(q, &[]).ok()?;
    let small: Vec<f64> = repeatable.iter().map(|magnitude| 1e-4 * magnitude).collect();
    let minus: Vec<f64> = small.iter().map(|magnitude| -magnitude).collect();
    let rows = |d: [f64; 6]| if q.len() < 6 { d[..3].to_vec() } else { d.to_vec() };
    let off = |magnitudes: &[f64], q: &[f64]| {
        let real = drawn_pose(robot, q, &[], u, magnitudes).ok()?;
        Some(deviation(Orientation::RotationVector, &target, &real))
    };
    // Central differences by the size of the errors, and along the joints.
    let (plus, less) = (off(&small, q)?, off(&minus, q)?);
    let error: Vec<f64> = rows(std::array::from_fn(|i| (plus[i] - less[i]) / 2e-4));
    let none = vec![0.0; repeatable.len()];
    let units: Vec<f64> = description
        .variables
        .iter()
        .map(|variable| if variable.kind == VariableKind::Revolute { 1.0 } else { metre })
        .collect();
    let mut jacobian = DMatrix::zeros(error.len(), q.len());
    for (j, unit) in units.iter().enumerate() {
        let moved = |step: f64| {
            let mut moved = q.to_vec();
            moved[j] += step * unit;
            off(&none, &moved)
        };
        let (plus, less) = (moved(1e-5)?, moved(-1e-5)?);
        let column = rows(std::array::from_fn(|i| (plus[i] - less[i]) / 2e-5));
        jacobian.set_column(j, &DVector::from_vec(column));
    }
    let svd = jacobian.svd(true, true);
    if svd.singular_values.min() < 1e-3 * svd.singular_values.max() {
        return None;
    }
    let step = svd.solve(&DVector::from_vec(error), 0.0).ok()?;
    let corrected: Vec<f64> =
        q.iter().zip(&units).zip(step.iter()).map(|((q, unit), d)| q - d * unit).collect();
    let left = off(&repeatable, &corrected)?;
    let norm = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>().sqrt();
    Some([norm(&left[..3]), norm(&left[3..])])
}

#[test]
fn nothing_exceeds_what_is_certified() {
    let (mut certified, mut looked) = (0, 0);
    for seed in robots() {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let text = robot::spec(&mut random);
        let spec = Spec::parse("robot.toml", &text).unwrap();
        let robot = Interpreter::new(spec.clone());
        let all = moving(&spec);
        for _ in 0..given("ABBE_BOXES", 2) {
            let mut box_ = part(&all, &mut random);
            for name in &mut box_ {
                // Wide boxes contain singular configurations.
                name.range[1] = name.range[1].min(name.range[0] + 0.3);
            }
            let Some(bounds) = bounded(&spec, &box_, &Effort { gap: 0.5, boxes: 60, ..Effort::default() })
            else {
                continue;
            };
            certified += usize::from(bounds[0].certified.is_finite());
            for _ in 0..given("ABBE_SAMPLES", 20) {
                let place = place(&box_, &mut random);
                let (q, u) = place.split_at(spec.variables.len());
                let Some(left) = left(&robot, q, u) else { continue };
                looked += 1;
                for (left, bound) in left.into_iter().zip(&bounds) {
                    assert!(
                        left <= bound.certified + 1e-11,
                        "robot {seed}: {left:e} above {bound:?}\n{box_:?}\n{text}"
                    );
                }
            }
        }
    }
    let least = robots().count();
    assert!(
        6 * certified > 5 * least && looked > 16 * least,
        "{certified} boxes are certified, {looked} places looked at"
    );
}

/// Checks a slide that rotates everything it carries by φ. With y the distance of the tool, the
/// first-order displacement is `φ y` and the certified bound is `½ φ² y`; the remaining error is
/// `y √((φ − sin φ)² + (1 − cos φ)²)`.
#[test]
fn what_a_turned_slide_leaves_is_known() {
    let slide = |axis: &str, limits: &str| {
        format!(
            "[[frame]]\nname = \"{axis}\"\nvariable = {{ name = \"{axis}\", kind = \"prismatic\", limits = {limits} }}\n\
             transform = \"T{axis}({axis})\"\n"
        )
    };
    let text = format!(
        "[manipulator]\nname = \"slides\"\nlength = \"mm\"\n{}{}{}[[source]]\nname = \"turned\"\nclass = \"repeatable\"\n\
         frame = \"x\"\ne_r = \"10 mrad\"\n",
        slide("x", "[0, 600]"),
        slide("y", "[0, 400]"),
        slide("z", "[0, 200]")
    );
    let spec = Spec::parse("slides.toml", &text).unwrap();
    let [bound, _] = bounded(&spec, &moving(&spec), &Effort { gap: 1e-3, ..Effort::default() }).unwrap();
    let [certified, exact] = [0.02, 400.0 * (0.01 - 0.01_f64.sin()).hypot(1.0 - 0.01_f64.cos())];
    assert!(
        exact <= bound.certified && (bound.certified - certified).abs() <= 1e-3 * certified,
        "{exact} {bound:?}"
    );
    let [sampled, _] = left(&Interpreter::new(spec), &[300.0, 400.0, 0.0], &[]).unwrap();
    assert!((sampled - exact).abs() < 1e-9, "{sampled} {exact}");
}

/// Checks that the compensator, with more steps, leaves no larger error of the paper's positioner
/// than the bound for one step.
#[test]
fn the_compensator_leaves_no_more() {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap();
    let spec = Spec::parse("pps.toml", shipped.spec).unwrap();
    let (robot, all) = (Interpreter::new(spec.clone()), moving(&spec));
    let (s, u) =
        (sampling::nominal_parameters(robot.description()), sampling::nominal_inputs(robot.description()));
    let joints: Vec<Moving> = all[..spec.variables.len()].to_vec();
    let [point, turn] = bounded(&spec, &joints, &Effort { gap: 0.5, ..Effort::default() }).unwrap();
    assert!(point.complete && turn.complete, "{point:?} {turn:?}");
    let mut random = Xoshiro256PlusPlus::seed_from_u64(15);
    let (mut before, mut looked) = (0.0_f64, 0);
    for _ in 0..300 {
        let found = compensated(&robot, Goal::default(), &place(&joints, &mut random), &s, &u).unwrap();
        let is_held = robot
            .description()
            .variables
            .iter()
            .zip(&found.q)
            .any(|(variable, q)| variable.limits.contains(q));
        if !is_held {
            let (length, angle) = norms(&found.after);
            assert!(length <= point.certified && angle <= turn.certified, "{found:?}");
            before = before.max(norms(&found.before).0);
            looked += 1;
        }
    }
    assert!(looked > 50 && before > 100.0 * point.certified, "{looked}, {before} {point:?}");
}
