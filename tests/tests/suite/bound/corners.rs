//! Constant errors are affine in sine and cosine of each joint, and deflections under weights are
//! quadratic: the bound certified at control points is never exceeded, and close.

use std::fmt::Write;
use std::ops::RangeInclusive;

use abbe_bound::Effort;
use abbe_codegen::chain::Magnitudes;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use abbe_tests::thorough;

use super::{ROUNDING, bounded, given, kinds, moving, part, place, sizes};

/// Returns a chain without sources. Angles have offsets and signs, axes are parallel or not, and
/// one joint in five is prismatic.
fn joints(frames: usize, random: &mut Xoshiro256PlusPlus) -> String {
    let mut text = "[manipulator]\nname = \"chain\"\nlength = \"m\"\n".to_owned();
    for name in 1..=frames {
        let slides = random.random_bool(0.2);
        let (kind, limits) = match slides {
            true => ("prismatic", "[\"-0.2 m\", \"0.5 m\"]"),
            false => ("revolute", "[\"-150 deg\", \"150 deg\"]"),
        };
        let unit = if slides { "m" } else { "rad" };
        let place = match random.random_range(0..3) {
            0 => format!("q{name}"),
            1 => format!("q{name} + 0.3 {unit}"),
            _ => format!("0.2 {unit} - q{name}"),
        };
        let (theta, d) = if slides { ("0.4".to_owned(), place) } else { (place, "0.1".to_owned()) };
        let twist = [0.0, 0.5, -1.2][random.random_range(0..3)];
        let _ = write!(
            text,
            "[[frame]]\nname = \"{name}\"\nvariable = {{ name = \"q{name}\", kind = \"{kind}\", limits = {limits} }}\n\
             dh = {{ theta = \"{theta}\", d = \"{d}\", a = 0.3, alpha = {twist} }}\n"
        );
    }
    text
}

/// Returns a chain with all six errors of every frame, of both classes.
fn chain(frames: usize, random: &mut Xoshiro256PlusPlus) -> String {
    let mut text = joints(frames, random);
    for frame in 1..=frames {
        for (class, kind) in [("repeatable", ""), ("random", "distribution = \"uniform\"\n")] {
            let _ = write!(
                text,
                "[[source]]\nname = \"{class} {frame}\"\nclass = \"{class}\"\n{kind}frame = \"{frame}\"\n"
            );
            for error in ["e_x", "e_y", "e_z", "e_s", "e_r", "e_p"] {
                let low = if kind.is_empty() { -1e-4 } else { 1e-6 };
                let _ = writeln!(text, "{error} = \"{:e}\"", random.random_range(low..1e-4));
            }
        }
    }
    text
}

/// Returns a chain whose frames give way under weights, a force that keeps its direction, and a
/// moment that turns with its frame.
fn elastic_chain(frames: usize, random: &mut Xoshiro256PlusPlus) -> String {
    let mut text = joints(frames, random).replacen(
        "length = \"m\"\n",
        "length = \"m\"\ngravity = [0, \"1 m/s^2\", \"-9.81 m/s^2\"]\n\
         [inputs]\npayload = { value = \"2 kg\", range = [\"0 kg\", \"5 kg\"] }\n",
        1,
    );
    let _ = write!(
        text,
        "[[load]]\nmass = \"payload\"\nframe = \"{frames}\"\npoint = [0.1, -0.05, 0.2]\n\
         [[load]]\nmass = \"6 kg\"\nframe = \"1\"\npoint = [-0.1, 0, 0.1]\n\
         [[load]]\nforce = [\"20 N\", 0, 0]\naxes = \"base\"\nframe = \"{frames}\"\n\
         [[load]]\nmoment = [0, \"2 N*m\", \"1 N*m\"]\naxes = \"frame\"\nframe = \"{frames}\"\n"
    );
    for frame in 1..=frames {
        let (class, kind) = match random.random_bool(0.7) {
            true => ("repeatable", ""),
            false => ("random", "distribution = \"uniform\"\n"),
        };
        let _ = write!(
            text,
            "[[source]]\nname = \"gear {frame}\"\nclass = \"{class}\"\n{kind}frame = \"{frame}\"\n\
             compliance = {{ diagonal = [\"1e-8 m/N\", 0, 0, \"{:e} /(N*m)\", \"{:e} /(N*m)\", 0] }}\n",
            random.random_range(1e-7..1e-6),
            random.random_range(1e-6..1e-5),
        );
    }
    text
}

#[test]
fn nothing_exceeds_the_control_points_of_constant_errors() {
    nothing_exceeds(chain, 2..=if thorough() { 6 } else { 4 }, 4000);
}

#[test]
fn nothing_exceeds_the_control_points_of_deflections() {
    nothing_exceeds(elastic_chain, 2..=if thorough() { 4 } else { 3 }, 2000);
}

fn nothing_exceeds(
    chain: fn(usize, &mut Xoshiro256PlusPlus) -> String,
    frames: RangeInclusive<usize>,
    boxes: usize,
) {
    let (mut complete, mut all_bounds) = (0, 0);
    for frames in frames {
        for seed in 0..given("ABBE_BOXES", 3) {
            let mut random = Xoshiro256PlusPlus::seed_from_u64((100 * frames + seed) as u64);
            let text = chain(frames, &mut random);
            let spec =
                Spec::parse("chain.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
            let (robot, all) = (Interpreter::new(spec.clone()), moving(&spec));
            let box_ = part(&all, &mut random);
            let mut magnitudes = Magnitudes::new(&spec, &[]);
            let kinds = kinds(&magnitudes);
            let effort = Effort { boxes, ..Effort::default() };
            let bounds =
                kinds.map(|five| five.map(|one| bounded(&spec, &mut magnitudes, &one, &box_, &effort)));
            all_bounds += bounds.as_flattened().len();
            complete += bounds.as_flattened().iter().filter(|bound| bound.complete).count();
            for _ in 0..given("ABBE_SAMPLES", 200) {
                let place = place(&box_, &mut random);
                let (q, u) = place.split_at(spec.variables.len());
                let Some(sizes) = sizes(&robot, q, u) else { continue };
                for (bounds, sizes) in bounds.iter().zip(sizes) {
                    for (bound, size) in bounds.iter().zip(sizes) {
                        assert!(
                            size <= bound.certified * (1.0 + ROUNDING),
                            "{size} {bound:?}\n{box_:?}\n{text}"
                        );
                    }
                }
            }
        }
    }
    println!("{complete} of {all_bounds} known to 1 %");
    assert!(10 * complete >= 9 * all_bounds, "{complete} of {all_bounds}");
}
