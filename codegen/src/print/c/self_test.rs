//! A self-test that compares the functions, as compiled for the target, with values computed by the
//! generator.

use abbe_core::Function;
use abbe_core::function::Array;
use abbe_spec::Spec;
use abbe_spec::expr::Symbol;

use super::real::Real;
use crate::chain::Model;
use crate::print::layout::Writer;
use crate::program::{Rounded, results, straight_line};

pub(super) fn declaration(writer: &mut Writer, spec: &Spec) {
    writer.blank();
    writer.lines("/**");
    writer.documentation(
        "Self-test for the target: evaluates every function at one configuration and compares weighted sums of the results \
         with those of the generator, within the bound of the rounding errors of all operations.",
    );
    writer.documentation_line("");
    writer.documentation(
        "@return 0, or the number of the first wrong function, counted from 1 in the order of this file.",
    );
    writer.lines(" */");
    writer.lines(&format!("int {}_self_test(void);", spec.name));
}

pub(super) fn definition(writer: &mut Writer, spec: &Spec, model: &Model, real: Real) {
    writer.blank();
    writer.lines(real.text(SUMS_TO).trim_end());
    writer.blank();
    writer.lines(&format!("int {}_self_test(void)", spec.name));
    writer.open_alone();
    let given = where_most_has_a_value(spec, model, real);
    for (name, values) in &given {
        let entries: Vec<String> = values.iter().map(|value| real.number(*value)).collect();
        // C has no empty arrays.
        let (len, zero) = (entries.len().max(1), [real.number(0.0)]);
        let entries = if entries.is_empty() { &zero[..] } else { &entries[..] };
        writer.braces(&format!("const {real} given_{name}[{len}] = "), entries, ";");
    }
    for (index, function) in Function::ALL.into_iter().enumerate() {
        let known = |sum: &Rounded| sum.value.is_finite() && sum.bound.is_finite();
        match values(&given, model, function).map(|values| sums(&given, model, function, &values, real)) {
            Some(sums) if sums.iter().all(|(_, sum)| known(sum)) => {
                one(writer, spec, function, index + 1, &sums, real);
            }
            _ => writer.lines(&format!("/* `{}` is not finite at this configuration. */", function.name())),
        }
    }
    // Arguments that no function takes.
    given.iter().for_each(|(name, _)| writer.lines(&format!("(void)given_{name};")));
    writer.lines("return 0;");
    writer.close("}");
}

/// Values of every argument, by name.
type Given = [(&'static str, Vec<f64>); 6];

/// Returns the first of a few configurations at which the most functions have finite values.
fn where_most_has_a_value(spec: &Spec, model: &Model, real: Real) -> Given {
    let count =
        |given: &Given| Function::ALL.into_iter().filter(|f| values(given, model, *f).is_some()).count();
    let tried = (0..16).map(|start| given(spec, start, real));
    let mut best: Option<(usize, Given)> = None;
    for given in tried {
        let found = count(&given);
        if best.as_ref().is_none_or(|(most, _)| found > *most) {
            best = Some((found, given));
        }
        if found == Function::ALL.len() {
            break;
        }
    }
    best.map_or_else(|| given(spec, 0, real), |(_, given)| given)
}

/// Returns the results of a function, array by array. Returns `None` near a singularity of Euler
/// angles, or if a number is not finite.
fn values(given: &Given, model: &Model, function: Function) -> Option<Vec<Vec<f64>>> {
    let symbol = |symbol| value_of(given, function, symbol);
    let (arrays, margin) = results(function, model);
    let margin = margin.map_or(1.0, |node| model.graph.evaluate(&[node], symbol)[0]);
    let arrays: Vec<Vec<f64>> = arrays.iter().map(|nodes| model.graph.evaluate(nodes, symbol)).collect();
    let all_finite = arrays.iter().flatten().all(|value| value.is_finite());
    (margin >= 0.1 && margin.is_finite() && all_finite).then_some(arrays)
}

fn value_of(given: &Given, function: Function, symbol: Symbol) -> f64 {
    match symbol {
        Symbol::Variable(k) => given[0].1[k],
        Symbol::Parameter(k) => given[1].1[k],
        Symbol::Input(k) => given[2].1[k],
        Symbol::Error(k) if function == Function::Covariance => given[4].1[k],
        Symbol::Error(k) => given[3].1[k],
        Symbol::Magnitude(k) => given[5].1[k],
        Symbol::Local(_) => f64::NAN,
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
    let program = straight_line(function, model);
    let [mut here, mut there] = units.map(|unit| {
        program.rounded(model.graph.tables(), |symbol| value_of(given, function, symbol), unit).into_iter()
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

/// Prints the test of one function: weighted sums of its results and their expected values.
fn one(
    writer: &mut Writer,
    spec: &Spec,
    function: Function,
    count: usize,
    sums: &[(usize, Rounded)],
    real: Real,
) {
    let signature = function.signature();
    writer.open_alone();
    for (array, (len, _)) in signature.results.iter().zip(sums) {
        // C has no empty arrays.
        match len {
            0 => writer.lines(&format!("{real} {}[1] = {{ {} }};", array.name, real.number(0.0))),
            len => writer.lines(&format!("{real} {}[{len}];", array.name)),
        }
    }
    let given = signature.arguments.iter().map(|array| format!("given_{}", array.name));
    let results = signature.results.iter().map(|array| array.name.to_owned());
    let names: Vec<String> = given.chain(results).collect();
    let (upper, call) = (spec.name.to_ascii_uppercase(), names.join(", "));
    writer
        .lines(&format!("int is_right = ({}_{}({call}) == {upper}_OK) ? 1 : 0;", spec.name, signature.name));
    let sum = |(array, (len, sum)): (&Array, &(usize, Rounded))| {
        let [value, bound] = [sum.value, upwards(sum.bound)].map(|value| real.number(value));
        format!("is_right *= sums_to({}, {len}, {value}, {bound});", array.name)
    };
    let some = signature.results.iter().zip(sums).filter(|(_, (len, _))| *len > 0);
    some.map(sum).for_each(|line| writer.lines(&line));
    writer.open("if (is_right == 0)");
    writer.lines(&format!("return {count};"));
    writer.close("}");
    writer.close("}");
}

/// Rounds a bound up to two digits.
fn upwards(bound: f64) -> f64 {
    let text = format!("{:.1e}", bound * 1.05);
    text.parse().unwrap_or(bound)
}

/// Returns values of every argument; each `start` gives different ones.
fn given(spec: &Spec, start: usize, real: Real) -> Given {
    let share = |k: usize| 0.1 + 0.8 * ((start + k + 1) as f64 * 0.618_033_988_749_894_9).fract();
    let between = |k: usize, [lower, upper]: [f64; 2], otherwise: f64| {
        let value = lower + share(k) * (upper - lower);
        if value.is_finite() { value } else { otherwise }
    };
    let variables = spec.variables.iter().enumerate();
    let inputs = spec.inputs.iter().enumerate();
    let errors = 6 * spec.frames.len();
    let given: Given = [
        ("q", variables.map(|(k, variable)| between(k, variable.limits, variable.home)).collect()),
        ("s", spec.parameters.iter().map(|parameter| parameter.value).collect()),
        ("u", inputs.map(|(k, input)| between(k, input.range, input.value)).collect()),
        ("errors", (0..errors).map(|k| 1e-3 * (share(k) - 0.5)).collect()),
        ("variances", (0..errors).map(|k| 1e-6 * share(k)).collect()),
        ("magnitudes", (0..spec.enabled_sources().count()).map(|k| 2.0 * share(k) - 1.0).collect()),
    ];
    given.map(|(name, values)| (name, values.into_iter().map(|value| real.nearest(value)).collect()))
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
