//! A function that holds the functions, as a target's compiler made them, against numbers of the generator.

use abbe::Function;
use abbe::function::Array;

use super::operators::number;
use crate::chain::Model;
use crate::expr::Symbol;
use crate::print::layout::Writer;
use crate::program::results;
use crate::spec::Spec;

pub(super) fn declaration(writer: &mut Writer, spec: &Spec) {
    writer.blank();
    writer.lines("/**");
    writer.documentation(
        "Evaluates every function that has a value at one configuration, and holds a weighted sum of its results against \
         that of the generator, to 1e-9 of its size: run it once on the target.",
    );
    writer.documentation_line("");
    writer.documentation("@return 0, or which function is wrong, counted from 1 in the order of this file.");
    writer.lines(" */");
    writer.lines(&format!("int {}_self_test(void);", spec.name));
}

pub(super) fn definition(writer: &mut Writer, spec: &Spec, model: &Model) {
    writer.blank();
    writer.lines(SUMS_TO.trim_end());
    writer.blank();
    writer.lines(&format!("int {}_self_test(void)", spec.name));
    writer.open_alone();
    let given = where_most_has_a_value(spec, model);
    for (name, values) in &given {
        let entries: Vec<String> = values.iter().map(|value| number(*value)).collect();
        // An array has one number at least.
        let (len, zero) = (entries.len().max(1), ["0.0".to_owned()]);
        let entries = if entries.is_empty() { &zero[..] } else { &entries[..] };
        writer.braces(&format!("const double given_{name}[{len}] = "), entries, ";");
    }
    for (index, function) in Function::ALL.into_iter().enumerate() {
        match values(&given, model, function) {
            Some(arrays) => one(writer, spec, function, index + 1, &arrays),
            None => writer.lines(&format!("/* `{}` has no value here. */", function.name())),
        }
    }
    // What no function takes.
    given.iter().for_each(|(name, _)| writer.lines(&format!("(void)given_{name};")));
    writer.lines("return 0;");
    writer.close("}");
}

/// Numbers for every argument, by their names.
type Given = [(&'static str, Vec<f64>); 6];

/// Of a few configurations the first at which as many functions as possible have values.
fn where_most_has_a_value(spec: &Spec, model: &Model) -> Given {
    let count =
        |given: &Given| Function::ALL.into_iter().filter(|f| values(given, model, *f).is_some()).count();
    let tried = (0..16).map(|start| given(spec, start));
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
    best.map_or_else(|| given(spec, 0), |(_, given)| given)
}

/// What a function gives, array by array; nothing near a singularity of Euler angles, or if a number is not finite.
fn values(given: &Given, model: &Model, function: Function) -> Option<Vec<Vec<f64>>> {
    let symbol = |symbol: Symbol| match symbol {
        Symbol::Variable(k) => given[0].1[k],
        Symbol::Parameter(k) => given[1].1[k],
        Symbol::Input(k) => given[2].1[k],
        Symbol::Error(k) if function == Function::Covariance => given[4].1[k],
        Symbol::Error(k) => given[3].1[k],
        Symbol::Magnitude(k) => given[5].1[k],
        Symbol::Local(_) => f64::NAN,
    };
    let (arrays, margin) = results(function, model);
    let margin = margin.map_or(1.0, |node| model.graph.evaluate(&[node], symbol)[0]);
    let arrays: Vec<Vec<f64>> = arrays.iter().map(|nodes| model.graph.evaluate(nodes, symbol)).collect();
    let all_finite = arrays.iter().flatten().all(|value| value.is_finite());
    (margin >= 0.1 && margin.is_finite() && all_finite).then_some(arrays)
}

/// One function: the weighted sums of what it gives, and what they must be.
fn one(writer: &mut Writer, spec: &Spec, function: Function, count: usize, arrays: &[Vec<f64>]) {
    let signature = function.signature();
    writer.open_alone();
    for (array, values) in signature.results.iter().zip(arrays) {
        // An array has one number at least.
        match values.len() {
            0 => writer.lines(&format!("double {}[1] = {{ 0.0 }};", array.name)),
            len => writer.lines(&format!("double {}[{len}];", array.name)),
        }
    }
    let given = signature.arguments.iter().map(|array| format!("given_{}", array.name));
    let results = signature.results.iter().map(|array| array.name.to_owned());
    let names: Vec<String> = given.chain(results).collect();
    let (upper, call) = (spec.name.to_ascii_uppercase(), names.join(", "));
    writer
        .lines(&format!("int is_right = ({}_{}({call}) == {upper}_OK) ? 1 : 0;", spec.name, signature.name));
    let sum = |(array, values): (&Array, &Vec<f64>)| {
        let weighted = values.iter().enumerate().map(|(k, value)| (k % 7 + 1) as f64 * value);
        let sum: f64 = weighted.sum();
        format!("is_right *= sums_to({}, {}, {});", array.name, values.len(), number(sum))
    };
    let some = signature.results.iter().zip(arrays).filter(|(_, values)| !values.is_empty());
    some.map(sum).for_each(|line| writer.lines(&line));
    writer.open("if (is_right == 0)");
    writer.lines(&format!("return {count};"));
    writer.close("}");
    writer.close("}");
}

/// Numbers for every argument; another `start` gives others.
fn given(spec: &Spec, start: usize) -> Given {
    let share = |k: usize| 0.1 + 0.8 * ((start + k + 1) as f64 * 0.618_033_988_749_894_9).fract();
    let between = |k: usize, [lower, upper]: [f64; 2], otherwise: f64| {
        let value = lower + share(k) * (upper - lower);
        if value.is_finite() { value } else { otherwise }
    };
    let variables = spec.variables.iter().enumerate();
    let inputs = spec.inputs.iter().enumerate();
    let errors = 6 * spec.frames.len();
    [
        ("q", variables.map(|(k, variable)| between(k, variable.limits, variable.home)).collect()),
        ("s", spec.parameters.iter().map(|parameter| parameter.value).collect()),
        ("u", inputs.map(|(k, input)| between(k, input.range, input.value)).collect()),
        ("errors", (0..errors).map(|k| 1e-3 * (share(k) - 0.5)).collect()),
        ("variances", (0..errors).map(|k| 1e-6 * share(k)).collect()),
        ("magnitudes", (0..spec.enabled_sources().count()).map(|k| 2.0 * share(k) - 1.0).collect()),
    ]
}

const SUMS_TO: &str = "\
/* 1 if the sum of the numbers times 1 to 7 in turn is as expected, but for 1e-9 of its size, else 0. */
static int sums_to(const double *numbers, int count, double expected)
{
    double sum = 0.0;
    double size = 0.0;
    for (int k = 0; k < count; k++) {
        const double weighted = (double)(k % 7 + 1) * numbers[k];
        sum += weighted;
        size += fabs(weighted);
    }
    return (fabs(sum - expected) <= 1e-9 * size) ? 1 : 0;
}
";
