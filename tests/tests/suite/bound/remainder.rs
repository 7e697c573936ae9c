//! The difference of first order and exact chain never exceeds its certified bound.

use abbe::{Class, Manipulator, deviation, drawn_pose};
use abbe_bound::{Bound, Effort, Moving, largest};
use abbe_codegen::chain::Remainder;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{given, home, moving, part, place, robot, robots};

pub(super) fn bounded(spec: &Spec, box_: &[Moving], effort: &Effort) -> Bound {
    let Some(remainder) = Remainder::new(spec, &[]) else {
        let (at, certified) = (Vec::new(), f64::INFINITY);
        return Bound { found: 0.0, certified, at, boxes: 0, complete: false, unbounded: None };
    };
    let Remainder { mut graph, magnitude, share, implicit } = remainder;
    let share = Moving { symbol: share, range: [0.0, 1.0], home: 0.0, start: 0.0 };
    let moving = [box_, &[share]].concat();
    largest(&mut graph, &magnitude, &implicit, &moving, &|symbol| home(symbol, spec), effort, &mut |_| true)
}

/// Returns the distance of the tool point of the exact chain from that of `J_e ε` of the repeatable
/// sources, and a bound of its rounding error.
pub(super) fn difference(robot: &Interpreter, q: &[f64], u: &[f64]) -> Option<[f64; 2]> {
    let description = robot.description();
    let magnitudes = description.sources.iter().map(|source| match source.class {
        Class::Repeatable => 1.0,
        Class::Tolerance(_) | Class::Random(_) => 0.0,
    });
    let magnitudes: Vec<f64> = magnitudes.collect();
    let nominal = robot.pose(q, &[]).ok()?;
    let exact = drawn_pose(robot, q, &[], u, &magnitudes).ok()?;
    let exact = deviation(description.orientation, &nominal, &exact);
    let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
    robot.error_jacobian(q, &[], &mut columns).ok()?;
    let mut effects = vec![0.0; description.effects.len()];
    robot.effects(q, &[], u, &mut effects).ok()?;
    let mut first = [0.0; 3];
    for (effect, value) in description.effects.iter().zip(&effects) {
        let column = &columns[6 * effect.frame + effect.component.index()];
        let magnitude = magnitudes[effect.source];
        (0..3).for_each(|i| first[i] += magnitude * value * column[i]);
    }
    let norm = (0..3).map(|i| (exact[i] - first[i]).powi(2)).sum::<f64>().sqrt();
    let reach = columns.iter().flatten().fold(1.0, |most: f64, entry| most.max(entry.abs()));
    Some([norm, 1e-14 * reach])
}

#[test]
fn nothing_exceeds_what_is_certified() {
    let mut certified = 0;
    for seed in robots() {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let text = robot::spec(&mut random);
        let spec = Spec::parse("robot.toml", &text).unwrap();
        let robot = Interpreter::new(spec.clone());
        let all = moving(&spec);
        for boxes in [1, 200] {
            let box_ = if boxes == 1 { part(&all, &mut random) } else { all.clone() };
            let bound = bounded(&spec, &box_, &Effort { gap: 0.5, boxes, ..Effort::default() });
            certified += usize::from(bound.certified.is_finite());
            for _ in 0..given("ABBE_SAMPLES", 60) {
                let place = place(&box_, &mut random);
                let (q, u) = place.split_at(spec.variables.len());
                if let Some([difference, rounding]) = difference(&robot, q, u) {
                    assert!(
                        difference <= bound.certified + rounding,
                        "robot {seed}: {difference:e} above {bound:?}\n{text}"
                    );
                }
            }
        }
    }
    let boxes = 2 * robots().count();
    assert!(6 * certified > 5 * boxes, "of {boxes} boxes {certified} are certified");
}

/// Checks a bar whose joint has the error φ: the tip moves on an arc, and the certified bound is
/// the first term of the remainder, `l φ²/2`. The remainder itself is
/// `l √((1 − cos φ)² + (φ − sin φ)²)`.
#[test]
fn an_arc_is_left_out() {
    for error in ["joint = \"q1\"\nerror = \"10 mrad\"", "frame = \"bar\"\ne_r = \"10 mrad\""] {
        let text = format!(
            "[manipulator]\nname = \"bar\"\nlength = \"mm\"\n[[frame]]\nname = \"bar\"\n\
             variable = {{ name = \"q1\", kind = \"revolute\", limits = [\"-90 deg\", \"90 deg\"] }}\ntransform = \"Rz(q1)\"\n\
             [tool]\ntransform = \"Tx(400)\"\n[[source]]\nname = \"off\"\nclass = \"repeatable\"\n{error}\n"
        );
        let spec = Spec::parse("bar.toml", &text).unwrap();
        let bound = bounded(&spec, &moving(&spec), &Effort { gap: 1e-3, ..Effort::default() });
        let [certified, exact] = [0.02, 400.0 * (1.0 - 0.01_f64.cos()).hypot(0.01 - 0.01_f64.sin())];
        assert!(exact <= bound.certified, "{exact} {bound:?}");
        assert!((bound.certified - certified).abs() <= 1e-3 * certified, "{certified} {bound:?}");
        let [sampled, _] = difference(&Interpreter::new(spec), &[0.3], &[]).unwrap();
        assert!((sampled - exact).abs() < 1e-12, "{sampled} {exact}");
    }
}

/// Checks that translations alone have no remainder.
#[test]
fn of_translations_nothing_is_left_out() {
    let text = "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n[[frame]]\nname = \"slide\"\n\
                variable = { name = \"x\", kind = \"prismatic\", limits = [0, 100] }\ntransform = \"Tx(x)\"\n\
                [[source]]\nname = \"scale\"\nclass = \"repeatable\"\nframe = \"slide\"\ne_x = \"1e-4 * x\"\ne_y = \"0.1\"\n";
    let spec = Spec::parse("slide.toml", text).unwrap();
    assert_eq!(bounded(&spec, &moving(&spec), &Effort::default()).certified, 0.0);
}

/// A number with an error that may cross a corner of the transform has no second derivative there:
/// the remainder, as large as the change of the slope times the error, is not bounded.
#[test]
fn nothing_is_certified_across_a_corner() {
    for (height, is_known) in [("0.1 * abs(q + shift)", false), ("0.1 * (q + shift)", true)] {
        let text = format!(
            "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n[parameters]\nshift = \"0 mm\"\n\
             [[frame]]\nname = \"slide\"\ntransform = \"Tx(q) Tz({height})\"\n\
             variable = {{ name = \"q\", kind = \"prismatic\", limits = [\"-9 mm\", \"9 mm\"] }}\n\
             [[source]]\nname = \"shift\"\nclass = \"repeatable\"\nparameter = \"shift\"\nerror = \"0.1 mm\"\n"
        );
        let spec = Spec::parse("slide.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let bound = bounded(&spec, &moving(&spec), &Effort::default());
        assert_eq!(bound.certified.is_finite(), is_known, "{height}: {bound:?}");
    }
}
