//! A self-test that compares the functions, as compiled for the target, with values computed by the
//! generator.

use std::collections::BTreeSet;
use std::ops::Range;

use abbe_core::Function;
use abbe_core::function::{Array, COMPENSATED, Signature};
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::real::Real;
use super::support::Support;
use crate::chain::Model;
use crate::graph::Node;
use crate::print::layout::Writer;
use crate::program::{Program, Rounded, Routines, locals, results, straight_line};

pub(super) fn declaration(writer: &mut Writer, spec: &Spec) {
    writer.blank();
    writer.lines("/**");
    writer.documentation(
        "Self-test for the target: evaluates every function at one configuration and compares weighted sums of the results \
         with those of the generator, within the bound of the rounding errors of all operations. Then it gives every \
         function infinity and NaN in the place of each argument, which have to be refused.",
    );
    writer.documentation_line("");
    writer.documentation(
        "@return 0; the number of the first wrong function, counted from 1 in the order of the source; -1 if the compiler \
         or the processor does not compute with infinity and NaN or not in the order of the source; -2 if sines are wrong.",
    );
    writer.lines(" */");
    writer.lines(&format!("int {}_self_test(void);", spec.name));
}

pub(super) fn definition(
    writer: &mut Writer,
    spec: &Spec,
    model: &Model,
    routines: &Routines,
    used: &BTreeSet<Support>,
    real: Real,
) {
    let mut template = |text: &str| {
        writer.blank();
        let numbers = [("ROUND", real.rounder()), ("BOUND", real.number(4.0 * real.unit_roundoff()))];
        let text = numbers.iter().fold(real.text(text), |text, (word, number)| text.replace(word, number));
        writer.lines(text.trim_end());
    };
    template(SUMS_TO);
    template(FOLLOWS_IEEE);
    let has_sines = used.contains(&Support::SinCos);
    if has_sines {
        template(SINES_ARE_RIGHT);
    }
    let several = [(Support::SinCosTwo, 2), (Support::SinCosFour, 4)];
    let several: Vec<usize> =
        several.into_iter().filter(|(support, _)| used.contains(support)).map(|(_, count)| count).collect();
    for count in &several {
        template(&SEVERAL_ARE_RIGHT.replace("COUNT", &count.to_string()));
    }
    let functions: Vec<Function> = routines.list.iter().filter_map(|routine| routine.function).collect();
    let given = where_most_has_a_value(spec, model, &functions, real);
    let taken = Taken::new(routines, &given);
    writer.blank();
    writer.lines(&format!("int {}_self_test(void)", spec.name));
    writer.open_alone();
    if has_sines {
        sines(writer, real);
    }
    let entries: Vec<String> = taken.values.iter().map(|value| real.number(*value)).collect();
    // C has no empty arrays.
    let (len, zero) = (entries.len(), [real.number(0.0)]);
    let entries = if entries.is_empty() { &zero[..] } else { &entries[..] };
    writer.braces(&format!("{real} given[{}] = ", len.max(1)), entries, ";");
    for (name, range) in &taken.ranges {
        writer.lines(&format!("const {real} *const given_{name} = &given[{}];", range.start));
    }
    writer.lines(&format!("volatile {real} infinity = {};", real.number(f64::INFINITY)));
    writer.lines("if (follows_ieee() == 0) {\n    return -1;\n}");
    if has_sines {
        let further = several.iter().map(|count| format!(" || sines_by_{count}_are_right(sines) == 0"));
        let further: String = further.collect();
        writer.lines(&format!("if (sines_are_right(sines) == 0{further}) {{\n    return -2;\n}}"));
    }
    writer.lines("/* First the numbers as they are, then with one of them infinite or NaN. */");
    writer.open(&format!("for (int trial = -1; trial < {}; trial++)", 2 * len));
    writer.lines("const int at = (trial < 0) ? 0 : (trial / 2);");
    writer.lines(&format!("const {real} kept = given[at];"));
    writer.open("if (trial >= 0)");
    writer.lines("given[at] = ((trial % 2) == 0) ? infinity : (infinity - infinity);");
    writer.close("}");
    for (index, function) in functions.into_iter().enumerate() {
        let known = |sum: &Rounded| sum.value.is_finite() && sum.bound.is_finite();
        let sums = values(&given, model, function).map(|values| sums(&given, model, function, &values, real));
        let signature = function.signature();
        let is_right = match &sums {
            Some(sums) if sums.iter().all(|(_, sum)| known(sum)) => sums_to(signature, spec, sums, real),
            _ => {
                let name = function.name();
                writer.lines(&format!("/* `{name}` is not finite at this configuration. */"));
                vec![]
            }
        };
        one(writer, routines, &taken, signature, [&is_right, &[]], index + 1, real);
    }
    if routines.has_compensated() {
        let upper = spec.name.to_ascii_uppercase();
        let results = COMPENSATED.results.iter();
        let finite = results.map(|array| {
            let (name, len) = (array.name, array.len(&routines.description));
            format!("are_below({name}, {len}, {}) != 0", real.number(f64::INFINITY))
        });
        let finite: Vec<String> = finite.collect();
        let status = [format!("(status == {upper}_OK || status >= {upper}_NOT_CONVERGED)")];
        let number = routines.list.iter().filter(|routine| routine.function.is_some()).count() + 1;
        one(writer, routines, &taken, &COMPENSATED, [&finite, &status], number, real);
    }
    writer.lines("given[at] = kept;");
    writer.close("}");
    writer.lines("return 0;");
    writer.close("}");
}

/// Arguments that the functions take, one after the other in one array.
struct Taken {
    values: Vec<f64>,
    ranges: Vec<(&'static str, Range<usize>)>,
}

impl Taken {
    fn new(routines: &Routines, given: &Given) -> Self {
        let functions = routines.list.iter().filter_map(|routine| routine.function).map(Function::signature);
        let compensated = Some(&COMPENSATED).filter(|_| routines.has_compensated());
        let mut arguments = functions.chain(compensated).flat_map(|signature| signature.arguments);
        let count = routines.description.variables.len();
        let cycle = [("last", vec![0.0; count]), ("rotations", vec![1.0; 3])];
        let mut taken = Self { values: Vec::new(), ranges: Vec::new() };
        let arrays: Vec<&'static str> = arguments.by_ref().map(|array| array.name).collect();
        for (name, values) in given.iter().chain(&cycle) {
            if arrays.contains(name) && !values.is_empty() {
                let start = taken.values.len();
                taken.values.extend(values);
                taken.ranges.push((name, start..taken.values.len()));
            }
        }
        taken
    }

    /// Returns the condition that a function takes number `at`.
    fn condition(&self, signature: &Signature) -> String {
        let mut merged: Vec<Range<usize>> = Vec::new();
        for (name, range) in &self.ranges {
            if signature.arguments.iter().any(|array| array.name == *name) {
                match merged.last_mut() {
                    Some(last) if last.end == range.start => last.end = range.end,
                    _ => merged.push(range.clone()),
                }
            }
        }
        let condition = |Range { start, end }: &Range<usize>| match start {
            0 => format!("at < {end}"),
            start => format!("(at >= {start} && at < {end})"),
        };
        merged.iter().map(condition).collect::<Vec<_>>().join(" || ")
    }
}

/// Prints angles of both signs in every quadrant, two of them large, with their sines and cosines.
fn sines(writer: &mut Writer, real: Real) {
    let range = match real {
        Real::Double => 1e5,
        Real::Float => 6e3,
    };
    let [near, far] = [0.93 * range, -1.2 * range];
    let angles = [0.1, -0.7, 0.78, 1.9, -2.3, 2.9, -3.7, 5.1, near, far, 0.5, -6.2];
    let row = |angle: f64| {
        let angle = real.nearest(angle);
        format!("{{ {} }}", [angle, angle.sin(), angle.cos()].map(|value| real.number(value)).join(", "))
    };
    let head = format!("static const {real} sines[{}][3] = ", angles.len());
    writer.braces(&head, &angles.map(row), ";");
}

/// Values of every argument, by name.
type Given = [(&'static str, Vec<f64>); 7];

/// Returns the first of a few configurations at which the most functions have finite values.
fn where_most_has_a_value(spec: &Spec, model: &Model, functions: &[Function], real: Real) -> Given {
    let count = |given: &Given| functions.iter().filter(|f| values(given, model, **f).is_some()).count();
    let tried = (0..16).map(|start| given(spec, model, start, real));
    let mut best: Option<(usize, Given)> = None;
    for given in tried {
        let found = count(&given);
        if best.as_ref().is_none_or(|(most, _)| found > *most) {
            best = Some((found, given));
        }
        if found == functions.len() {
            break;
        }
    }
    best.map_or_else(|| given(spec, model, 0, real), |(_, given)| given)
}

/// Returns the results of a function, array by array. Returns `None` near a singularity of Euler
/// angles, or if a number is not finite.
fn values(given: &Given, model: &Model, function: Function) -> Option<Vec<Vec<f64>>> {
    let values = |array: usize, nodes: &[Node]| {
        let locals = locals_of(given, model, function, array, 0.0);
        model.graph.evaluate(nodes, |symbol| match symbol {
            Symbol::Local(i) => locals.get(i).map_or(f64::NAN, |local| local.value),
            symbol => value_of(given, function, symbol),
        })
    };
    let (arrays, margin) = results(function, model);
    let margin = margin.map_or(1.0, |node| values(0, &[node])[0]);
    let arrays: Vec<Vec<f64>> =
        arrays.iter().enumerate().map(|(array, nodes)| values(array, nodes)).collect();
    let all_finite = arrays.iter().flatten().all(|value| value.is_finite());
    (margin >= 0.1 && margin.is_finite() && all_finite).then_some(arrays)
}

/// Returns the local symbols that an array of the results reads. The pose of a step of the
/// compensator is the real one, everything else is nominal.
fn locals_of(given: &Given, model: &Model, function: Function, array: usize, unit: f64) -> Vec<Rounded> {
    let function = match (function, array) {
        (Function::CompensatorStep, 0) => Function::RealPose,
        _ => function,
    };
    locals(function, model, |symbol| value_of(given, function, symbol), unit)
}

fn value_of(given: &Given, function: Function, symbol: Symbol) -> f64 {
    match symbol {
        Symbol::Variable(k) => given[0].1[k],
        Symbol::Parameter(k) => given[1].1[k],
        Symbol::Input(k) => given[2].1[k],
        Symbol::Error(k) if function == Function::Covariance => given[4].1[k],
        Symbol::Error(k) => given[3].1[k],
        Symbol::Magnitude(k) => given[5].1[k],
        Symbol::Target(k) => given[6].1[k],
        Symbol::Passive(_) | Symbol::Local(_) => f64::NAN,
    }
}

/// Returns, for each result, its length and the sum of its elements weighted 1 to 7 cyclically,
/// with a bound of the rounding errors of the function and of the sum. The generator's own values
/// are rounded as doubles.
fn sums(
    given: &Given,
    model: &Model,
    function: Function,
    arrays: &[Vec<f64>],
    real: Real,
) -> Vec<(usize, Rounded)> {
    let units = [real, Real::Double].map(Real::unit_roundoff);
    // The arrays of a tree of frames may read different passive variables.
    let programs = match model.loops.is_some() {
        true => results(function, model).0.iter().map(|nodes| Program::new(&model.graph, nodes)).collect(),
        false => vec![straight_line(function, model)],
    };
    let [mut here, mut there] = units.map(|unit| {
        let rounded = |(array, program): (usize, &Program)| {
            let locals = locals_of(given, model, function, array, unit);
            let symbol = |symbol| match symbol {
                Symbol::Local(i) => locals.get(i).copied().unwrap_or(Rounded::exact(f64::NAN, unit)),
                symbol => Rounded::exact(value_of(given, function, symbol), unit),
            };
            program.rounded(model.graph.tables(), symbol, unit)
        };
        programs.iter().enumerate().flat_map(rounded).collect::<Vec<_>>().into_iter()
    });
    let sum = |numbers: &mut dyn Iterator<Item = Rounded>, unit| {
        let weighted =
            numbers.enumerate().map(|(k, number)| Rounded::exact((k % 7 + 1) as f64, unit) * number);
        weighted.fold(Rounded::exact(0.0, unit), |sum, term| sum + term)
    };
    let one = |array: &Vec<f64>| {
        let mut here = sum(&mut here.by_ref().take(array.len()), units[0]);
        let there = sum(&mut there.by_ref().take(array.len()), units[1]);
        // The expected value is rounded as well.
        here.bound += there.bound + units[0] * there.value.abs();
        (array.len(), here)
    };
    arrays.iter().map(one).collect()
}

/// Returns the conditions that the results have the expected sums.
fn sums_to(signature: &Signature, spec: &Spec, sums: &[(usize, Rounded)], real: Real) -> Vec<String> {
    let sum = |(array, (len, sum)): (&Array, &(usize, Rounded))| {
        let [value, bound] = [sum.value, upwards(sum.bound)].map(|value| real.number(value));
        format!("sums_to({}, {len}, {value}, {bound}) != 0", array.name)
    };
    let some = signature.results.iter().zip(sums).filter(|(_, (len, _))| *len > 0);
    let is_ok = format!("status == {}_OK", spec.name.to_ascii_uppercase());
    [is_ok].into_iter().chain(some.map(sum)).collect()
}

/// Prints the test of one function: conditions on its results, and that wrong arguments are
/// refused.
fn one(
    writer: &mut Writer,
    routines: &Routines,
    taken: &Taken,
    signature: &Signature,
    conditions: [&[String]; 2],
    number: usize,
    real: Real,
) {
    let description = &routines.description;
    let (name, upper) = (&description.name, description.name.to_ascii_uppercase());
    let some = |array: &&Array| !array.is_empty(description);
    writer.open_alone();
    for array in signature.results.iter().filter(some) {
        writer.lines(&format!("{real} {}[{}];", array.name, array.len(description)));
    }
    let given = |array: &Array| match array.name {
        "change" | "largest" => format!("{name}_{}", array.name),
        other => format!("given_{other}"),
    };
    let arguments = signature.arguments.iter().filter(some).map(given);
    let results = signature.results.iter().filter(some).map(|array| array.name.to_owned());
    let arrays: Vec<String> = arguments.chain(results).collect();
    let call = format!("{name}_{}({})", signature.name, arrays.join(", "));
    writer.lines(&format!("const int status = {call};"));
    let right = conditions.concat().join(" && ");
    let refused = taken.condition(signature);
    if !right.is_empty() {
        writer.open(&format!("if (trial < 0 && !({right}))"));
        writer.lines(&format!("return {number};"));
        writer.close("}");
    }
    if !refused.is_empty() {
        writer.open(&format!("if (trial >= 0 && ({refused}) && status != {upper}_NOT_FINITE)"));
        writer.lines(&format!("return {number};"));
        writer.close("}");
    }
    writer.close("}");
}

/// Rounds a bound up to two digits.
fn upwards(bound: f64) -> f64 {
    let text = format!("{:.1e}", bound * 1.05);
    text.parse().unwrap_or(bound)
}

/// Returns values of every argument; each `start` gives different ones.
fn given(spec: &Spec, model: &Model, start: usize, real: Real) -> Given {
    let share = |k: usize| 0.1 + 0.8 * ((start + k + 1) as f64 * 0.618_033_988_749_894_9).fract();
    let between = |k: usize, [lower, upper]: [f64; 2], otherwise: f64| {
        let value = lower + share(k) * (upper - lower);
        if value.is_finite() { value } else { otherwise }
    };
    let variables = spec.variables.iter().enumerate();
    let inputs = spec.inputs.iter().enumerate();
    let errors = 6 * spec.frames.len();
    let q = |from: usize| -> Vec<f64> {
        variables.clone().map(|(k, variable)| between(from + k, variable.limits, variable.home)).collect()
    };
    let given: Given = [
        ("q", q(0)),
        ("s", spec.parameters.iter().map(|parameter| parameter.value).collect()),
        ("u", inputs.map(|(k, input)| between(k, input.range, input.value)).collect()),
        ("errors", (0..errors).map(|k| 1e-3 * (share(k) - 0.5)).collect()),
        ("variances", (0..errors).map(|k| 1e-6 * share(k)).collect()),
        ("magnitudes", (0..spec.enabled_sources().count()).map(|k| 2.0 * share(k) - 1.0).collect()),
        ("target", pose(spec, model, &q(9))),
    ];
    given.map(|(name, values)| (name, values.into_iter().map(|value| real.nearest(value)).collect()))
}

/// Returns the pose of a machine with inverse kinematics in closed form; nothing for others.
fn pose(spec: &Spec, model: &Model, q: &[f64]) -> Vec<f64> {
    let (arrays, _) = results(Function::Pose, model);
    let nodes = if model.solutions() > 0 { arrays.concat() } else { Vec::new() };
    model.graph.evaluate(&nodes, |symbol| match symbol {
        Symbol::Variable(k) => q[k],
        Symbol::Parameter(k) => spec.parameters[k].value,
        _ => f64::NAN,
    })
}

const SUMS_TO: &str = "\
/* Returns 1 if the sum of the numbers weighted 1 to 7 cyclically is as expected up to rounding, else 0. */
static int sums_to(const double *numbers, int count, double expected, double rounding)
{
    double sum = 0.0;
    for (int k = 0; k < count; k++) {
        sum += (double)(k % 7 + 1) * numbers[k];
    }
    return (fabs(sum - expected) <= rounding) ? 1 : 0;
}
";

const FOLLOWS_IEEE: &str = "\
/* Returns 1 if infinity and NaN are recognized, and sums are computed in the order of the source, else 0. */
static int follows_ieee(void)
{
    volatile double infinity = HUGE_VAL;
    volatile double fraction = 0.4;
    const double not_finite[2] = { infinity, infinity - infinity };
    const double rounded = (fraction + ROUND) - ROUND;
    const int is_refused = (are_below(not_finite, 1, HUGE_VAL) == 0 && are_below(&not_finite[1], 1, HUGE_VAL) == 0) ? 1 : 0;
    return (is_refused != 0 && isnan(not_finite[1]) != 0 && fabs(rounded) < 0.25) ? 1 : 0;
}
";

const SINES_ARE_RIGHT: &str = "\
/* Returns 1 if a sine and a cosine are as expected, else 0. */
static int is_right(const double expected[3], double s, double c)
{
    return (fabs(s - expected[1]) <= BOUND && fabs(c - expected[2]) <= BOUND) ? 1 : 0;
}

/* Returns 1 if the sine and cosine of each of twelve angles are as expected, else 0. */
static int sines_are_right(const double expected[12][3])
{
    int all = 1;
    for (int k = 0; k < 12; k++) {
        double s;
        double c;
        sin_cos(expected[k][0], &s, &c);
        all *= is_right(expected[k], s, c);
    }
    return all;
}
";

const SEVERAL_ARE_RIGHT: &str = "\
static int sines_by_COUNT_are_right(const double expected[12][3])
{
    int all = 1;
    for (int k = 0; k < 12; k += COUNT) {
        double x[COUNT];
        double s[COUNT];
        double c[COUNT];
        for (int i = 0; i < COUNT; i++) {
            x[i] = expected[k + i][0];
        }
        sin_cos_COUNT(x, s, c);
        for (int i = 0; i < COUNT; i++) {
            all *= is_right(expected[k + i], s[i], c[i]);
        }
    }
    return all;
}
";
