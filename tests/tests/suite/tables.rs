//! Functions given by points: their values compared with SciPy's, their derivatives with
//! differences, every evaluator with every other, and their behavior beyond the ends.

use std::fs;
use std::path::Path;

use abbe::analysis::sampling::{halton, nominal_inputs, nominal_parameters};
use abbe::lanes::{InstructionSet, Kernel, Lanes, Register};
use abbe::laws::{SAMPLES, all};
use abbe::{Error, LookupTable, Manipulator, Quantity};
use abbe_codegen::{compile_into, print};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::golden::measured;
use abbe_tests::specs;

fn spec() -> Spec {
    Spec::read(specs::path("measured")).unwrap()
}

/// Returns the spec of one slide, with a table of these lines.
fn slide(table: &str, transform: &str, limits: &str) -> String {
    format!(
        "[manipulator]\nname = \"slide\"\nlength = \"mm\"\n[tables.sag]\n{table}\n[[frame]]\nname = \"carriage\"\n\
         variable = {{ name = \"d1\", kind = \"prismatic\", limits = {limits} }}\ntransform = \"{transform}\"\n"
    )
}

/// Points of the table `straightness`: x, value and slope by SciPy 1.x, `PchipInterpolator` and its
/// `derivative()`.
const STRAIGHTNESS: [[f64; 3]; 15] = [
    [0.0, 0.0, 0.06333333333333334],
    [1.0, 0.06349230107526882, 0.06365109677419355],
    [77.0, 5.741663139784946, 0.0847807311827957],
    [150.0, 12.5, 0.09946236559139784],
    [222.5, 23.212613425925927, 0.16166944444444442],
    [310.0, 30.911301279803645, -0.01686645336605891],
    [333.0, 30.252804051981062, -0.03577446747896214],
    [500.0, 8.80498724194219, -0.16883500112674366],
    [600.5, -4.284398801571055, -0.0687973166727053],
    [1000.0, -17.98761019673924, 0.00036575287454136647],
    [1247.25, -17.275630930313632, 1.617567185014755],
    [1248.0, -16.0, 0.2263662982682743],
    [1500.0, 17.43281105561828, 0.05707151066472733],
    [1999.0, 9.591632463784983, -0.09143713329515263],
    [2000.0, 9.500000000000002, -0.09182788865875856],
];
/// Points of the table `pitch`, which is equidistant.
const PITCH: [[f64; 3]; 8] = [
    [0.0, 12.0, -0.067],
    [100.0, 5.736, -0.05792],
    [499.0, -6.999906035999997, -0.000187892],
    [750.0, -3.6071428571428568, 0.02357142857142857],
    [1300.0, 15.898285714285715, 0.043611428571428565],
    [1600.0, 20.336, -0.01332],
    [1999.5, 4.0344820005, -0.068928003],
    [2000.0, 4.0, -0.069],
];

#[test]
fn cubics_are_those_of_scipy() {
    let (micrometre, arcsecond) = (1e-3, std::f64::consts::PI / 648_000.0);
    for (table, unit, expected) in [(0, micrometre, &STRAIGHTNESS[..]), (1, arcsecond, &PITCH[..])] {
        let spec = spec();
        let table = spec.tables[table].lookup();
        for [x, value, slope] in expected {
            assert!((table.value(*x) - unit * value).abs() < 1e-13 * unit * 31.0, "{x}");
            assert!((table.derivative(1, *x) - unit * slope).abs() < 1e-13 * unit, "{x}");
        }
    }
}

/// Checks linear interpolation, point by point and by formula.
#[test]
fn lines_go_from_point_to_point() {
    let spec = spec();
    for table in [&spec.tables[2], &spec.tables[3]] {
        let lookup = table.lookup();
        for pair in table.points.windows(2) {
            let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
            for share in [0.0, 1e-9, 0.3, 0.5, 0.99, 1.0] {
                let (x, expected) = (x0 + share * (x1 - x0), y0 + share * (y1 - y0));
                assert!((lookup.value(x) - expected).abs() < 1e-15, "{x}");
            }
            assert!((lookup.derivative(1, 0.5 * (x0 + x1)) - (y1 - y0) / (x1 - x0)).abs() < 1e-15);
        }
    }
}

/// Returns points that crowd at one end: more of them in a bucket than one comparison can separate.
fn crowded(interpolation: &str) -> Spec {
    let x: Vec<String> = (0..1000).map(|k| format!("{:e}", 2000.0 * 0.985_f64.powi(999 - k))).collect();
    let y: Vec<String> = (0..1000).map(|k| format!("{}", (f64::from(k) / 50.0).sin())).collect();
    let table = format!(
        "x = {{ values = [{}], unit = \"mm\" }}\ny = {{ values = [{}], unit = \"mm\" }}\ninterpolation = \"{interpolation}\"\noutside = \"hold\"",
        x.join(", "),
        y.join(", ")
    );
    Spec::parse("crowded.toml", &slide(&table, "Tx(sag(d1)) Ty(d1)", "[0, 2000]")).unwrap()
}

/// Compares every table with a linear search through its points.
#[test]
fn the_piece_is_that_of_a_plain_search() {
    let (measured, lines, cubics) = (spec(), crowded("linear"), crowded("cubic"));
    for table in measured.tables.iter().chain(&lines.tables).chain(&cubics.tables) {
        let (lookup, [first, last]) = (table.lookup(), table.ends());
        let mut all: Vec<f64> = (0..5000).map(|i| first + halton(i, 0) * (last - first)).collect();
        all.extend(table.points.iter().flat_map(|[x, _]| [x.next_down(), *x, x.next_up()]));
        for x in all.into_iter().filter(|x| (first..=last).contains(x)) {
            let k = table.points.windows(2).position(|pair| x <= pair[1][0]).unwrap();
            let [[x0, y0], [x1, y1]] = [table.points[k], table.points[k + 1]];
            // Values and slopes at both ends, in the Hermite basis.
            let (h, tau) = (x1 - x0, (x - x0) / (x1 - x0));
            let slope = |order, x: f64| lookup.derivative::<f64>(order, x);
            let [d0, d1] = match table.degree() {
                1 => [y1 - y0; 2],
                _ => [h * slope(1, x0 + 1e-12 * h), h * slope(1, x1 - 1e-12 * h)],
            };
            let (a, b) = (tau * tau * (3.0 - 2.0 * tau), tau * (1.0 - tau));
            let expected = (1.0 - a) * y0 + a * y1 + b * ((1.0 - tau) * d0 - tau * d1);
            let size = table.points.iter().fold(0.0, |size: f64, [_, y]| size.max(y.abs()));
            assert!((lookup.value(x) - expected).abs() <= 1e-10 * size, "{} at {x}", table.name);
        }
    }
}

#[test]
fn derivatives_are_slopes() {
    for table in spec().tables.iter().chain(&crowded("cubic").tables) {
        let (lookup, [first, last]) = (table.lookup(), table.ends());
        for i in 0..2000 {
            let x = first + halton(i, 0) * (last - first);
            let step = 1e-5 * (last - first);
            let of_one_piece = table.points.iter().all(|[knot, _]| (x - knot).abs() > step);
            for order in (1..=3).filter(|_| of_one_piece) {
                let lower =
                    |x: f64| if order == 1 { lookup.value(x) } else { lookup.derivative(order - 1, x) };
                let found = (lower(x + step) - lower(x - step)) / (2.0 * step);
                let size = lookup.derivative(order, x).abs() + lower(x).abs() / (last - first);
                // The central difference of a cubic has the error h² f'''/6.
                let error = if order == 1 { lookup.derivative(3, x).abs() * step * step / 6.0 } else { 0.0 };
                let difference = (lookup.derivative(order, x) - found).abs();
                assert!(difference <= 1e-8 * size + 1.01 * error, "{} order {order} at {x}", table.name);
            }
        }
    }
}

/// Sums the values and slopes of a table in lanes, each number by itself.
struct InLanes<'a>(&'a LookupTable<'a>, &'a [f64]);

impl Kernel for InLanes<'_> {
    type Output = Vec<[f64; 2]>;

    fn run<R: Register>(self) -> Self::Output {
        let mut found = Vec::new();
        for x in self.1.chunks(R::WIDTH) {
            let lanes = Lanes::<R>::from_fn(|lane| x[lane.min(x.len() - 1)]);
            let (value, slope) = (self.0.value(lanes), self.0.derivative(1, lanes));
            let pairs = value.as_slice().iter().zip(slope.as_slice());
            found.extend(pairs.take(x.len()).map(|(value, slope)| [*value, *slope]));
        }
        found
    }
}

#[test]
fn lanes_are_single_evaluations() {
    let (measured, crowded) = (spec(), crowded("cubic"));
    for table in measured.tables.iter().chain(&crowded.tables) {
        let (lookup, [first, last]) = (table.lookup(), table.ends());
        let mut x: Vec<f64> =
            (0..4003).map(|i| first + (1.4 * halton(i, 1) - 0.2) * (last - first)).collect();
        x.extend(table.points.iter().flat_map(|[x, _]| [x.next_down(), *x, x.next_up()]));
        x.extend([f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300]);
        for set in InstructionSet::all() {
            for (x, [value, slope]) in x.iter().zip(set.run(InLanes(&lookup, &x))) {
                for (found, expected) in [(value, lookup.value(*x)), (slope, lookup.derivative(1, *x))] {
                    // Products and sums are rounded once or twice.
                    let near = (found - expected).abs()
                        <= 1e-13
                            * table
                                .points
                                .iter()
                                .fold(0.0, |size: f64, [_, y]| size.max(y.abs()))
                                .max(expected.abs());
                    assert!(near || found.is_nan() && expected.is_nan(), "{} at {x} by {set:?}", table.name);
                }
            }
        }
    }
}

#[test]
fn what_is_beyond_the_ends() {
    let spec = spec();
    let held = spec.tables[1].lookup();
    for (x, expected) in [(-1e9, 12.0), (-1e-9, 12.0), (2000.1, 4.0), (1e300, 4.0)] {
        assert!((held.value(x) * 648_000.0 / std::f64::consts::PI - expected).abs() < 1e-12);
        assert_eq!(held.derivative(1, x), 0.0);
    }
    let not = spec.tables[0].lookup();
    for x in [-1e-9, -1.0, 2000.0001, 1e300, f64::NAN] {
        assert!(not.value(x).is_nan() && not.derivative(1, x).is_nan(), "{x}");
    }
    assert!([0.0_f64, 2000.0].iter().all(|end| not.value(*end).is_finite()), "ends belong to it");
    // A configuration outside the limits returns an error.
    let (s, u) = (measured::Parameters::NOMINAL, measured::Inputs::NOMINAL);
    let robot = Interpreter::new(spec.clone());
    let expected = Err(Error::NotFinite { quantity: Quantity::Pose, index: 11 });
    assert_eq!(measured::pose(&[2000.5, 0.0, 0.0], &s).map(|_| ()), expected);
    assert_eq!(robot.pose(&[2000.5, 0.0, 0.0], &s.to_array()).map(|_| ()), expected);
    let errors = measured::generalized_errors(&[-0.5, 0.0, 0.0], &s, &u);
    assert!(matches!(errors, Err(Error::NotFinite { quantity: Quantity::Errors, index: 1 })), "{errors:?}");
}

#[test]
fn compiled_and_interpreted_obey_the_laws_and_agree() {
    all(&measured::Measured, SAMPLES).unwrap();
    let robot = Interpreter::new(spec());
    all(&robot, SAMPLES).unwrap();
    let description = robot.description();
    assert_eq!(description, measured::Measured.description());
    let (s, u) = (nominal_parameters(description), nominal_inputs(description));
    for i in 0..1000 {
        let q: Vec<f64> = description
            .variables
            .iter()
            .enumerate()
            .map(|(k, variable)| {
                let [low, high] = variable.limits;
                low + halton(i, k) * (high - low)
            })
            .collect();
        let mut columns = [vec![[0.0; 6]; 18], vec![[0.0; 6]; 18]];
        let mut errors = [vec![[0.0; 6]; 3], vec![[0.0; 6]; 3]];
        let robots: [&dyn Manipulator; 2] = [&robot, &measured::Measured];
        for (robot, (columns, errors)) in robots.into_iter().zip(columns.iter_mut().zip(&mut errors)) {
            robot.error_jacobian(&q, &s, columns).unwrap();
            robot.generalized_errors(&q, &s, &u, errors).unwrap();
        }
        let pairs = [&columns, &errors];
        for [a, b] in pairs {
            let largest = a.as_flattened().iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
            for (a, b) in a.as_flattened().iter().zip(b.as_flattened()) {
                assert!((a - b).abs() <= 4.0 * f64::EPSILON * largest, "{a} and {b} at {q:?}");
            }
        }
    }
}

/// Returns the function `f(q1)` of a fixed chain, from its pose.
fn value_of(expression: &str, q: f64) -> Result<f64, Error> {
    let text = format!(
        "[manipulator]\nname = \"arm\"\nlength = \"m\"\n[[frame]]\nname = \"a\"\n\
         variable = {{ name = \"q1\", kind = \"revolute\" }}\ntransform = \"Tx(({expression})*1 m) Rz(q1)\"\n"
    );
    let spec = Spec::parse("arm.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    Ok(Interpreter::new(spec).pose(&[q], &[])?.position()[0])
}

#[test]
fn functions_have_their_values() {
    for (expression, expected) in [
        ("min(q1, 0.5)", 0.5),
        ("max(q1, 0.5)", 0.7),
        ("min(3, q1, 2*q1, 0.9)", 0.7),
        ("max(-q1, -2, -1)", -0.7),
        ("sign(q1 - 1)", -1.0),
        ("sign(q1 - q1)", 0.0),
        ("exp(q1)", 2.013_752_707_470_476_5),
        ("log(q1)", -0.356_674_943_938_732_4),
        ("log(exp(q1))", 0.7),
        ("min(1, 2)*q1", 0.7),
        ("3 / min(q1, 2)", 3.0 / 0.7),
        ("2 min * q1/(1 min)", 1.4),
        ("50 % * q1", 0.35),
    ] {
        let found = value_of(expression, 0.7).unwrap();
        assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(), "{expression}: {found}");
    }
    let not_finite = Err(Error::NotFinite { quantity: Quantity::Pose, index: 9 });
    for expression in ["log(q1)", "log(q1 + 0.7)", "min(log(q1), 1)", "max(1, log(q1))", "exp(-1e5*q1)"] {
        assert_eq!(value_of(expression, -0.7), not_finite, "{expression}");
    }
}

/// Copies the spec and its table file to a folder.
fn copied(folder: &Path) {
    for file in ["measured.toml", "rail.csv"] {
        fs::copy(specs::path("measured").with_file_name(file), folder.join(file)).unwrap();
    }
}

#[test]
fn the_file_of_a_table_is_part_of_its_spec() {
    let (folder, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    copied(folder.path());
    let files = compile_into(folder.path(), out.path()).unwrap();
    assert!(files.contains(&folder.path().join("rail.csv")), "a build script watches it: {files:?}");
    let read = || Spec::read(folder.path().join("measured.toml")).unwrap();
    let (before, text) = (read(), fs::read_to_string(folder.path().join("measured.toml")).unwrap());
    assert_eq!(print::rust(&before), print::rust(&spec()), "whatever the folder is called");
    let rail = fs::read_to_string(folder.path().join("rail.csv")).unwrap();
    fs::write(folder.path().join("rail.csv"), rail.replace("22,20.4", "23,20.4")).unwrap();
    let after = read();
    assert_ne!(before.hash, after.hash);
    assert_ne!(before.tables[0].points, after.tables[0].points);
    let mistakes = Spec::parse("measured.toml", &text).unwrap_err().to_string();
    assert!(
        mistakes
            .contains("cannot read `rail.csv`: this spec is not in a file, so relative paths have no folder"),
        "{mistakes}"
    );
    let parsed = Spec::parse_in(folder.path(), "measured.toml", &text).unwrap();
    assert_eq!(parsed.hash, after.hash);
}

/// Checks that a mistake in the table file is shown with its line.
#[test]
fn mistakes_in_a_file_have_their_line() {
    let folder = tempfile::tempdir().unwrap();
    copied(folder.path());
    let rail = fs::read_to_string(folder.path().join("rail.csv")).unwrap();
    let mistakes = |rail: &[u8]| {
        fs::write(folder.path().join("rail.csv"), rail).unwrap();
        Spec::read(folder.path().join("measured.toml")).unwrap_err().to_string()
    };
    for (from, to, expected) in [
        ("300,31", "300,NaN", "line 4 of `rail.csv`: `dz` is not a number"),
        ("300,31", "300,", "line 4 of `rail.csv`: `dz` is not a number"),
        ("300,31", "300,3l", "found `3l`"),
        ("340,30", "300,30", "line 5 of `rail.csv`: x is the same as in the row before"),
        ("340,30", "290,30", "line 5 of `rail.csv`: x turns back"),
        ("d1,dz", "d1,d_z", "`rail.csv` has no column `dz`"),
        ("300,31,20.2", "300,31", "`rail.csv` is not a table: line 4: expected 3 cells, found 2"),
    ] {
        let shown = mistakes(rail.replace(from, to).as_bytes());
        assert!(shown.contains(expected) && shown.contains("help"), "{shown}");
    }
    let semicolons = mistakes(rail.replace(',', ";").replace('.', ",").as_bytes());
    let form = "separate cells by commas, and use a decimal point";
    assert!(semicolons.contains(form), "{semicolons}");
    assert!(mistakes(b"d1;dz\n1;2\n").contains(form));
    assert!(mistakes(b"d1,dz\n").contains("has no points"));
    assert!(mistakes(b"d1,dz\n1,2\n").contains("has one point"));
    assert!(mistakes(b"").contains("no column `d1`"));
    assert!(mistakes(b"d1,dz\n1,\xff\n").contains("is not a table: line 2 is not UTF-8 text"));
    fs::remove_file(folder.path().join("rail.csv")).unwrap();
    let shown = Spec::read(folder.path().join("measured.toml")).unwrap_err().to_string();
    assert!(shown.contains("cannot read `rail.csv`") && shown.contains("relative to the folder"), "{shown}");
}

/// Checks that rows may be in descending order, as from a rail measured on the way back.
#[test]
fn descending_points_are_turned() {
    let folder = tempfile::tempdir().unwrap();
    copied(folder.path());
    let rail = fs::read_to_string(folder.path().join("rail.csv")).unwrap();
    let (head, rows) = rail.split_once('\n').unwrap();
    let turned: Vec<&str> = rows.lines().rev().collect();
    fs::write(folder.path().join("rail.csv"), format!("{head}\n{}\n", turned.join("\n"))).unwrap();
    let found = Spec::read(folder.path().join("measured.toml")).unwrap();
    assert_eq!(found.tables[0].points, spec().tables[0].points);
    assert_eq!(found.tables[0].derivative(1, 1234.0), spec().tables[0].derivative(1, 1234.0));
}

/// Checks that an argument that is not a plain variable is sampled, and that configurations beyond
/// the table are a mistake.
#[test]
fn arguments_are_tried_out() {
    let table = "x = [\"0 mm\", \"5 mm\", \"9 mm\"]\ny = [0, 1, 3]\ninterpolation = \"linear\"";
    let read = |argument: &str, limits: &str| {
        Spec::parse("slide.toml", &slide(table, &format!("Tx(d1) Rx(sag({argument}))"), limits))
    };
    for (argument, limits) in [
        ("d1", "[0, 9]"),
        ("9 mm - d1", "[0, 9]"),
        ("max(0 mm, min(d1, 9 mm))", "[-100, 100]"),
        ("4.5 mm * (1 + sin(d1/(1 mm)))", "[-100, 100]"),
        ("7 mm", "[0, 1]"),
    ] {
        assert!(read(argument, limits).is_ok(), "{argument} in {limits}");
    }
    for (argument, limits, shown) in [
        ("d1", "[0, 9.001]", "the argument goes from 0 mm to 9.001 mm"),
        ("d1", "[-1, 9]", "the argument goes from -1 mm to 9 mm"),
        ("10 mm - d1", "[0, 9]", "the argument goes from 1 mm to 10 mm"),
        ("4.6 mm * (1 + sin(d1/(1 mm)))", "[-100, 100]", "the argument goes from"),
        ("9.5 mm", "[0, 1]", "this is 9.5 mm"),
    ] {
        let mistakes = read(argument, limits).unwrap_err().to_string();
        assert!(mistakes.contains(shown) && mistakes.contains("outside = \"hold\""), "{mistakes}");
    }
    let endless = slide(table, "Tx(d1) Rx(sag(d1))", "[0, 1]").replace(", limits = [0, 1]", "");
    assert!(
        Spec::parse("slide.toml", &endless).unwrap_err().to_string().contains("the argument has no limits")
    );
}

/// Checks derivatives where they do not exist: one of the two sides, stated in the header.
#[test]
fn derivatives_are_one_sided() {
    let header = print::rust(&spec());
    let header = header.split("pub mod").next().unwrap().replace("\n/// ", " ");
    for place in [
        "frame 1: at the ends of `pitch`",
        "where the argument of `sign` is 0",
        "at the points of `stretch`",
        "where the argument of `abs` is 0",
        "where the arguments of `max` are equal",
        "frame 3: at the points of `torque`, where the arguments of `min` are equal",
    ] {
        assert!(header.contains(place), "{place} is missing in {header}");
    }
    let slope = |expression: &str| {
        let text = format!(
            "[manipulator]\nname = \"arm\"\nlength = \"m\"\n[[frame]]\nname = \"a\"\n\
             variable = {{ name = \"q1\", kind = \"revolute\" }}\ntransform = \"Rz(q1) Tx(({expression})*1 m)\"\n"
        );
        let mut columns = [[0.0; 6]];
        Interpreter::new(Spec::parse("arm.toml", &text).unwrap())
            .joint_jacobian(&[0.0], &[], &mut columns)
            .unwrap();
        columns[0][0]
    };
    for (expression, sides) in [
        ("abs(q1)", [-1.0, 1.0]),
        ("abs(-2*q1)", [-2.0, 2.0]),
        ("min(3*q1, q1)", [1.0, 3.0]),
        ("max(3*q1, -q1)", [-1.0, 3.0]),
        ("max(q1, 0)", [0.0, 1.0]),
        ("sign(q1)", [0.0, 0.0]),
    ] {
        let found = slope(expression);
        assert!(sides.contains(&found), "{expression}: {found}");
    }
}
