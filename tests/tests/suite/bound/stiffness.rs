//! The displacement of the tool point by a force never exceeds its certified bound.

use abbe::Manipulator;
use abbe_bound::{Effort, Extreme, Moving, Singular, singular_value};
use abbe_codegen::chain::ToolCompliance;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::thorough;
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{given, home, moving, part, place, robot, robots};

fn largest(spec: &Spec, box_: &[Moving], effort: &Effort) -> Option<Singular> {
    let ToolCompliance { graph, rows } = ToolCompliance::new(spec)?;
    let still = |symbol| home(symbol, spec);
    Some(singular_value(Extreme::Largest, &graph, &rows, box_, &still, effort, &mut |_| true))
}

/// Returns the robot under a force of 1 N along an axis of `F_0` at the tool point, or without a
/// force.
fn loaded(text: &str, axis: Option<usize>) -> Interpreter {
    let frames = text.matches("[[frame]]").count();
    let force = |axis: usize| (0..3).map(|i| if i == axis { "\"1 N\"," } else { "0," }).collect::<String>();
    let load = axis.map(|axis| {
        format!(
            "[[load]]\nname = \"push\"\nforce = [{}]\naxes = \"base\"\nframe = \"{frames}\"\npoint = \"tool\"\n",
            force(axis)
        )
    });
    Interpreter::new(Spec::parse("robot.toml", &(text.to_owned() + &load.unwrap_or_default())).unwrap())
}

/// Returns the largest displacement of the tool point by 1 N: the difference of the errors with and
/// without it.
fn compliance(robots: &[Interpreter; 4], q: &[f64], u: &[f64]) -> f64 {
    let shift = |robot: &Interpreter| {
        let description = robot.description();
        let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
        let parameters = abbe::analysis::sampling::nominal_parameters(description);
        robot.error_jacobian(q, &parameters, &mut columns).unwrap();
        let mut errors = vec![[0.0; 6]; description.frames.len()];
        robot.generalized_errors(q, &parameters, u, &mut errors).unwrap();
        let row = |i: usize| {
            columns.iter().zip(errors.as_flattened()).map(|(column, error)| column[i] * error).sum::<f64>()
        };
        [0, 1, 2].map(row)
    };
    let [none, pushed @ ..] = robots.each_ref().map(shift);
    let matrix = DMatrix::from_fn(3, 3, |i, j| pushed[j][i] - none[i]);
    matrix.singular_values()[0]
}

#[test]
fn nothing_gives_way_more_than_is_certified() {
    let (mut looked, mut complete, mut all_boxes) = (0, 0, 0);
    for seed in robots() {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let frames = |text: &str| text.matches("[[frame]]").count();
        let mut text = robot::spec(&mut random);
        let at = random.random_range(1..=frames(&text));
        text += &format!(
            "[[source]]\nname = \"bends\"\nclass = \"repeatable\"\nframe = \"{at}\"\n\
             beam = {{ length = \"0.4 m\", EI_y = \"3e3 N*m^2\", EI_z = \"2e3 N*m^2\", GJ = \"1e3 N*m^2\", EA = \"1e7 N\" }}\n\
             [[source]]\nname = \"gives\"\nclass = \"repeatable\"\nframe = \"1\"\nat = \"Tz(0.1) Rx(0.3)\"\n\
             compliance = {{ diagonal = [\"1e-6 m/N\", 0, \"2e-6 m/N\", \"1e-5/(N*m)\", \"2e-5/(N*m)\", 0] }}\n\
             [[load]]\nname = \"hangs\"\nforce = [0, 0, \"-5 N\"]\naxes = \"base\"\nframe = \"{last}\"\npoint = \"tool\"\n",
            last = frames(&text)
        );
        let spec = Spec::parse("robot.toml", &text).unwrap();
        let robots = [None, Some(0), Some(1), Some(2)].map(|axis| loaded(&text, axis));
        let all = moving(&spec);
        for _ in 0..given("ABBE_BOXES", if thorough() { 4 } else { 2 }) {
            let box_ = part(&all, &mut random);
            let effort = Effort { gap: 0.02, boxes: 2000, ..Effort::default() };
            let largest = largest(&spec, &box_, &effort).unwrap();
            all_boxes += 1;
            complete += usize::from(largest.complete);
            let at = |place: &[f64]| {
                let (q, u) = place.split_at(spec.variables.len());
                compliance(&robots, q, u)
            };
            let found = at(&largest.at);
            assert!(
                (found - largest.found.unwrap()).abs() < 1e-9 * found,
                "robot {seed}: {found} {largest:?}"
            );
            assert!(!largest.complete || largest.certified <= 1.02 * largest.found.unwrap(), "{largest:?}");
            for _ in 0..given("ABBE_SAMPLES", 30) {
                let place = place(&box_, &mut random);
                looked += 1;
                assert!(
                    at(&place) <= largest.certified * (1.0 + 1e-9),
                    "robot {seed}: {} above {largest:?}\n{place:?}",
                    at(&place)
                );
            }
        }
    }
    assert!(
        10 * complete > 8 * all_boxes && looked > 33 * robots().count(),
        "{complete} of {all_boxes}, {looked} places"
    );
}

/// Checks textbook cases. A quill that extends from its bearing by L is a clamped beam, `3EI/L³`.
/// Two bars with a compliance c at each joint give `c ((l_1 + l_2)² + l_2²)` when stretched.
#[test]
fn what_textbooks_know_is_found() {
    let quill = "[manipulator]\nname = \"quill\"\nlength = \"mm\"\n\
         [[frame]]\nname = \"1\"\nvariable = { name = \"out\", kind = \"prismatic\", limits = [\"100 mm\", \"400 mm\"], home = \"100 mm\" }\n\
         transform = \"Tx(out)\"\n\
         [[source]]\nname = \"quill\"\nclass = \"repeatable\"\nframe = \"1\"\n\
         beam = { length = \"out\", EI_y = \"2e5 N*m^2\", EI_z = \"1e5 N*m^2\" }\n\
         [[load]]\nname = \"cuts\"\nforce = [0, \"10 N\", 0]\nframe = \"1\"\n";
    let bar = |name: &str, before: &str| {
        format!(
            "[[frame]]\nname = \"{name}\"\nvariable = {{ name = \"{name}\", kind = \"revolute\", limits = [\"-2\", \"3\"] }}\n\
             transform = \"{before} Rz({name})\"\n\
             [[source]]\nname = \"gear of {name}\"\nclass = \"repeatable\"\nframe = \"{name}\"\n\
             compliance = {{ diagonal = [0, 0, 0, 0, \"1e-5/(N*m)\", 0] }}\n"
        )
    };
    let bars = format!(
        "[manipulator]\nname = \"bars\"\nlength = \"m\"\n{}{}[tool]\ntransform = \"Tx(0.3)\"\n\
         [[load]]\nname = \"pulls\"\nforce = [0, \"10 N\", 0]\nframe = \"elbow\"\n",
        bar("shoulder", ""),
        bar("elbow", "Tx(0.4)")
    );
    for (text, exact) in
        [(quill, 0.4_f64.powi(3) / (3.0 * 1e5)), (&bars, 1e-5 * (0.7_f64.powi(2) + 0.3_f64.powi(2)))]
    {
        let spec = Spec::parse("known.toml", text).unwrap();
        let largest = largest(&spec, &moving(&spec), &Effort::default()).unwrap();
        assert!(largest.complete, "{largest:?}");
        assert!(largest.certified >= exact * (1.0 - 1e-12), "{exact} {largest:?}");
        assert!(
            largest.certified <= 1.011 * exact && largest.found.unwrap() >= exact / 1.011,
            "{exact} {largest:?}"
        );
    }
}
