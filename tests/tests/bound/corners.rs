//! Errors that do not depend on the joints are convex in the sine and cosine of each: what is certified at vertices is never exceeded, and close.

use std::fmt::Write;

use abbe_codegen::chain::Magnitudes;
use abbe_codegen::spec::Spec;
use abbe_interpreter::Interpreter;
use abbe_interpreter::bound::Effort;
use abbe_tests::chains::revolute_chain;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{ROUNDING, bounded, given, moving, part, place, sizes};

/// A chain with all six errors of every frame, of both classes.
fn chain(frames: usize, random: &mut Xoshiro256PlusPlus) -> String {
    let mut text = revolute_chain(frames);
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

#[test]
fn nothing_exceeds_the_vertices() {
    let mut complete = 0;
    let all_boxes = given("ABBE_BOXES", 3);
    for frames in 2..=6 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(frames as u64);
        let spec = Spec::parse("chain.toml", &chain(frames, &mut random)).unwrap();
        let (robot, all) = (Interpreter::new(spec.clone()), moving(&spec));
        for _ in 0..all_boxes {
            let box_ = part(&all, &mut random);
            let mut magnitudes = Magnitudes::new(&spec);
            let kinds = [magnitudes.repeatable, magnitudes.random, magnitudes.radius];
            let effort = Effort { boxes: 3000, ..Effort::default() };
            let mut certified =
                |kind: usize, row: usize| bounded(&spec, &mut magnitudes, kinds[kind][row], &box_, &effort);
            let bounds: Vec<_> = (0..3).map(|kind| [0, 1, 2, 3].map(|row| certified(kind, row))).collect();
            complete += usize::from(bounds[0][0].complete) + usize::from(bounds[1][0].complete);
            for _ in 0..given("ABBE_SAMPLES", 200) {
                let place = place(&box_, &mut random);
                let Some(sizes) = sizes(&robot, &place, &[]) else { continue };
                for (bounds, sizes) in bounds.iter().zip(sizes) {
                    for (bound, size) in bounds.iter().zip(sizes) {
                        assert!(size <= bound.certified * (1.0 + ROUNDING), "{frames}: {size} {bound:?}");
                    }
                }
            }
        }
    }
    assert!(complete >= 8 * all_boxes, "{complete} of {}", 10 * all_boxes);
}
