//! Generated C in single precision, compared with double precision.

use std::fs;
use std::path::Path;
use std::process::Command;

use abbe::analysis::sampling::{arm_length, nominal_parameters};
use abbe::compensator::norms;
use abbe::function::BEGIN;
use abbe::{Function, Manipulator, Orientation, Pose, deviation};
use abbe_codegen::print::{Language, Real};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::{coupled_joints, long_chain};
use abbe_tests::languages::{NAMES, configurations};
use abbe_tests::mechanisms::{Mechanism, is_regular};
use abbe_tests::needs::{Missing, tool};
use abbe_tests::{is_tested, sample_size, specs, thorough};

use super::program::{called, compiled, functions, self_test, succeeds, write};

/// Largest differences of single from double precision.
#[derive(Default)]
struct Differences {
    /// Difference of the position of `pose`, in the length unit.
    position: f64,
    /// Difference of `J_e`, relative to its largest number.
    jacobian: f64,
    /// Difference of the tool point's displacement by errors of 1e-3, in the length unit.
    displacement: f64,
    /// Errors of position and rotation, computed in double precision: at the commands, and at the
    /// commands compensated in single precision, if both precisions converge.
    before: [f64; 2],
    after: [f64; 2],
    /// Number of compensated commands that reach their pose in double precision, and in both.
    rest: [usize; 2],
}

/// Compares both precisions at the same configurations, rounded to single precision.
fn differences(spec: &Spec, given: Vec<Vec<f64>>) -> Differences {
    let name = spec.name.clone();
    let robot = Interpreter::new(spec.clone());
    let inputs = spec.variables.len() + spec.parameters.len();
    // An input at the upper end of its range stays in the range.
    let nearest = |(i, value): (usize, f64)| {
        let nearest = Real::Float.nearest(value);
        match i.checked_sub(inputs).and_then(|input| spec.inputs.get(input)) {
            Some(input) if nearest > input.range[1] => f64::from((nearest as f32).next_down()),
            _ => nearest,
        }
    };
    let given: Vec<Vec<f64>> =
        given.into_iter().map(|given| given.into_iter().enumerate().map(nearest).collect()).collect();
    let euler = robot.description().orientation != Orientation::RotationVector;
    let [mut double, mut single] = Real::ALL.map(|real| {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), spec, real);
        called(&["cc"], folder.path(), &robot, real, &given).into_iter()
    });
    let mut found = Differences::default();
    assert_eq!((double.next(), single.next()), (Some(0.0), Some(0.0)), "{name}: the self-tests");
    for given in &given {
        for function in functions(&robot) {
            let [one, other] = [&mut double, &mut single].map(|numbers| numbers.next().unwrap());
            assert!(one == other || euler, "{name} {}: {one} and {other}", function.name());
            let arrays = function.signature().results.iter().map(|array| array.len(robot.description()));
            for (k, len) in arrays.enumerate() {
                let [a, b] = [&mut double, &mut single].map(|all| all.take(len).collect::<Vec<f64>>());
                if one == 0.0 && other == 0.0 {
                    found.compare(function, k, &a, &b);
                }
            }
        }
        let q = &given[..robot.description().variables.len()];
        let of = |numbers: &mut std::vec::IntoIter<f64>| {
            let status = numbers.next().unwrap();
            let corrected: Vec<f64> = numbers.take(q.len()).collect();
            numbers.nth(q.len() + 11);
            (status, corrected)
        };
        let done = [of(&mut double), of(&mut single)];
        for numbers in [&mut double, &mut single] {
            numbers.nth(BEGIN.results_len(robot.description()));
        }
        let [double, single] = done;
        found.compensated(&robot, given, double, single);
    }
    assert_eq!((double.next(), single.next()), (None, None), "{name}");
    found
}

impl Differences {
    fn compare(&mut self, function: Function, result: usize, a: &[f64], b: &[f64]) {
        let largest = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        match (function, result) {
            (Function::Pose, _) => {
                self.position = self.position.max(largest(&a[9..], &b[9..]));
            }
            (Function::ErrorJacobian, 1) => {
                self.jacobian = self.jacobian.max(largest(a, b) / largest(a, &vec![0.0; a.len()]));
            }
            (Function::Displacement, _) => {
                self.displacement = self.displacement.max(largest(&a[..3], &b[..3]));
            }
            _ => {}
        }
    }

    fn compensated(
        &mut self,
        robot: &Interpreter,
        given: &[f64],
        (double, exact): (f64, Vec<f64>),
        (single, found): (f64, Vec<f64>),
    ) {
        let description = robot.description();
        let (q, rest) = given.split_at(description.variables.len());
        let (s, rest) = rest.split_at(description.parameters.len());
        let u = &rest[..description.inputs.len()];
        let target = robot.pose(q, s).unwrap();
        let left = |q: &[f64]| {
            let real = robot.evaluate_unchecked(Function::RealPose, &[q, s, u].concat()).unwrap();
            let real = Pose(std::array::from_fn(|i| std::array::from_fn(|j| real[3 * i + j])));
            norms(&deviation(Orientation::RotationVector, &target, &real))
        };
        let more = |most: &mut [f64; 2], (length, angle): (f64, f64)| {
            *most = [most[0].max(length), most[1].max(angle)];
        };
        self.rest[0] += usize::from(double == 0.0);
        self.rest[1] += usize::from(double == 0.0 && single == 0.0);
        // Targets that neither can reach are no measure of precision.
        let (length, angle) = left(&exact);
        let metre = 1.0 / description.length.in_metres();
        if [double, single] == [0.0; 2] && length < 1e-8 * metre && angle < 1e-8 {
            more(&mut self.before, left(q));
            more(&mut self.after, left(&found));
        }
    }
}

/// Checks the rows of the chapter's table, and that the header states the largest differences.
pub(crate) fn shipped_robots() -> Result<(), Missing> {
    tool("cc", "")?;
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/in-a-controller.md");
    let page = fs::read_to_string(page).unwrap();
    let mut most = [0.0_f64; 4];
    let mut wrong = Vec::new();
    for shipped in SHIPPED.iter().filter(|shipped| is_tested(shipped.name)) {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap();
        let robot = Interpreter::new(spec.clone());
        let found = differences(&spec, configurations(&robot, 1000));
        let arm = arm_length(&robot, &nominal_parameters(robot.description())).unwrap();
        let shares = [found.position / arm, found.jacobian, found.after[0] / arm, found.after[1]];
        most = std::array::from_fn(|k| most[k].max(shares[k]));
        let unit = robot.description().length.symbol();
        let Differences { position, jacobian, displacement, before, after, rest } = found;
        let figures = [position, jacobian, displacement, before[0], after[0], before[1], after[1]];
        let [position, jacobian, displacement, before, after, turned, left] = figures.map(upwards);
        let corrected = match figures[3] > 0.0 {
            true => format!("{before} → {after} {unit} | {turned} → {left} rad"),
            false => "– | –".to_owned(),
        };
        let row = format!(
            "| {} | {position} {unit} | {jacobian} | {displacement} {unit} | {corrected} | {} of {} |",
            shipped.name, rest[1], rest[0],
        );
        println!("{row}");
        // Without errors, commands change by rounding errors at most.
        let is_corrected = figures[3] > 0.0;
        assert!(
            is_corrected || figures[4] < 1e-7 * arm && figures[6] < 1e-7,
            "{}: {figures:?}",
            shipped.name
        );
        let some: Vec<f64> = figures[..if is_corrected { 7 } else { 3 }].to_vec();
        let begin = format!("| {} |", shipped.name);
        let told = page.lines().find(|line| line.starts_with(&begin)).unwrap_or("");
        if !told.contains(&format!("{} of {} |", rest[1], rest[0])) || !agree(&numbers(told), &some) {
            wrong.push(row);
        }
    }
    println!("shares: {:?}", most.map(upwards));
    assert!(wrong.is_empty(), "the chapter has other figures than\n{}", wrong.join("\n"));
    // The header states the largest differences of all robots.
    if !thorough() {
        return Ok(());
    }
    let spec = Spec::parse("ur5.toml", SHIPPED.iter().find(|shipped| shipped.name == "ur5").unwrap().spec);
    let header = Language::C(Real::Float).files(&spec.unwrap()).swap_remove(0).text;
    let (_, told) = header.split_once("computes in single precision").unwrap();
    let (told, _) = told.split_once("*/").unwrap();
    let told: String = told.lines().map(|line| line.trim_start_matches(" *")).collect();
    assert!(agree(&numbers(&told), &most), "{told}: {most:?}");
    Ok(())
}

/// Formats a number with two digits, the last one rounded up.
fn upwards(value: f64) -> String {
    let digit = 10_f64.powf(value.log10().floor() - 1.0);
    format!("{:.1e}", (value / digit).ceil() * digit)
}

/// Returns the numbers with an exponent in a text.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | '|'));
    words.filter(|word| word.contains('e')).filter_map(|word| word.parse().ok()).collect()
}

/// Returns whether every documented bound holds and none is much too large.
fn agree(told: &[f64], found: &[f64]) -> bool {
    let fits = |(told, found): (&f64, &f64)| found <= told && *told <= 1.3 * found;
    told.len() == found.len() && told.iter().zip(found).all(fits)
}

pub(crate) fn long_chains_and_tables() -> Result<(), Missing> {
    tool("cc", "")?;
    for spec in [
        Spec::parse("long.toml", &long_chain()).unwrap(),
        Spec::parse("coupled.toml", coupled_joints()).unwrap(),
        Spec::read(specs::path("measured")).unwrap(),
        Spec::read(specs::path("linkage")).unwrap(),
        Spec::parse("names.toml", NAMES).unwrap(),
    ] {
        let robot = Interpreter::new(spec.clone());
        let arm = arm_length(&robot, &nominal_parameters(robot.description())).unwrap();
        let mut given = configurations(&robot, 50);
        // At the ends of tables.
        let limits = robot.description().variables[0].limits;
        let limits = limits.into_iter().filter(|limit| limit.is_finite());
        given.iter_mut().zip(limits).for_each(|(given, limit)| given[0] = limit);
        let Differences { position, jacobian, .. } = differences(&spec, given);
        // Twice the differences of six frames for every six frames.
        let frames = robot.description().frames.len().div_ceil(6) as f64;
        assert!(position > 0.0 && position <= frames * 1e-6 * arm, "{position} of {arm}");
        assert!(jacobian > 0.0 && jacobian <= frames * 1e-6, "{jacobian}");
    }
    Ok(())
}

/// Checks that the error Jacobians of random mechanisms in mm, whose loops mix lengths and angles,
/// are within 1e-4 of those in double precision; 50 in a thorough run.
pub(crate) fn mechanisms() -> Result<(), Missing> {
    tool("cc", "")?;
    let (mut worst, mut count) = (0.0_f64, 0);
    for seed in 0.. {
        let [in_metres, spec] = [Mechanism::new(seed), Mechanism::in_millimetres(seed)]
            .map(|Mechanism { text, .. }| Spec::parse("mechanism.toml", &text).unwrap());
        let is_mixed = |closed: &abbe_spec::Loop| {
            let equations = 0..closed.closure.equations();
            let angles = equations.clone().filter(|i| closed.closure.is_angle(*i)).count();
            angles > 0 && angles < equations.len()
        };
        if !spec.loops.iter().any(is_mixed) || !is_regular(&Interpreter::new(in_metres)) {
            continue;
        }
        let robot = Interpreter::new(spec.clone());
        let Differences { jacobian, .. } = differences(&spec, configurations(&robot, 20));
        println!("{seed}: {jacobian:e}");
        worst = worst.max(jacobian);
        count += 1;
        if count == 2 * sample_size(25).max(1) {
            break;
        }
    }
    println!("worst of {count}: {worst:e}");
    assert!(worst > 0.0 && worst < 1e-4, "{worst}");
    Ok(())
}

/// Compares sine and cosine with double precision, for one in 61 of all numbers in their range, and
/// their polynomials with the minimax ones.
pub(crate) fn sines() -> Result<(), Missing> {
    tool("cc", "")?;
    let folder = tempfile::tempdir().unwrap();
    let spec = Spec::parse("names.toml", NAMES).unwrap();
    write(folder.path(), &spec, Real::Float);
    let source = folder.path().join("main.c");
    fs::write(&source, SINES.replace("NAME", &spec.name)).unwrap();
    let program = folder.path().join("program");
    compiled(&["cc", "-O2"], &program, &[&source]);
    let said = String::from_utf8(succeeds(&mut Command::new(&program))).unwrap();
    println!("units in the last place, sine and cosine: {said}");
    let text = fs::read_to_string(folder.path().join(format!("{}.c", spec.name))).unwrap();
    for worst in said.split_whitespace() {
        let worst: f64 = worst.parse().unwrap();
        let (_, told) = text.split_once("the error is below ").unwrap();
        let told: f64 = told.split(' ').next().unwrap().parse().unwrap();
        assert!(worst < told && told < 1.3 * worst, "{worst}");
    }
    is_minimax(&factors(&text, "s"), |z| {
        let r = z.sqrt();
        // z (S − (sin r − r)/r³), relative to sin r / r
        let series: f64 =
            (0..12).rev().fold(0.0, |sum, k| (1.0 - z * sum) / ((2 * k + 2) * (2 * k + 3)) as f64);
        (-series, z * r / r.sin())
    });
    is_minimax(&factors(&text, "c"), |z| {
        let series = (0..12).rev().fold(0.0, |sum, k| (1.0 - z * sum) / ((2 * k + 3) * (2 * k + 4)) as f64);
        (series / 2.0, z * z / z.sqrt().cos())
    });
    Ok(())
}

/// Program that includes the source: manipulator and program are one translation unit.
const SINES: &str = r#"
#include "NAME.c"
#include <stdint.h>
#include <stdio.h>
#include <string.h>
static double units(float found, double expected)
{
    return fabs((double)found - expected) / ldexp(1.0, ilogb(expected) - 23);
}
int main(void)
{
    double worst[2] = { 0.0, 0.0 };
    for (uint32_t bits = 0x20000000U; bits < 0x45bb8000U; bits += 61U) {
        for (int sign = 0; sign < 2; sign++) {
            const uint32_t signed_bits = bits | ((uint32_t)sign << 31);
            float x;
            float s;
            float c;
            memcpy(&x, &signed_bits, sizeof x);
            sin_cos(x, &s, &c);
            worst[0] = fmax(worst[0], units(s, sin((double)x)));
            worst[1] = fmax(worst[1], units(c, cos((double)x)));
        }
    }
    printf("%.3f %.3f\n", worst[0], worst[1]);
    return 0;
}
"#;

/// Returns the coefficients of a polynomial of degree 2, the lowest power first: of the sine after
/// r, of the cosine after −1/2.
fn factors(text: &str, name: &str) -> [f64; 3] {
    let (_, text) = text.split_once(&format!("    float {name} = ")).unwrap();
    let words = text.split(|c: char| c.is_whitespace() || c == ';');
    let mut found = words.filter_map(|word| word.strip_suffix('f')?.parse().ok());
    let [third, second, first] = [(); 3].map(|()| f64::from(found.next().map(|x: f64| x as f32).unwrap()));
    [first, second, third]
}

/// Checks that a polynomial is minimax. A polynomial whose error has four extrema of alternating
/// signs exceeds the best error by at most the difference of the largest and the smallest extremum
/// (de la Vallée-Poussin). `at` returns the approximated value and the weight of the error at each
/// z on (0, (π/4)²].
fn is_minimax(factors: &[f64; 3], at: impl Fn(f64) -> (f64, f64)) {
    let mut extrema: Vec<f64> = Vec::new();
    for k in 1..=100_000 {
        let z = std::f64::consts::FRAC_PI_4.powi(2) * f64::from(k) / 1e5;
        let (wanted, weight) = at(z);
        let error = ((factors[2] * z + factors[1]) * z + factors[0] - wanted) * weight;
        match extrema.last_mut() {
            Some(last) if *last * error >= 0.0 => {
                *last = if error.abs() > last.abs() { error } else { *last }
            }
            _ => extrema.push(error),
        }
    }
    let [least, largest] = [f64::min, f64::max].map(|f| extrema.iter().map(|e| e.abs()).reduce(f).unwrap());
    assert!(extrema.len() == 4 && largest <= 1.2 * least, "{extrema:?}");
}

/// Checks that the self-test passes with other compilers and fused operations, and fails for a
/// length wrong in the fourth digit, or for `double` in the eleventh.
pub(crate) fn self_tests() -> Result<(), Missing> {
    tool("gcc", "")?;
    tool("clang", "")?;
    let fused = ["gcc", "-O2", "-ffp-contract=fast", "-march=native"];
    let shipped = SHIPPED.iter().filter(|shipped| is_tested(shipped.name));
    let shipped = shipped.map(|one| Spec::parse(&format!("{}.toml", one.name), one.spec).unwrap());
    for spec in shipped.chain([Spec::read(specs::path("planar")).unwrap()]) {
        for real in Real::ALL {
            let folder = tempfile::tempdir().unwrap();
            write(folder.path(), &spec, real);
            for compiler in [&["clang"][..], &fused] {
                assert_eq!(
                    self_test(folder.path(), &spec.name, compiler),
                    0,
                    "{} {real} {compiler:?}",
                    spec.name
                );
            }
        }
    }
    let puma = SHIPPED.iter().find(|shipped| shipped.name == "puma560").unwrap();
    let spec = Spec::parse("puma560.toml", puma.spec).unwrap();
    for (real, wrong) in [(Real::Double, "0.43180000001"), (Real::Float, "0.4319")] {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &spec, real);
        let source = folder.path().join("puma560.c");
        let text = fs::read_to_string(&source).unwrap();
        let [right, wrong] = ["0.4318", wrong].map(|length| format!("const {real} a2_z4 = {length}"));
        assert!(text.contains(&right));
        let text = text.replace(&right, &wrong);
        fs::write(&source, text).unwrap();
        assert_ne!(self_test(folder.path(), "puma560", &["gcc"]), 0, "{real}");
    }
    Ok(())
}

/// Inverse kinematics in both precisions finds the joints of poses, at limits and in the middle of
/// them, as exactly as the numbers permit: of all but one in 5,000, where a joint is at its limit
/// and an elbow is almost stretched, which amplifies rounding.
pub(crate) fn poses_have_their_joints() -> Result<(), Missing> {
    tool("cc", "")?;
    let count = if thorough() { 400_000 } else { 10_000 };
    for shipped in SHIPPED.iter().filter(|shipped| is_tested(shipped.name)) {
        let spec = Spec::parse(shipped.name, shipped.spec).unwrap();
        let robot = Interpreter::new(spec.clone());
        let description = robot.description();
        if description.solutions == 0 || description.has_loops() {
            continue;
        }
        for real in Real::ALL {
            let folder = tempfile::tempdir().unwrap();
            write(folder.path(), &spec, real);
            let name = &spec.name;
            let parameters = if spec.parameters.is_empty() { "" } else { "NAME_parameters," };
            let text = INVERSE
                .replace("PARAMETERS", parameters)
                .replace("REAL", real.name())
                .replace("COUNT", &count.to_string())
                .replace(
                    "SIZE",
                    &format!("{:e}", arm_length(&robot, &nominal_parameters(description)).unwrap()),
                )
                .replace("UPPER", &name.to_ascii_uppercase())
                .replace("NAME", name);
            let [source, program] = ["inverse.c", "inverse"].map(|file| folder.path().join(file));
            fs::write(&source, text).unwrap();
            compiled(&["cc", "-Wshadow"], &program, &[&source, &folder.path().join(format!("{name}.c"))]);
            let run = Command::new(&program).output().unwrap();
            let printed = String::from_utf8(run.stdout).unwrap();
            println!("{name} {}: {printed}", real.name());
            let numbers: Vec<f64> = printed.split_whitespace().map(|word| word.parse().unwrap()).collect();
            let bound = if real == Real::Double { 1e-10 } else { 2e-5 };
            assert!(
                numbers[0] <= f64::from(count / 5000) && numbers[1] <= bound,
                "{name} {}: {printed}",
                real.name()
            );
        }
    }
    Ok(())
}

const INVERSE: &str = include_str!("inverse.c");
