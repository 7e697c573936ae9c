//! Bounds of machines with loops are never exceeded, and close where the loops cannot open.

use std::fmt::Write;

use abbe::Manipulator;
use abbe::analysis::sampling::nominal_parameters;
use abbe_bound::{Effort, Moving};
use abbe_codegen::chain::{LoopEquations, Magnitudes};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;
use abbe_tests::closed_machines::{FOUR_BAR, hexapod};
use abbe_tests::mechanisms::{Mechanism, is_regular};
use abbe_tests::{sample_size, thorough};
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
    for seed in 0..sample_size(120) as u64 {
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
        let mut box_: Vec<Moving> = moving(&spec).into_iter().map(narrow).collect();
        if seed % 3 == 0 {
            // It stands still, but not at home.
            box_[0].range[0] = box_[0].range[1];
        }
        let effort = Effort { gap: 0.1, boxes: 200, ..Effort::default() };
        let places: Vec<Vec<f64>> = (0..sample_size(1000)).map(|_| place(&box_, &mut random)).collect();
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
    assert!(certified[0] == 6 * all && 5 * certified[1] > 4 * all, "of {all}: {certified:?}");
}

/// A planar platform on three legs: its variables are x, y and the angle.
fn planar_platform() -> String {
    let mut text = "[manipulator]\nname = \"planar\"\nlength = \"mm\"\n".to_owned();
    for (name, kind, motion) in
        [("x", "prismatic", "Tx(x)"), ("y", "prismatic", "Ty(y)"), ("phi", "revolute", "Rz(phi)")]
    {
        let _ = write!(
            text,
            "[[frame]]\nname = \"{name}\"\ntransform = \"{motion}\"\n\
             variable = {{ name = \"{name}\", kind = \"{kind}\", passive = true }}\n"
        );
    }
    for leg in 0..3 {
        let angle = 90 + 120 * leg;
        let _ = write!(
            text,
            "[[frame]]\nname = \"b{leg}\"\nparent = \"base\"\ntransform = \"Rz({angle} deg) Tx(300)\"\n\
             [[frame]]\nname = \"j{leg}\"\nparent = \"phi\"\ntransform = \"Rz({} deg) Tx(80)\"\n\
             [[loop]]\nname = \"leg {leg}\"\nframes = [\"j{leg}\", \"b{leg}\"]\ncloses = \"distance\"\n\
             length = \"244 mm + q{leg}\"\nvariable = {{ name = \"q{leg}\", kind = \"prismatic\" }}\n\
             [[source]]\nname = \"length {leg}\"\nclass = \"repeatable\"\njoint = \"q{leg}\"\nerror = 0.0{}\n\
             [[source]]\nname = \"bearing {leg}\"\nclass = \"random\"\ndistribution = \"uniform\"\n\
             frame = \"j{leg}\"\ne_x = 0.01\n",
            angle + 40,
            leg + 2,
        );
    }
    text + "[tool]\nframe = \"phi\"\ntransform = \"Tx(20)\"\n"
}

/// Bounds the position error of a machine to 10 % over a box of half widths around home, of its
/// joint variables, or of its passive ones where it is a platform. Neither samples nor searches for
/// larger errors exceed it. An ordinary run takes a tenth of the box.
fn is_bounded_closely(text: &str, is_platform: bool, halves: &[f64]) {
    let spec = Spec::parse("machine.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let robot = Interpreter::new(spec.clone());
    let home: Vec<f64> = spec.variables.iter().map(|variable| variable.home).collect();
    let mut passive = vec![0.0; spec.passive.len()];
    let s = nominal_parameters(robot.description());
    robot.passive(&home, &s, &mut passive).unwrap();
    let given: Vec<usize> = if is_platform { (0..passive.len()).collect() } else { Vec::new() };
    let share = if thorough() { 1.0 } else { 0.1 };
    let name = |(i, half): (usize, &f64)| {
        let (symbol, home) = match is_platform {
            true => (Symbol::Local(i), passive[i]),
            false => (Symbol::Variable(i), home[i]),
        };
        Moving { symbol, range: [home - share * half, home + share * half], home, start: home }
    };
    let box_: Vec<Moving> = halves.iter().enumerate().map(name).collect();
    let mut magnitudes = Magnitudes::new(&spec, &given);
    let effort = Effort { gap: 0.1, ..Effort::default() };
    let norm = magnitudes.total[0].clone();
    let bound = bounded(&spec, &mut magnitudes, &norm, &box_, &effort);
    assert!(bound.complete && bound.certified <= 1.1 * bound.found, "{bound:?}");

    let equations = LoopEquations::new(&spec);
    let error_at = |place: &[f64]| {
        let lengths = || equations.residual_at(&home, place, &s);
        let q: Vec<f64> = match is_platform {
            true => home.iter().zip(lengths()).map(|(home, more)| home + more).collect(),
            false => place.to_vec(),
        };
        sizes(&robot, &q, &[]).map_or(0.0, |sizes| sizes[2][0])
    };
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    let mut most: f64 = 0.0;
    for _ in 0..sample_size(sample_size(100_000)) {
        most = most.max(error_at(&place(&box_, &mut random)));
    }
    for _ in 0..sample_size(200) {
        let mut at = place(&box_, &mut random);
        let mut best = error_at(&at);
        for step in [0.5, 0.2, 0.05] {
            for (i, Moving { range: [low, high], .. }) in box_.iter().enumerate() {
                for side in [-1.0, 1.0] {
                    let mut next = at.clone();
                    next[i] = (next[i] + side * step * (high - low)).clamp(*low, *high);
                    let error = error_at(&next);
                    if error > best {
                        (best, at) = (error, next);
                    }
                }
            }
        }
        most = most.max(best);
    }
    assert!(most <= bound.certified * (1.0 + 1e-9), "{most:e} above {bound:?}");
    assert!(bound.found <= 1.1 * most, "{most:e} below {bound:?}");
}

#[test]
fn four_bar_is_bounded_over_a_sixth_of_a_turn() {
    is_bounded_closely(FOUR_BAR, false, &[30.0_f64.to_radians()]);
}

#[test]
fn planar_platform_is_bounded_over_poses() {
    is_bounded_closely(&planar_platform(), true, &[10.0, 10.0, 3.0_f64.to_radians()]);
}

#[test]
fn delta_is_bounded_over_its_arms() {
    let delta = include_str!("../../../../manipulators/mechanisms/delta.toml");
    is_bounded_closely(delta, false, &[10.0_f64.to_radians(); 3]);
}

#[test]
fn hexapod_is_bounded_over_poses() {
    let errors = std::array::from_fn(|leg| [0.02, 0.01 * leg as f64, -0.01, 0.02, 0.01, 0.0, 0.015]);
    let turn = 3.0_f64.to_radians();
    is_bounded_closely(&hexapod(&errors, ""), true, &[10.0, 10.0, 10.0, turn, turn, turn]);
}

/// A crank that jumps by 0.04 rad at 70°: no box with the jump is certified, others are.
#[test]
fn nothing_is_certified_across_a_jump() {
    let text = FOUR_BAR.replace("Rz(q1) Tx(40)", "Rz(q1 + 0.02 rad * sign(q1 - 70 deg)) Tx(40)");
    let spec = Spec::parse("machine.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut magnitudes = Magnitudes::new(&spec, &[]);
    let norm = magnitudes.repeatable[0].clone();
    let home = spec.variables[0].home;
    for (range, is_bounded) in [([61.0_f64, 69.0], true), ([65.0, 78.0], false)] {
        let range = range.map(f64::to_radians);
        let box_ = [Moving { symbol: Symbol::Variable(0), range, home, start: home }];
        let effort = Effort { gap: 0.1, boxes: 500, ..Effort::default() };
        let bound = bounded(&spec, &mut magnitudes, &norm, &box_, &effort);
        assert_eq!(bound.certified.is_finite(), is_bounded, "{bound:?}");
    }
}

/// A four-bar linkage that is too short for a part of the turn of its crank: nothing is certified
/// over a box with that part, and it is named; beside it, the bound is as close as elsewhere.
#[test]
fn nothing_is_certified_where_a_loop_opens() {
    let text = FOUR_BAR.replace("Rz(p1) Tx(120)", "Rz(p1) Tx(50)");
    let spec = Spec::parse("machine.toml", &text).unwrap();
    let mut magnitudes = Magnitudes::new(&spec, &[]);
    let norm = magnitudes.repeatable[0].clone();
    let mut over = |range: [f64; 2]| {
        let range = range.map(f64::to_radians);
        let home = spec.variables[0].home;
        let box_ = [Moving { symbol: Symbol::Variable(0), range, home, start: home }];
        let effort = Effort { gap: 0.1, boxes: 2000, ..Effort::default() };
        bounded(&spec, &mut magnitudes, &norm, &box_, &effort)
    };
    let open = over([100.0, 170.0]);
    assert!(open.certified.is_infinite() && !open.complete, "{open:?}");
    let place = open.unbounded.map(|at| at[0].to_degrees());
    // d² = 40² + 100² − 2 · 40 · 100 cos q1 = 130²
    let dead = ((40.0_f64.powi(2) + 100.0_f64.powi(2) - 130.0_f64.powi(2)) / 8000.0).acos().to_degrees();
    assert!(place.is_some_and(|place| place > dead - 1.0), "{place:?}, beyond {dead}");
    let closed = over([60.0, 110.0]);
    assert!(closed.complete && closed.certified <= 1.1 * closed.found, "{closed:?}");
}
