//! Sine, cosine, arctangent and whole numbers of generated Structured Text.

use abbe_codegen::print::Language;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::sample_size;
use abbe_tests::structured_text::Program;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::shipped;

/// Returns a program with a block that calls a function of two numbers.
fn calling(expression: &str) -> Program {
    let text = Language::StructuredText.files(&shipped("ur5")).remove(0).text;
    let (support, _) = text.split_once("FUNCTION_BLOCK").unwrap();
    let block = format!(
        "{support}\nPROGRAM called\nVAR_INPUT\n    a, b : LREAL;\nEND_VAR\nVAR_OUTPUT\n    x, y : LREAL;\nEND_VAR\n\
         {expression}\nEND_PROGRAM\n"
    );
    Program::parse(&block).unwrap_or_else(|fault| panic!("{fault}"))
}

/// Returns the number of numbers between two of them.
fn units_apart(a: f64, b: f64) -> f64 {
    (a - b).abs() / (b.abs().next_up() - b.abs())
}

#[test]
fn arctangents_are_within_two_units_in_the_last_place() {
    let program = calling("x := ur5_arctangent(a, b);");
    let mut instance = program.instance("called");
    let mut random = Xoshiro256PlusPlus::seed_from_u64(3);
    let mut worst = 0.0_f64;
    for index in 0..sample_size(100_000) {
        let size = if index % 3 == 0 { 1e-9 } else { 1.0 };
        let [mut y, mut x]: [f64; 2] = [size, 1.0].map(|size| size * random.random_range(-1.0..1.0));
        match index % 17 {
            0 => y = 0.0,
            1 => x = 0.0,
            2 => (x, y) = (y.abs(), y),
            3 => (x, y) = (-y.abs(), y),
            _ => {}
        }
        instance.set("a", &[y]);
        instance.set("b", &[x]);
        instance.call().unwrap();
        worst = worst.max(units_apart(instance.get("x")[0], y.atan2(x)));
    }
    println!("{worst} units in the last place");
    assert!(worst <= 2.0, "{worst}");
}

/// The interface of a manipulator whose pose is a sine and a cosine.
const TURN: &str = r#"
[manipulator]
name = "turn"
length = "m"
[[frame]]
name = "turn"
variable = { name = "q1", kind = "revolute", limits = ["-1e9 rad", "1e9 rad"] }
transform = "Rz(q1)"
"#;

#[test]
fn sines_have_the_bits_of_rust_whichever_way_controllers_convert() {
    let spec = Spec::parse("turn.toml", TURN).unwrap();
    let robot = Interpreter::new(spec);
    let program = calling("y := ur5_cosine_and_sine(a, x);");
    let conversions: [fn(f64) -> f64; 4] = [f64::round_ties_even, f64::trunc, f64::round, f64::floor];
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    let mut instances = conversions.map(|to_whole| {
        let mut instance = program.instance("called");
        instance.to_whole = to_whole;
        instance
    });
    for index in 0..sample_size(100_000) {
        let size = [1.0, 10.0, 1e5, 1e7][index % 4];
        let x = if index == 0 { 0.0 } else { size * random.random_range(-1.0..1.0) };
        let pose = robot.evaluate_unchecked(abbe::Function::Pose, &[x]).unwrap();
        for instance in &mut instances {
            instance.set("a", &[x]);
            instance.call().unwrap();
            assert_eq!([instance.get("y")[0], instance.get("x")[0]], [pose[0], pose[1]], "at {x}");
        }
    }
}
