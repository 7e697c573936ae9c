//! Certified bounds are never exceeded: random boxes on random robots, adversarial boxes, and cases
//! with closed-form solutions.

mod by_hand;
mod corners;
mod dexterity;
mod elastic_arms;
mod loops;
mod remainder;
mod residual;
mod robot;
mod stiffness;

use abbe::analysis::sampling::nominal_parameters;
use abbe::{Class, Manipulator, Orientation};
use abbe_bound::{Bound, Effort, Moving, largest, limits};
use abbe_codegen::chain::{DIRECTION, Magnitude, Magnitudes};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;
use abbe_tests::thorough;
use rand::{Rng, RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use by_hand::{is, two_bars};

/// Rounding error of the test, which sums errors from the columns of `J_e`, unlike the bounds.
const ROUNDING: f64 = 1e-12;

fn moving(spec: &Spec) -> Vec<Moving> {
    let joints = spec.variables.iter().enumerate().map(|(i, variable)| Moving {
        symbol: Symbol::Variable(i),
        range: variable.limits,
        home: variable.home,
        start: variable.home,
    });
    let inputs = spec.inputs.iter().enumerate().map(|(i, input)| Moving {
        symbol: Symbol::Input(i),
        range: input.range,
        home: input.value,
        start: input.value,
    });
    joints.chain(inputs).collect()
}

fn home(symbol: Symbol, spec: &Spec) -> f64 {
    match symbol {
        Symbol::Variable(i) => spec.variables[i].home,
        Symbol::Parameter(i) => spec.parameters[i].value,
        Symbol::Input(i) => spec.inputs[i].value,
        _ => f64::NAN,
    }
}

fn bounded(
    spec: &Spec,
    magnitudes: &mut Magnitudes,
    magnitude: &Magnitude,
    box_: &[Moving],
    effort: &Effort,
) -> Bound {
    let Magnitudes { graph, implicit, .. } = magnitudes;
    largest(graph, magnitude, implicit, box_, &|symbol| home(symbol, spec), effort, &mut |_| true)
}

/// Returns the magnitudes of the repeatable sources, of the random ones, and of their sum.
fn kinds(magnitudes: &Magnitudes) -> [[Magnitude; 5]; 3] {
    [&magnitudes.repeatable, &magnitudes.random, &magnitudes.total].map(Clone::clone)
}

/// Returns the errors of the repeatable sources, of the random ones in the worst case, and of all
/// in the worst case: each the norm, x, y, z, and the norm of rows 4–6.
fn sizes(robot: &Interpreter, q: &[f64], u: &[f64]) -> Option<[[f64; 5]; 3]> {
    let description = robot.description();
    let s = nominal_parameters(description);
    let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
    robot.error_jacobian(q, &s, &mut columns).ok()?;
    let mut effects = vec![0.0; description.effects.len()];
    robot.effects(q, &s, u, &mut effects).ok()?;
    let mut moved = vec![[0.0; 6]; description.sources.len()];
    for (effect, value) in description.effects.iter().zip(&effects) {
        let column = &columns[6 * effect.frame + effect.component.index()];
        for (sum, entry) in moved[effect.source].iter_mut().zip(column) {
            *sum += value * entry;
        }
    }
    let mut repeatable = [0.0; 6];
    let mut random = Vec::new();
    for (source, moved) in description.sources.iter().zip(&moved) {
        match source.class {
            Class::Repeatable => (0..6).for_each(|i| repeatable[i] += moved[i]),
            // At its bound: 3σ for a normal one.
            Class::Tolerance(distribution) | Class::Random(distribution) => {
                random.push(moved.map(|part| distribution.bound() * part));
            }
        }
    }
    Some([
        most_of_all_signs(&repeatable, &[]),
        most_of_all_signs(&[0.0; 6], &random),
        most_of_all_signs(&repeatable, &random),
    ])
}

/// Returns the largest sizes of a displacement and others with every pattern of signs: the norm, x,
/// y, z, and the norm of rows 4–6.
fn most_of_all_signs(fixed: &[f64; 6], free: &[[f64; 6]]) -> [f64; 5] {
    let mut most = [0.0_f64; 5];
    for signs in 0..1_u32 << free.len() {
        let mut sum = *fixed;
        for (k, moved) in free.iter().enumerate() {
            let sign = if signs >> k & 1 == 0 { 1.0 } else { -1.0 };
            sum.iter_mut().zip(moved).for_each(|(sum, part)| *sum += sign * part);
        }
        let norm = |part: &[f64]| part.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        let five = [norm(&sum[..3]), sum[0].abs(), sum[1].abs(), sum[2].abs(), norm(&sum[3..])];
        most = std::array::from_fn(|i| most[i].max(five[i]));
    }
    most
}

/// Returns a part of the box of joints and inputs: often wide, sometimes narrow or a point,
/// sometimes at an end.
fn part(all: &[Moving], random: &mut impl Rng) -> Vec<Moving> {
    all.iter()
        .map(|name| {
            let [low, high] = name.range;
            let width = (high - low) * [0.0, 1e-9, 0.01, 0.3, 1.0][random.random_range(0..5)];
            let low = match random.random_range(0..3) {
                0 => low,
                1 => high - width,
                _ => low + random.random_range(0.0..=1.0) * (high - low - width),
            };
            Moving { range: [low, (low + width).min(high)], ..*name }
        })
        .collect()
}

/// Returns a point in a box: anywhere, or with some joints at their limits.
fn place(box_: &[Moving], random: &mut impl Rng) -> Vec<f64> {
    let within = |name: &Moving, random: &mut dyn FnMut() -> f64| {
        let [low, high] = name.range;
        match random() {
            r if r < 0.15 => low,
            r if r > 0.85 => high,
            _ => (low + random() * (high - low)).min(high),
        }
    };
    box_.iter().map(|name| within(name, &mut || random.random_range(0.0..1.0))).collect()
}

fn is_sound(seed: u64, boxes: usize, samples: usize) {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let text = robot::spec(&mut random);
    let spec = Spec::parse("robot.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
    let robot = Interpreter::new(spec.clone());
    let mut magnitudes = Magnitudes::new(&spec, &[]);
    let all = moving(&spec);
    for _ in 0..boxes {
        let box_ = part(&all, &mut random);
        let effort =
            Effort { gap: 0.02, boxes: [1, 40, 400][random.random_range(0..3)], ..Effort::default() };
        let places: Vec<Vec<f64>> = (0..samples).map(|_| place(&box_, &mut random)).collect();
        let seen: Vec<[[f64; 5]; 3]> = places
            .iter()
            .filter_map(|place| {
                let (q, u) = place.split_at(spec.variables.len());
                sizes(&robot, q, u)
            })
            .collect();
        // The bound from parts must hold too.
        let apart = magnitudes.apart.clone().expect("a chain");
        let limits = limits(&mut magnitudes.graph, &apart, &box_, &|symbol| home(symbol, &spec));
        for k in 0..3 {
            let most = |row: usize| seen.iter().map(|sizes| sizes[k][row]).fold(0.0, f64::max);
            let slack = ROUNDING * (most(0) + 1e-6);
            assert!(most(0) <= limits.position[k] + slack, "robot {seed}, {k}: {limits:?}\n{box_:?}\n{text}");
            let is_rotation = spec.orientation == Orientation::RotationVector;
            let slack = ROUNDING * (most(4) + 1e-6);
            assert!(
                !is_rotation || most(4) <= limits.rotation[k] + slack,
                "robot {seed}, {k}: {limits:?}\n{box_:?}\n{text}"
            );
        }
        // Neither x nor y exceeds the error perpendicular to z.
        for k in 0..3 {
            let across_z = magnitudes.across_z[k].clone();
            let bound = bounded(&spec, &mut magnitudes, &across_z, &box_, &effort);
            let most = seen.iter().map(|sizes| sizes[k][1].max(sizes[k][2])).fold(0.0, f64::max);
            let slack = ROUNDING * (most + 1e-6);
            assert!(
                most <= bound.certified + slack,
                "robot {seed}, {k} across z: {most:e} above {bound:?}\n{box_:?}\n{text}"
            );
        }
        let kinds = kinds(&magnitudes);
        for (k, five) in kinds.into_iter().enumerate() {
            for (i, magnitude) in five.into_iter().enumerate() {
                let bound = bounded(&spec, &mut magnitudes, &magnitude, &box_, &effort);
                let most = seen.iter().map(|sizes| sizes[k][i]).fold(0.0, f64::max);
                let slack = ROUNDING * (most + 1e-6);
                assert!(
                    most <= bound.certified + slack,
                    "robot {seed}, {k} {i}: {most:e} above {bound:?}\n{box_:?}\n{text}"
                );
                assert!(bound.found <= bound.certified);
                assert!(!bound.complete || bound.certified <= bound.found * 1.02 + 1e-9, "{bound:?}");
                let (q, u) = bound.at.split_at(spec.variables.len());
                if let Some(sizes) = sizes(&robot, q, u) {
                    // Near an Euler singularity rounding errors are amplified.
                    let (found, slack) = (sizes[k][i], 1e-6 * (sizes[k][i] + 1e-6));
                    // Along another direction more may be found at the same place.
                    let symbols = magnitudes.graph.symbols(&[magnitude.node]);
                    let has_direction = DIRECTION.iter().any(|(symbol, _)| symbols.contains(symbol));
                    let least = match (has_direction, bound.complete) {
                        (false, _) => found,
                        (true, true) => found / 1.02 - 1e-9,
                        (true, false) => 0.0,
                    };
                    assert!(
                        bound.found <= found + slack && bound.found >= least - slack,
                        "robot {seed}, {k} {i}: {found:e} at {bound:?}"
                    );
                }
            }
        }
    }
}

/// Returns a number from the environment: `ABBE_ROBOTS`, `ABBE_BOXES` per robot, `ABBE_SAMPLES` per
/// box; `ABBE_ROBOT` is the first of ten robots, or of thirty in a thorough run.
fn given(name: &str, otherwise: usize) -> usize {
    std::env::var(name).map_or(otherwise, |count| count.parse().expect("a number"))
}

fn robots() -> std::ops::Range<u64> {
    let first = given("ABBE_ROBOT", 0) as u64;
    first..first + if thorough() { 30 } else { 10 }
}

#[test]
fn nothing_exceeds_what_is_certified() {
    let (boxes, samples) = (given("ABBE_BOXES", 2), given("ABBE_SAMPLES", 60));
    robots().for_each(|seed| is_sound(seed, boxes, samples));
}

/// Holds what is certified over random boxes of random robots, one bound for each: the repeatable
/// or random errors or both, the norm or a row, of position or orientation, which no drawn error
/// exceeds. A thorough run has 20,000 boxes, and 100,000 with `ABBE_ROBOTS=2000`.
#[test]
fn nothing_exceeds_what_is_certified_in_many_boxes() {
    let (robots, boxes) = if thorough() { (400, 50) } else { (100, 10) };
    let robots = given("ABBE_ROBOTS", robots);
    let (mut complete, mut seen, mut uncertain) = (0, 0, 0);
    for seed in 0..robots as u64 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(1_000_000 + seed);
        let text = robot::spec(&mut random);
        let spec = Spec::parse("robot.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}\n{text}"));
        uncertain += usize::from(text.contains("uncertainty"));
        let robot = Interpreter::new(spec.clone());
        let mut magnitudes = Magnitudes::new(&spec, &[]);
        let (kinds, all) = (kinds(&magnitudes), moving(&spec));
        for _ in 0..boxes {
            let box_ = part(&all, &mut random);
            let cells = [1, 10, 100][random.random_range(0..3)];
            let effort = Effort { gap: 0.02, boxes: cells, ..Effort::default() };
            let (kind, row) = (random.random_range(0..3), random.random_range(0..5));
            let bound = bounded(&spec, &mut magnitudes, &kinds[kind][row], &box_, &effort);
            complete += usize::from(bound.complete);
            for _ in 0..30 {
                let place = place(&box_, &mut random);
                let (q, u) = place.split_at(spec.variables.len());
                let Some(sizes) = sizes(&robot, q, u) else { continue };
                let size = sizes[kind][row];
                seen += 1;
                assert!(
                    size <= bound.certified + ROUNDING * (size + 1e-6),
                    "robot {seed}, {kind} {row}: {size:e} above {bound:?}\n{box_:?}\n{text}"
                );
            }
        }
    }
    println!(
        "{} boxes of {robots} robots, {uncertain} with uncertain inputs: {complete} known to 2 %, {seen} \
         drawn errors",
        robots * boxes
    );
}

/// Checks tables that end where the joint ends: at a whole number of mm, and at one that is rounded
/// in degrees.
#[test]
fn tables_that_end_at_the_limits_are_bounded() {
    for (kind, limits, unit) in
        [("prismatic", ["0 mm", "800 mm"], "mm"), ("revolute", ["-167.3 deg", "167.3 deg"], "deg")]
    {
        for interpolation in ["linear", "cubic"] {
            let [low, high] = limits.map(|limit| limit.split(' ').next().unwrap());
            let transform = if kind == "revolute" { "Rz(q)" } else { "Tx(q)" };
            let spec = format!(
                "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n\
                 [tables.profile]\nx = {{ values = [{low}, 100, 150, {high}], unit = \"{unit}\" }}\n\
                 y = {{ values = [1, 3, -7, 2], unit = \"um\" }}\ninterpolation = \"{interpolation}\"\n\
                 [[frame]]\nname = \"slide\"\ntransform = \"{transform}\"\n\
                 variable = {{ name = \"q\", kind = \"{kind}\", limits = {limits:?} }}\n\
                 [[source]]\nname = \"profile\"\nclass = \"repeatable\"\nframe = \"slide\"\ne_z = \"profile(q)\"\n"
            );
            let spec = Spec::parse("slide.toml", &spec).unwrap_or_else(|mistakes| panic!("{mistakes}"));
            let all = moving(&spec);
            let mut magnitudes = Magnitudes::new(&spec, &[]);
            let norm = magnitudes.repeatable[0].clone();
            let bound = bounded(&spec, &mut magnitudes, &norm, &all, &Effort::default());
            assert!(bound.complete && bound.certified < 0.0085, "{kind} {interpolation}: {bound:?}");
            assert!(bound.certified >= 0.007, "{kind} {interpolation}: {bound:?}");
            assert!(bound.found >= 0.007 * 0.99, "{kind} {interpolation}: {bound:?}");
        }
    }
}

/// An error of a number in a table with corners is its slope there, which jumps: the steepest
/// piece counts, although it is 0.05 mm of 800 mm and no sample meets it.
#[test]
fn slopes_of_tables_that_jump_are_bounded() {
    let text = "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n\
         [parameters]\nshift = \"0 mm\"\n\
         [tables.profile]\nx = { values = [-10, 503.37, 503.42, 810], unit = \"mm\" }\n\
         y = { values = [1, 3, -7, -5], unit = \"um\" }\ninterpolation = \"linear\"\n\
         [[frame]]\nname = \"slide\"\ntransform = \"Tx(q) Tz(profile(q + shift))\"\n\
         variable = { name = \"q\", kind = \"prismatic\", limits = [\"0 mm\", \"800 mm\"] }\n\
         [[source]]\nname = \"shift\"\nclass = \"repeatable\"\nparameter = \"shift\"\nerror = \"0.1 mm\"\n";
    let spec = Spec::parse("slide.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut magnitudes = Magnitudes::new(&spec, &[]);
    let norm = magnitudes.repeatable[0].clone();
    let bound = bounded(&spec, &mut magnitudes, &norm, &moving(&spec), &Effort::default());
    // As the ends of the piece are rounded.
    let steepest = 0.1 * 0.01 / (503.42 - 503.37) * (1.0 - 1e-14);
    assert!(bound.certified >= steepest && bound.certified <= 1.02 * steepest, "{steepest} {bound:?}");
}

/// Checks nine joints, which are too many for boxes: the bound comes from the parts, and is less
/// than two and a half times the largest error found.
#[test]
fn of_many_joints_the_parts_are_known() {
    let mut text = abbe_tests::chains::revolute_chain(9);
    for frame in 1..=9 {
        text += &format!(
            "[[source]]\nname = \"{frame}\"\nclass = \"repeatable\"\nframe = \"{frame}\"\ne_x = \"0.05 mm\"\ne_y = \"-0.03 mm\"\n\
             e_s = \"0.05 mrad\"\ne_r = \"-0.04 mrad\"\ne_p = \"0.03 mrad\"\n"
        );
    }
    let spec = Spec::parse("chain.toml", &text).unwrap();
    let mut magnitudes = Magnitudes::new(&spec, &[]);
    let (all, apart, norm) =
        (moving(&spec), magnitudes.apart.clone().expect("a chain"), magnitudes.repeatable[0].clone());
    let limits = limits(&mut magnitudes.graph, &apart, &all, &|symbol| home(symbol, &spec));
    let effort = Effort { boxes: 100, at_most: limits.position[0], ..Effort::default() };
    let bound = bounded(&spec, &mut magnitudes, &norm, &all, &effort);
    assert_eq!(bound.certified, limits.position[0]);
    assert!(bound.found > 0.4 * bound.certified, "{bound:?}");
}

#[test]
fn boxes_that_are_chosen_to_break_it_do_not() {
    let spec = two_bars("[\"-150 deg\", \"150 deg\"]");
    let mut magnitudes = Magnitudes::new(&spec, &[]);
    let norm = magnitudes.repeatable[0].clone();
    let robot = Interpreter::new(spec.clone());
    let at = |low: f64, high: f64| {
        let all = moving(&spec);
        vec![all[0], Moving { range: [low, high], ..all[1] }]
    };
    let degree = std::f64::consts::PI / 180.0;
    let largest = [
        // A point; neighbors of the stretched arm; more than a full turn; symmetric ends.
        (at(0.3, 0.3), 0.3_f64),
        (at(0.0, 0.0_f64.next_up()), 0.0),
        (at(-f64::EPSILON, f64::EPSILON), 0.0),
        (at(-10.0, 10.0), 0.0),
        (at(-150.0 * degree, 150.0 * degree), 0.0),
        (at(1e-8, 2e-8), 1e-8),
    ];
    for (box_, best) in largest {
        let bound = bounded(&spec, &mut magnitudes, &norm, &box_, &Effort { gap: 1e-9, ..Effort::default() });
        let exact = sizes(&robot, &[0.0, best], &[]).unwrap()[0][0];
        assert!(bound.certified >= exact * (1.0 - 1e-15), "{bound:?} {exact}");
        assert!(bound.certified <= exact * (1.0 + 1e-8) && bound.complete, "{bound:?} {exact}");
    }
}

/// Checks an error with a kink at the beginning of a held table, where it is largest: it rises by 1
/// mm/m up to 0, and falls by 1 mm/m after it.
#[test]
fn a_kink_at_the_end_of_a_table_may_be_the_maximum() {
    let text = r#"
        [manipulator]
        name = "slide"
        length = "m"
        [tables.falls]
        x = [0, 1, 2]
        y = [0, -2e-3, -4e-3]
        interpolation = "cubic"
        outside = "hold"
        [[frame]]
        name = "slide"
        variable = { name = "d", kind = "prismatic", limits = [-1.3, 1.7] }
        transform = "Tx(d)"
        [[source]]
        name = "scale"
        class = "repeatable"
        frame = "slide"
        e_x = "2e-3 m + 1e-3 * d + 1 m * falls(d/(1 m))"
    "#;
    let spec = Spec::parse("slide.toml", text).unwrap();
    let mut magnitudes = Magnitudes::new(&spec, &[]);
    let norm = magnitudes.repeatable[0].clone();
    for range in [[-1.3, 1.7], [-1.0, 1.0], [-0.7, 0.1], [-0.01, 1.9]] {
        let all = [Moving { range, ..moving(&spec)[0] }];
        is(&bounded(&spec, &mut magnitudes, &norm, &all, &Effort { gap: 1e-7, ..Effort::default() }), 2e-3);
    }
}

/// Checks two large errors that nearly cancel: the bound is that of the difference, up to the
/// rounding errors of numbers of this size.
#[test]
fn what_cancels_is_known_as_well_as_its_parts() {
    let text = r#"
        [manipulator]
        name = "cancel"
        length = "m"
        [[frame]]
        name = "slide"
        variable = { name = "d", kind = "prismatic", limits = [0, 1] }
        transform = "Tx(d)"
        [[source]]
        name = "one"
        class = "repeatable"
        frame = "slide"
        e_x = "1e6 * d + 1e-6 m * sin(d/(1 m))"
        [[source]]
        name = "other"
        class = "repeatable"
        frame = "slide"
        e_x = "-1e6 * d"
    "#;
    let spec = Spec::parse("cancel.toml", text).unwrap();
    let mut magnitudes = Magnitudes::new(&spec, &[]);
    let norm = magnitudes.repeatable[0].clone();
    let all = moving(&spec);
    let bound = bounded(&spec, &mut magnitudes, &norm, &all, &Effort::default());
    let exact = 1e-6 * 1.0_f64.sin();
    assert!(bound.certified >= exact && bound.found <= exact + 1e-9, "{bound:?}");
}
