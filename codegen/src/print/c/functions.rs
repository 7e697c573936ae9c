//! Prints routines as functions.

use abbe_core::Description;
use abbe_core::function::Signature;
use abbe_spec::Spec;

use super::operators::C;
use super::real::Real;
use crate::print::expression::{Expression, Value};
use crate::print::flat::{Flat, filled};
use crate::print::layout::{LINE, Writer, width};
use crate::print::statement::Statement;
use crate::print::statements::Statements;
use crate::print::text::harmless;
use crate::program::{Array, ArrayRows, Checks, Role, Routine, Routines, Row, Stage};

/// Macro of the sizes of arrays that must not overlap others.
pub(super) const RESTRICT: &str = "ABBE_RESTRICT";

/// Macro of the sizes of arrays that may overlap others.
pub(super) const SIZE: &str = "ABBE_SIZE";

/// Returns the head of a function without its end: `int pps_pose(const double q[ABBE_RESTRICT(6)],
/// …)`. `size` is the macro of the sizes of its arrays.
pub(super) fn head(routines: &Routines, signature: &Signature, real: Real, size: &str) -> String {
    let description = &routines.description;
    let given = signature.arguments.iter().map(|array| (array, Role::Argument));
    let filled = signature.results.iter().map(|array| (array, Role::Result));
    let arrays = given.chain(filled).map(|(array, role)| (array.name, role, array.len(description)));
    let local = if routines.exported.contains(&signature.name) { "" } else { "static " };
    head_of(&format!("{local}int {}_{}", description.name, signature.name), arrays, real, size)
}

/// Returns the head of a helper function.
fn helper_head(routines: &Routines, routine: &Routine, real: Real) -> String {
    let len = |array: &Array| array.len(&routines.description);
    let arrays = routine.arrays.iter().map(|array| (array.name, array.role, len(array)));
    head_of(&format!("static void {}_{}", routines.description.name, routine.name), arrays, real, RESTRICT)
}

/// Returns a head with the declarations of its arrays, on several lines if it is long. An array
/// without elements is no argument.
pub(super) fn head_of(
    name: &str,
    arrays: impl Iterator<Item = (&'static str, Role, usize)>,
    real: Real,
    size: &str,
) -> String {
    let declared = arrays.filter(|(.., len)| *len > 0).filter_map(|(name, role, len)| match role {
        Role::Argument => Some(format!("const {real} {name}[{size}({len})]")),
        Role::Result => Some(format!("{real} {name}[{size}({len})]")),
        Role::Margin | Role::Zeros => None,
    });
    let declared: Vec<String> = declared.collect();
    let line = format!("{name}({})", declared.join(", "));
    if width(&line) < LINE { line } else { format!("{name}(\n    {})", declared.join(",\n    ")) }
}

/// Prints the documentation of a declaration, with additional status codes and a closing paragraph
/// if given. An array without elements is no argument.
pub(super) fn documentation(
    writer: &mut Writer,
    description: &Description,
    signature: &Signature,
    further: &[&'static str],
    end: Option<&str>,
) {
    let upper = description.name.to_ascii_uppercase();
    writer.lines("/**");
    writer.documentation(signature.documentation);
    writer.documentation_line("");
    for (array, direction) in signature
        .arguments
        .iter()
        .map(|array| (array, "in"))
        .chain(signature.results.iter().map(|array| (array, "out")))
        .filter(|(array, _)| !array.is_empty(description))
    {
        let shape = array.shape.iter().map(|count| count.value(description).to_string());
        writer.documentation(&format!(
            "@param[{direction}] {} {} Size: {}. Unit: {}.",
            array.name,
            array.documentation,
            shape.collect::<Vec<_>>().join(" x "),
            array.unit
        ));
    }
    let is_input = |array: &abbe_core::function::Array| array.name == "u" && !array.is_empty(description);
    let takes_inputs = signature.arguments.iter().any(is_input);
    let mut codes = vec!["OK", "NOT_FINITE"];
    codes.extend(signature.has_margin(description.orientation).then_some("SINGULAR"));
    codes.extend(takes_inputs.then_some("OUT_OF_RANGE"));
    codes.extend(further);
    let codes: Vec<String> = codes.into_iter().map(|code| format!("`{upper}_{code}`")).collect();
    writer.documentation(&format!("@return {}.", codes.join(", ")));
    if let Some(end) = end {
        writer.documentation_line("");
        writer.documentation(&format!("{end}."));
    }
    writer.lines(" */");
}

/// Prints one function.
pub(super) fn function(writer: &mut Writer, spec: &Spec, routines: &Routines, routine: &Routine, real: Real) {
    let Statements { list, used, .. } =
        Statements::new(spec, &routines.description, routine, &C { spec, real });
    let prefix = &routines.description.name;
    writer.blank();
    if routine.function.is_none() {
        comment(writer, routine.documentation);
    }
    writer.lines(&match routine.function {
        Some(function) => head(routines, function.signature(), real, RESTRICT),
        None => helper_head(routines, routine, real),
    });
    writer.open_alone();
    let mut printer = Printer { writer, flat: Flat { routines, routine }, prefix, real };
    let checks = routines.checks(routine, real.largest());
    printer.begin(&used, !list.is_empty(), &checks);
    list.iter().for_each(|statement| printer.statement(statement));
    let margin = list.iter().find_map(|statement| match statement {
        // The status code of the called function covers its margin.
        Statement::Return(value) if value != "margin" => Some(value.as_str()),
        _ => None,
    });
    printer.end(margin, &checks);
    writer.close("}");
}

/// Prints a block comment.
pub(super) fn comment(writer: &mut Writer, text: &str) {
    writer.lines("/*");
    writer.documentation(text);
    writer.lines(" */");
}

struct Printer<'p> {
    writer: &'p mut Writer,
    flat: Flat<'p>,
    prefix: &'p str,
    real: Real,
}

impl Printer<'_> {
    fn place(&self, place: ArrayRows, index: usize, k: usize) -> String {
        let listed = |table: &str, column| format!("{table}[i][{column}]");
        format!("{}[{}]", self.name(place.array), self.flat.index(place, index, k, listed))
    }

    fn name(&self, array: usize) -> &'static str {
        self.flat.routine.arrays[array].name
    }

    fn upper(&self) -> String {
        self.prefix.to_ascii_uppercase()
    }

    /// Prints the beginning of a body: marks unused arguments, and checks the arguments.
    fn begin(&mut self, used: &[bool], some: bool, checks: &Checks) {
        let is_function = self.flat.routine.function.is_some();
        let outside = self.flat.routine.arrays.iter().enumerate();
        let outside = outside.filter(|(_, array)| matches!(array.role, Role::Argument | Role::Result));
        for (index, array) in outside {
            let is_used = used[index] && some || is_function;
            if self.flat.len(index) > 0 && !is_used {
                self.writer.lines(&format!("(void){};", array.name));
            }
        }
        if is_function {
            self.check_arguments(checks);
        }
    }

    /// Prints the checks of the arguments that no called function checks.
    fn check_arguments(&mut self, checks: &Checks) {
        let upper = self.upper();
        let all = (0..self.flat.routine.arrays.len())
            .filter(|array| self.flat.routine.arrays[*array].role == Role::Argument)
            .filter(|array| self.flat.len(*array) > 0);
        let mut wrong: Vec<String> =
            checks.arguments.iter().map(|array| self.below(*array, f64::INFINITY, "== 0")).collect();
        if self.is_within(checks) {
            let below: Vec<String> = all.map(|array| self.below(array, checks.limit, "!= 0")).collect();
            self.writer.lines("/* Results need no check if no argument is huge. */");
            self.writer.lines(&format!("const int is_within = ({}) ? 1 : 0;", below.join(" && ")));
            if !wrong.is_empty() {
                let several = if wrong.len() > 1 { ["(", ")"] } else { ["", ""] };
                let any = several.join(&wrong.join(" || "));
                wrong = vec![format!("is_within == 0 && {any}")];
            }
        }
        if !wrong.is_empty() {
            self.writer.open(&format!("if ({})", wrong.join(" || ")));
            self.writer.lines(&format!("return {upper}_NOT_FINITE;"));
            self.writer.close("}");
        }
        if checks.arguments.iter().any(|array| self.name(*array) == "u") {
            self.writer.open("if (inputs_are_in_range(u) == 0)");
            self.writer.lines(&format!("return {upper}_OUT_OF_RANGE;"));
            self.writer.close("}");
        }
    }

    /// Returns `true` if results are finite because the arguments are not huge.
    fn is_within(&self, checks: &Checks) -> bool {
        let arrays = self.flat.routine.arrays.iter().enumerate();
        let mut given = arrays.filter(|(_, array)| array.role == Role::Argument);
        !checks.bounded.is_empty() && given.any(|(index, _)| self.flat.len(index) > 0)
    }

    /// Returns the comparison of an array with a limit.
    fn below(&self, array: usize, limit: f64, compared: &str) -> String {
        let (name, len) = (self.name(array), self.flat.len(array));
        format!("are_below({name}, {len}, {}) {compared}", self.real.number(limit))
    }

    /// Prints the checks of the results and the return statement.
    fn end(&mut self, margin: Option<&str>, checks: &Checks) {
        let (Flat { routine, .. }, real) = (self.flat, self.real);
        if routine.function.is_none() {
            return;
        }
        let upper = self.upper();
        if let Some(margin) = margin {
            self.writer.lines(&format!("const {real} margin = {margin};"));
            self.writer.open(&format!("if (!(margin >= {}))", real.number(abbe_core::MINIMUM_MARGIN)));
            self.writer
                .lines(&format!("return (isnan(margin) != 0) ? {upper}_NOT_FINITE : {upper}_SINGULAR;"));
            self.writer.close("}");
        }
        let finite = |arrays: &[usize]| -> Vec<String> {
            arrays.iter().map(|array| self.below(*array, f64::INFINITY, "!= 0")).collect()
        };
        let mut conditions = finite(&checks.unbounded);
        if self.is_within(checks) {
            let bounded = finite(&checks.bounded);
            let several = if bounded.len() > 1 { ["(", ")"] } else { ["", ""] };
            let either = format!("is_within != 0 || {}", several.join(&bounded.join(" && ")));
            let either = if conditions.is_empty() { either } else { format!("({either})") };
            conditions.insert(0, either);
        }
        match &conditions[..] {
            [] => self.writer.lines(&format!("return {upper}_OK;")),
            all => {
                let all = all.join(" && ");
                self.writer.lines(&format!("return ({all}) ? {upper}_OK : {upper}_NOT_FINITE;"));
            }
        }
    }

    /// Prints a loop that fills an array with zeros.
    fn clear(&mut self, array: usize) {
        self.writer.open(&format!("for (int k = 0; k < {}; k++)", self.flat.len(array)));
        self.writer.lines(&format!("{}[k] = {};", self.name(array), self.real.number(0.0)));
        self.writer.close("}");
    }

    fn statement(&mut self, statement: &Statement) {
        let real = self.real;
        match statement {
            Statement::Unpack { names, from } => {
                let named = names.iter().enumerate().filter_map(|(k, name)| Some((k, name.as_ref()?)));
                for (k, name) in named {
                    self.writer.lines(&format!("const {real} {name} = {};", self.place(*from, 0, k)));
                }
            }
            Statement::Comment(text) => {
                self.writer.lines(&format!("/* {} */", harmless(text)));
            }
            Statement::Let { name, value } => self.writer.lines(&format!("const {real} {name} = {value};")),
            Statement::SinCos(pairs) => self.sines(pairs),
            Statement::Declare(array) => self.declare(*array),
            // Arrays are cleared where they are declared.
            Statement::Clear(_) => {}
            Statement::Copy { from, to, fresh } => {
                let [first, _] = self.flat.range(*from);
                let (from, to, len) = (self.name(from.array), self.name(*to), self.flat.len(*to));
                if *fresh {
                    self.writer.lines(&format!("{real} {to}[{len}];"));
                }
                let at = if first == 0 { "k".to_owned() } else { format!("{first} + k") };
                self.writer.open(&format!("for (int k = 0; k < {len}; k++)"));
                self.writer.lines(&format!("{to}[k] = {from}[{at}];"));
                self.writer.close("}");
            }
            Statement::Assign { to, values, fresh: true, .. } => {
                let values: Vec<&str> = values.iter().map(|value| value.text.as_str()).collect();
                let name = self.name(to.array);
                self.writer.braces(&format!("{real} {name}[{}] = ", values.len()), &values, ";");
            }
            Statement::Assign { to, index, values, fresh: false } => {
                // Results that are not written as a whole have been cleared.
                let is_cleared =
                    self.flat.routine.arrays[to.array].role == Role::Result && !self.is_whole(to.array);
                let values = values.iter().enumerate().filter(|(_, value)| !(is_cleared && value.is_zero));
                let entry =
                    |(k, value): (usize, &Value)| format!("{} = {}", self.place(*to, *index, k), value.text);
                let entries: Vec<String> = values.map(entry).collect();
                filled(self.writer, "", &entries, "; ");
            }
            Statement::Call { routine, arrays, fresh } => self.call(routine, arrays, fresh),
            Statement::Sums { sums, terms, entries } => {
                let sums = &self.flat.routines.sums[*sums];
                let [terms, entries] = [terms, entries].map(|array| self.name(*array));
                let (name, constants, factors) = (sums.name, sums.constants.len(), sums.factors.len());
                if constants > 0 {
                    self.writer.open(&format!("for (int k = 0; k < {constants}; k++)"));
                    self.writer.lines(&format!("{entries}[k] = {name}_CONSTANTS[k];"));
                    self.writer.close("}");
                }
                if factors > 0 {
                    self.writer.open(&format!("for (int k = 0; k < {factors}; k++)"));
                    let factor = format!("{name}_FACTORS[k] * {terms}[{name}_TERMS[k][1]]");
                    self.writer.lines(&format!("{entries}[{name}_TERMS[k][0]] += {factor};"));
                    self.writer.close("}");
                }
            }
            Statement::For { repeated, body } => {
                let count = repeated.count.value(&self.flat.routines.description);
                let head = match repeated.backwards {
                    false => format!("for (int i = 0; i < {count}; i++)"),
                    true => format!("for (int i = {}; i >= 0; i--)", count as i64 - 1),
                };
                self.writer.open(&head);
                body.iter().for_each(|statement| self.statement(statement));
                self.writer.close("}");
            }
            // `end` prints the return; columns go to arrays.
            Statement::Return(_) | Statement::Column { .. } => {}
        }
    }

    /// Prints sines and cosines: of four or two angles together, or of one.
    fn sines(&mut self, pairs: &[([String; 2], Expression)]) {
        let real = self.real;
        for name in pairs.iter().flat_map(|(names, _)| names) {
            self.writer.lines(&format!("{real} {name};"));
        }
        if let [([sine, cosine], angle)] = pairs {
            return self.writer.lines(&format!("sin_cos({}, &{sine}, &{cosine});", angle.text));
        }
        let len = pairs.len();
        let angles: Vec<&str> = pairs.iter().map(|(_, angle)| angle.text.as_str()).collect();
        self.writer.open_alone();
        self.writer.braces(&format!("const {real} angles[{len}] = "), &angles, ";");
        self.writer.lines(&format!("{real} sines[{len}];\n{real} cosines[{len}];"));
        let mut first = 0;
        while first < len {
            let count = [4, 2, 1].into_iter().find(|count| first + count <= len).unwrap_or(1);
            let at = |name: &str| if first == 0 { name.to_owned() } else { format!("&{name}[{first}]") };
            let (function, angles) = match count {
                1 => ("sin_cos".to_owned(), format!("angles[{first}]")),
                count => (format!("sin_cos_{count}"), at("angles")),
            };
            self.writer.lines(&format!("{function}({angles}, {}, {});", at("sines"), at("cosines")));
            first += count;
        }
        let assigned = pairs.iter().enumerate().flat_map(|(k, ([sine, cosine], _))| {
            [format!("{sine} = sines[{k}]"), format!("{cosine} = cosines[{k}]")]
        });
        filled(self.writer, "", &assigned.collect::<Vec<_>>(), "; ");
        self.writer.close("}");
    }

    /// Declares a local array, or clears a result that has entries that are not written.
    fn declare(&mut self, array: usize) {
        match self.flat.routine.arrays[array].role {
            Role::Zeros => self.zeros(array),
            _ if self.is_whole(array) => {}
            _ => self.clear(array),
        }
    }

    /// Declares a local array of zeros.
    fn zeros(&mut self, array: usize) {
        let (real, name, len) = (self.real, self.name(array), self.flat.len(array));
        self.writer.lines(&format!("{real} {name}[{len}] = {{ {} }};", real.number(0.0)));
    }

    /// Returns `true` if a stage writes all entries of a result.
    fn is_whole(&self, array: usize) -> bool {
        let whole = ArrayRows { array, row: Row::All };
        self.flat.routine.stages.iter().any(|stage| match stage {
            Stage::Block(block) => block.repeated.is_none() && block.writes.contains(&whole),
            Stage::Sums { entries, .. } => *entries == array,
            Stage::Copy { to, .. } => *to == array,
            _ => false,
        })
    }

    fn call(&mut self, routine: &str, arrays: &[usize], fresh: &[usize]) {
        let callee = self.flat.routines.named(routine);
        for array in fresh.iter().filter(|array| self.flat.routine.arrays[**array].role == Role::Zeros) {
            self.zeros(*array);
        }
        let given = arrays.iter().zip(&callee.arrays).filter(|(_, array)| array.role != Role::Margin);
        let given = given.filter(|(array, _)| self.flat.len(**array) > 0);
        let given: Vec<String> = given.map(|(array, _)| self.name(*array).to_owned()).collect();
        let given = given.join(", ");
        if callee.function.is_none() {
            self.writer.lines(&format!("{}_{routine}({given});", self.prefix));
            return;
        }
        let ok = format!("{}_OK", self.upper());
        self.writer.open_alone();
        self.writer.lines(&format!("const int status = {}_{routine}({given});", self.prefix));
        self.writer.open(&format!("if (status != {ok})"));
        self.writer.lines("return status;");
        self.writer.close("}");
        self.writer.close("}");
    }
}
