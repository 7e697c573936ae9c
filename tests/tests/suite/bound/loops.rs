//! Bounds of machines with loops are never exceeded, and close where the loops cannot open.

use abbe::Manipulator;
use abbe_bound::{Bound, Effort, Moving};
use abbe_codegen::chain::Magnitudes;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;
use abbe_tests::closed_machines::{FOUR_BAR, hexapod};
use abbe_tests::mechanisms::{Mechanism, is_regular};
use abbe_tests::sample_size;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{bounded, kinds, moving, place, remainder, sizes};

/// Adds repeatable and random errors of some frames.
fn with_sources(mechanism: &Mechanism, random: &mut Xoshiro256PlusPlus) -> String {
    let mut text = mechanism.text.clone();
    for source in 0..4 {
        let frame = random.random_range(0..mechanism.frames.len());
        let class = ["repeatable", "random\"\ndistribution = \"uniform"][source % 2];
        let component = ["e_x", "e_y", "e_z", "e_s", "e_r", "e_p"][random.random_range(0..6)];
        let size: f64 = random.random_range(0.0005..0.002);
        text += &format!(
            "[[source]]\nname = \"s{source}\"\nclass = \"{class}\"\nframe = \"f{frame}\"\n{component} = {size}\n"
        );
    }
    text
}

/// Random mechanisms with one to three loops, boxes of 0.1 down to 0.001 around places near home:
/// no sample exceeds a bound to first order, and none of the exact machine that of the remainder.
#[test]
fn nothing_exceeds_what_is_certified() {
    let (mut certified, mut all) = ([0; 2], 0);
    for seed in 0..sample_size(12, 100) as u64 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mechanism = Mechanism::new(seed);
        let text = with_sources(&mechanism, &mut random);
        let spec = Spec::parse("machine.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
        let robot = Interpreter::new(spec.clone());
        if !is_regular(&robot) {
            continue;
        }
        let mut magnitudes = Magnitudes::new(&spec, &[]);
        let share = [1.0, 0.3, 0.01][random.random_range(0..3)];
        let narrow = |name: Moving| {
            let [low, high] = name.range;
            Moving { range: [low + (1.0 - share) * 0.5 * (high - low), high], ..name }
        };
        let box_: Vec<Moving> = moving(&spec).into_iter().map(narrow).collect();
        let effort = Effort { gap: 0.1, boxes: 200, ..Effort::default() };
        let places: Vec<Vec<f64>> =
            (0..sample_size(100, 1000)).map(|_| place(&box_, &mut random)).collect();
        let remainder = remainder::bounded(&spec, &box_, &Effort { gap: 0.5, ..effort });
        let seen: Vec<_> = places.iter().filter_map(|q| sizes(&robot, q, &[])).collect();
        all += 1;
        for (k, five) in kinds(&magnitudes).into_iter().enumerate() {
            for (i, magnitude) in five.into_iter().enumerate().filter(|(i, _)| [0, 4].contains(i)) {
                let bound = bounded(&spec, &mut magnitudes, &magnitude, &box_, &effort);
                certified[0] += usize::from(bound.certified.is_finite());
                let most = seen.iter().map(|sizes| sizes[k][i]).fold(0.0, f64::max);
                assert!(
                    most <= bound.certified * (1.0 + 1e-9) + 1e-15,
                    "machine {seed}, {k} {i}: {most:e} above {bound:?}\n{text}"
                );
                assert!(bound.found <= bound.certified);
                assert!(!bound.complete || bound.certified <= 1.1 * bound.found + 1e-9, "{bound:?}");
                if let Some(there) = sizes(&robot, &bound.at, &[]) {
                    assert!(bound.found <= there[k][i] * (1.0 + 1e-9) + 1e-15, "machine {seed}, {k} {i}");
                }
            }
        }
        certified[1] += usize::from(remainder.certified.is_finite());
        for q in &places {
            if let Some([difference, rounding]) = remainder::difference(&robot, q, &[]) {
                assert!(
                    difference <= remainder.certified + 10.0 * rounding,
                    "machine {seed}: {difference:e} above {remainder:?}\n{text}"
                );
            }
        }
    }
    assert!(10 * certified[0] > 9 * 6 * all && 10 * certified[1] > 9 * all, "of {all}: {certified:?}");
}
