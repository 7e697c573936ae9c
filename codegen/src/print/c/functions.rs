//! Prints routines as functions.

use abbe_core::Description;
use abbe_core::function::Signature;
use abbe_spec::Spec;

use super::operators::C;
use super::real::Real;
use crate::print::expression::Value;
use crate::print::flat::{Flat, filled};
use crate::print::layout::Writer;
use crate::print::statement::Statement;
use crate::print::statements::Statements;
use crate::print::text::harmless;
use crate::program::{ArrayRows, Role, Routine, Routines, Row};

/// Returns the head of a function without its end: `int pps_pose(const double *restrict q, …)`.
pub(super) fn head(prefix: &str, signature: &Signature, real: Real, restrict: &str) -> String {
    let given = signature.arguments.iter().map(|array| (array.name, Role::Argument));
    let filled = signature.results.iter().map(|array| (array.name, Role::Result));
    format!("int {prefix}_{}({})", signature.name, arguments(given.chain(filled), real, restrict))
}

/// Returns the head of a helper function.
fn helper_head(prefix: &str, routine: &Routine, real: Real) -> String {
    let arrays = routine.arrays.iter().map(|array| (array.name, array.role));
    format!("static void {prefix}_{}({})", routine.name, arguments(arrays, real, "restrict"))
}

fn arguments(arrays: impl Iterator<Item = (&'static str, Role)>, real: Real, restrict: &str) -> String {
    let restrict = if restrict.is_empty() { String::new() } else { format!("{restrict} ") };
    let outside = arrays.filter_map(|(name, role)| match role {
        Role::Argument => Some(format!("const {real} *{restrict}{name}")),
        Role::Result => Some(format!("{real} *{restrict}{name}")),
        Role::Margin | Role::Zeros => None,
    });
    outside.collect::<Vec<_>>().join(", ")
}

/// Prints the documentation of a declaration, with additional status codes and a closing paragraph
/// if given.
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
    let takes_inputs = signature.arguments.iter().any(|array| array.name == "u");
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
        Some(function) => head(prefix, function.signature(), real, "restrict"),
        None => helper_head(prefix, routine, real),
    });
    writer.open_alone();
    let mut printer = Printer { writer, flat: Flat { routines, routine }, prefix, real };
    printer.begin(&used, !list.is_empty());
    list.iter().for_each(|statement| printer.statement(statement));
    let margin = list.iter().find_map(|statement| match statement {
        // The status code of the called function covers its margin.
        Statement::Return(value) if value != "margin" => Some(value.as_str()),
        _ => None,
    });
    printer.end(margin);
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

    /// Prints the beginning of a body: marks unused arguments and checks the ranges of inputs.
    fn begin(&mut self, used: &[bool], some: bool) {
        let outside = self.flat.routine.arrays.iter().enumerate();
        let outside = outside.filter(|(_, array)| matches!(array.role, Role::Argument | Role::Result));
        for (index, array) in outside {
            let is_checked =
                self.flat.routine.function.is_some() && (array.name == "u" || array.role == Role::Result);
            if self.flat.len(index) == 0 || !(used[index] && some || is_checked) {
                self.writer.lines(&format!("(void){};", array.name));
            }
        }
        let takes_inputs =
            |(index, array): (usize, &crate::program::Array)| array.name == "u" && self.flat.len(index) > 0;
        if self.flat.routine.function.is_some()
            && self.flat.routine.arrays.iter().enumerate().any(takes_inputs)
        {
            let upper = self.upper();
            self.writer.open("if (inputs_are_in_range(u) == 0)");
            self.writer.lines(&format!("return {upper}_OUT_OF_RANGE;"));
            self.writer.close("}");
        }
    }

    /// Prints the checks of the results and the return statement.
    fn end(&mut self, margin: Option<&str>) {
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
        let results: Vec<String> = (0..routine.arrays.len())
            .filter(|array| routine.arrays[*array].role == Role::Result && self.flat.len(*array) > 0)
            .map(|array| format!("is_finite({}, {}) != 0", self.name(array), self.flat.len(array)))
            .collect();
        match &results[..] {
            [] => self.writer.lines(&format!("return {upper}_OK;")),
            results => {
                let all = results.join(" && ");
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
            Statement::SinCos(pairs) => {
                for ([sine, cosine], angle) in pairs {
                    self.writer.lines(&format!("{real} {sine};"));
                    self.writer.lines(&format!("{real} {cosine};"));
                    self.writer.lines(&format!("sin_cos({}, &{sine}, &{cosine});", angle.text));
                }
            }
            Statement::Declare(array) => self.declare(*array),
            // Arrays are cleared where they are declared.
            Statement::Clear(_) => {}
            Statement::Copy { from, to } => {
                let [first, _] = self.flat.range(*from);
                let (from, to, len) = (self.name(from.array), self.name(*to), self.flat.len(*to));
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
                // Results and local arrays have been initialized with zeros.
                let is_result = self.flat.routine.arrays[to.array].role == Role::Result;
                let values = values.iter().enumerate().filter(|(_, value)| !(is_result && value.is_zero));
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

    /// Declares a local array, or clears a result that has entries that are not written.
    fn declare(&mut self, array: usize) {
        match self.flat.routine.arrays[array].role {
            Role::Zeros => self.zeros(array),
            _ if self.has_zeros(array) => self.clear(array),
            _ => {}
        }
    }

    /// Declares a local array of zeros.
    fn zeros(&mut self, array: usize) {
        let (real, name, len) = (self.real, self.name(array), self.flat.len(array));
        self.writer.lines(&format!("{real} {name}[{len}] = {{ {} }};", real.number(0.0)));
    }

    /// Returns `true` if a result has entries that are not written.
    fn has_zeros(&self, array: usize) -> bool {
        use crate::program::{Block, Operand, Stage};
        let Flat { routine, routines } = self.flat;
        let zeros = |block: &Block| {
            let mut outputs = block.program.outputs.iter();
            block.writes.iter().any(|place| {
                let len = routine.arrays[place.array].place_len(place.row, &routines.description);
                let is_zero = |output: &Operand| *output == Operand::Constant(0.0);
                let some = outputs.by_ref().take(len).fold(false, |some, output| some | is_zero(output));
                some && place.array == array
            })
        };
        let whole = |block: &Block| {
            block.writes.iter().any(|place| place.array == array && place.row == Row::All) && !zeros(block)
        };
        !routine.stages.iter().any(|stage| match stage {
            Stage::Block(block) => whole(block),
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
