//! A self-test that compares the functions, as compiled for the target, with values computed by the
//! generator.

use std::collections::BTreeSet;

use abbe_core::function::{Array, COMMANDS, COMPENSATED, Signature};
use abbe_core::{Description, Function};
use abbe_spec::Spec;

use super::commands::{Call, Commands};
use super::expected::{Sums, expected};
use super::procedures::CPrinter;
use super::real::Real;
use super::support::Support;
use crate::chain::Model;
use crate::print::layout::Writer;
use crate::print::procedure::Printer;
use crate::program::{Rounded, Routines};

pub(super) fn declaration(writer: &mut Writer, spec: &Spec) {
    writer.blank();
    writer.lines("/**");
    writer.documentation(
        "Self-test for the target: evaluates every function at one configuration and corrected commands at several, and \
         compares weighted sums of the results with those of the generator, within the bound of the rounding errors of all \
         operations. Then it gives every \
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
    let mut wrong_sines = Vec::new();
    for (support, count, call) in [
        (Support::SinCos, "1", "sin_cos(sines[k]"),
        (Support::SinCosTwo, "2", "sin_cos_2(&sines[k]"),
        (Support::SinCosFour, "4", "sin_cos_4(&sines[k]"),
    ] {
        if used.contains(&support) {
            template(&SINES_ARE_RIGHT.replace("COUNT", count).replace("SIN_COS(sines[k]", call));
            wrong_sines.push(format!("sines_by_{count}_are_right(sines) == 0"));
        }
    }
    let functions: Vec<Function> = routines.list.iter().filter_map(|routine| routine.function).collect();
    let (given, sums) = expected(spec, model, &functions, real);
    let upper = &spec.name.to_ascii_uppercase();
    let conditions = |(function, sums): (Function, Option<Sums>)| {
        let signature = function.signature();
        (signature, sums.map_or_else(Vec::new, |sums| sums_to(signature, upper, &sums, real)))
    };
    let commands = Commands::new(&routines.description, model, &given, real);
    let signatures = COMMANDS.into_iter().filter(|signature| routines.exported.contains(&signature.name));
    let calls: Vec<_> = signatures.map(|signature| (signature, commands.calls(signature))).collect();
    let numbers = calls.iter().map(|(one, _)| (*one, is_valid(one, &routines.description, upper, real)));
    let tested = functions.into_iter().zip(sums).map(conditions);
    let tested: Vec<(&Signature, Vec<String>)> = tested.chain(numbers).collect();
    let takes =
        |signature: &Signature, name: &str| signature.arguments.iter().any(|array| array.name == name);
    let is_taken = |name: &str| tested.iter().any(|(signature, _)| takes(signature, name));
    let taken: Vec<_> = given.iter().filter(|(name, list)| !list.is_empty() && is_taken(name)).collect();
    let values = taken.iter().flat_map(|(_, list)| list);
    let mut values: Vec<String> = values.map(|value| real.number(*value)).collect();
    // C has no empty arrays.
    values.extend(values.is_empty().then(|| real.number(0.0)));
    writer.blank();
    writer.lines(&format!("int {}_self_test(void)", spec.name));
    writer.open_alone();
    let mut printer = CPrinter { writer, routines, real };
    if !wrong_sines.is_empty() {
        printer.numbers("sines", &sines(real).map(|value| real.number(value)));
    }
    printer.writer.braces(&format!("{real} given[{}] = ", values.len()), &values, ";");
    let mut end = 0;
    let mut ranges = Vec::new();
    for (name, list) in taken {
        printer.writer.lines(&format!("const {real} *const given_{name} = &given[{end}];"));
        ranges.push((name, format!("(at >= {end} && at < {})", end + list.len())));
        end += list.len();
    }
    printer.writer.lines(&format!("volatile {real} infinity = {};", real.number(f64::INFINITY)));
    printer.leave("follows_ieee() == 0", -1);
    if !wrong_sines.is_empty() {
        printer.leave(&wrong_sines.join(" || "), -2);
    }
    printer.comment("First the numbers as they are, then with one of them infinite or NaN.");
    printer.writer.open(&format!("for (int trial = -1; trial < {}; trial++)", 2 * end));
    printer.writer.lines("const int at = (trial < 0) ? 0 : (trial / 2);");
    printer.writer.lines(&format!("const {real} kept = given[at];"));
    printer.guard("trial >= 0", "given[at] = ((trial % 2) == 0) ? infinity : (infinity - infinity);");
    for (index, (signature, conditions)) in tested.iter().enumerate() {
        let refused = ranges.iter().filter(|(name, _)| takes(signature, name)).map(|(_, range)| &range[..]);
        printer.test(signature, conditions, &refused.collect::<Vec<_>>(), index + 1);
    }
    for (number, (signature, calls)) in (tested.len() + 1 - calls.len()..).zip(&calls) {
        printer.cases(signature, calls, number);
    }
    writer.lines("given[at] = kept;");
    writer.close("}");
    writer.lines("return 0;");
    writer.close("}");
}

impl CPrinter<'_> {
    /// Prints the test of one function: conditions on its results, and that wrong arguments are
    /// refused.
    fn test(&mut self, signature: &Signature, conditions: &[String], refused: &[&str], number: usize) {
        let (description, real) = (&self.routines.description, self.real);
        let name = &description.name;
        let some = |array: &&Array| !array.is_empty(description);
        let given = |array: &Array| match array.name {
            "change" | "largest" => format!("{name}_{}", array.name),
            other => format!("given_{other}"),
        };
        let given = signature.arguments.iter().filter(some).map(given);
        let results = signature.results.iter().filter(some);
        let arrays: Vec<String> = given.chain(results.clone().map(|array| array.name.to_owned())).collect();
        self.writer.open_alone();
        for array in results {
            self.writer.lines(&format!("{real} {}[{}];", array.name, array.len(description)));
        }
        let call = format!("{name}_{}({})", signature.name, arrays.join(", "));
        self.writer.lines(&format!("const int status = {call};"));
        match &conditions.join(" && ")[..] {
            "" => self.comment(&format!("`{}` is not finite at this configuration.", signature.name)),
            right => self.leave(&format!("trial < 0 && !({right})"), number),
        }
        if !refused.is_empty() {
            let (refused, status) = (refused.join(" || "), self.code("NOT_FINITE"));
            self.leave(&format!("trial >= 0 && ({refused}) && status != {status}"), number);
        }
        self.writer.close("}");
    }

    /// Prints the calls of a corrected command, or of where one begins, within several bounds.
    fn cases(&mut self, signature: &Signature, calls: &[Call], number: usize) {
        let (description, real) = (&self.routines.description, self.real);
        let Some(first) = calls.first() else { return };
        self.writer.open("if (trial < 0)");
        let mut list = |name: &str, numbers: &mut dyn Iterator<Item = f64>| {
            let numbers: Vec<String> = numbers.map(|number| real.number(number)).collect();
            self.writer.braces(&format!("static const {real} {name}[{}] = ", numbers.len()), &numbers, ";");
        };
        let sums = || calls.iter().flat_map(|call| &call.sums);
        list("calls", &mut calls.iter().flat_map(|call| call.row.iter().copied()));
        list("expected", &mut sums().map(|[sum, _]| *sum));
        list("tolerances", &mut sums().map(|[_, tolerance]| upwards(*tolerance)));
        let statuses = calls.iter().map(|call| self.code(call.status.name())).collect::<Vec<_>>();
        self.writer.braces(&format!("static const int statuses[{}] = ", calls.len()), &statuses, ";");
        let (results, mut wrong) = (signature.results, String::new());
        for (i, Array { name, .. }) in results.iter().enumerate() {
            let len = results[i].len(description);
            let at = format!("[({} * k) + {i}]", results.len()).replace(" + 0", "");
            self.writer.lines(&format!("{real} {name}[{len}];"));
            wrong += &format!("\n        || sums_to({name}, {len}, expected{at}, tolerances{at}) == 0");
        }
        let given = signature.arguments.iter().filter(|array| matches!(array.name, "s" | "u"));
        let given = given.filter(|array| !array.is_empty(description));
        let (bounds, called) = match *signature == COMPENSATED {
            true => (real.text(BOUNDS), "compensated(&row[7], GIVENfirst, change, largest, row, RESULTS)"),
            false => (String::new(), "begin(&row[7], GIVENrow, RESULTS)"),
        };
        let text = [
            ("    BOUNDS\n", bounds),
            ("CASES", calls.len().to_string()),
            ("WIDTH", first.row.len().to_string()),
            ("COUNT", description.variables.len().to_string()),
            ("CALLED", called.to_owned()),
            ("GIVEN", given.map(|array| format!("given_{}, ", array.name)).collect()),
            ("RESULTS", results.iter().map(|array| array.name).collect::<Vec<_>>().join(", ")),
            ("SUMS", wrong),
            ("NUMBER", number.to_string()),
            ("UPPER", description.name.to_ascii_uppercase()),
            ("NAME", description.name.to_string()),
        ];
        let text = text.iter().fold(real.text(CASES), |text, (word, with)| text.replace(word, with));
        self.writer.lines(text.trim_end());
        self.writer.close("}");
    }
}

const CASES: &str = include_str!("commands.c");

const BOUNDS: &str = include_str!("bounds.c");

/// Returns angles of both signs in every quadrant, two of them large, then their sines, then their
/// cosines.
fn sines(real: Real) -> [f64; 36] {
    let range = match real {
        Real::Double => 1e5,
        Real::Float => 6e3,
    };
    let [near, far] = [0.93 * range, -1.2 * range];
    let angles = [0.1, -0.7, 0.78, 1.9, -2.3, 2.9, -3.7, 5.1, near, far, 0.5, -6.2];
    let angles = angles.map(|angle| real.nearest(angle));
    std::array::from_fn(|k| [|x| x, f64::sin, f64::cos][k / 12](angles[k % 12]))
}

/// Returns the conditions that the results have the expected sums.
fn sums_to(signature: &Signature, upper: &str, sums: &Sums, real: Real) -> Vec<String> {
    let sum = |(array, (len, sum)): (&Array, &(usize, Rounded))| {
        let [value, bound] = [sum.value, upwards(sum.bound)].map(|value| real.number(value));
        format!("sums_to({}, {len}, {value}, {bound}) != 0", array.name)
    };
    let some = signature.results.iter().zip(sums).filter(|(_, (len, _))| *len > 0);
    [format!("status == {upper}_OK")].into_iter().chain(some.map(sum)).collect()
}

/// Returns the conditions that the results of a corrected command are finite, and its status one
/// of those with results.
fn is_valid(signature: &Signature, description: &Description, upper: &str, real: Real) -> Vec<String> {
    let infinity = real.number(f64::INFINITY);
    let finite =
        |array: &Array| format!("are_below({}, {}, {infinity}) != 0", array.name, array.len(description));
    let status = format!("(status == {upper}_OK || status >= {upper}_NOT_CONVERGED)");
    signature.results.iter().map(finite).chain([status]).collect()
}

/// Rounds a bound up to two digits.
fn upwards(bound: f64) -> f64 {
    let text = format!("{:.1e}", bound * 1.05);
    text.parse().unwrap_or(bound)
}

const SUMS_TO: &str = include_str!("sums_to.c");

const FOLLOWS_IEEE: &str = include_str!("follows_ieee.c");

const SINES_ARE_RIGHT: &str = include_str!("sines_are_right.c");
