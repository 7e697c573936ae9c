//! Prints routines as functions.

use abbe_core::{Description, function::Signature};
use abbe_spec::Spec;

use super::{CPrinter, RESTRICT, Real, broken, comment, operators::C};
use crate::print::routine::statements;
use crate::print::{Flat, Printer, Statement, Statements, Writer, filled, sizes};
use crate::program::{Array, Checks, Role, Routine, Routines};

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
fn head_of(
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
    broken(name, &declared)
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
        let shape = sizes(array, description).join(" x ");
        writer.documentation(&format!(
            "@param[{direction}] {} {} Size: {shape}. Unit: {}.",
            array.name, array.documentation, array.unit
        ));
    }
    let is_input = |array: &abbe_core::function::Array| array.name == "u" && !array.is_empty(description);
    let takes_inputs = signature.arguments.iter().any(is_input);
    let mut codes = vec!["OK", "NOT_FINITE"];
    codes.extend(description.has_loops().then_some("NOT_CLOSED"));
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
    let flat = Flat { routines, routine };
    let Statements { list, used, .. } = Statements::new(spec, flat, &C { spec, real });
    writer.blank();
    if routine.function.is_none() {
        comment(writer, routine.documentation);
    }
    writer.lines(&match routine.function {
        Some(function) => head(routines, function.signature(), real, RESTRICT),
        None => helper_head(routines, routine, real),
    });
    writer.open_alone();
    let checks = routines.checks(routine, real.largest());
    let mut function = Function { printer: CPrinter { writer, routines, real }, flat };
    function.begin(&used, !list.is_empty(), &checks);
    function.zeros(&list);
    let margin = statements(&mut function.printer, flat, &list);
    // The status code of the called function covers its margin.
    function.end(margin.filter(|margin| *margin != "margin"), &checks);
    writer.close("}");
}

/// More zeros than these take less room as a loop.
const LOOP: usize = 12;

/// The checks of a function.
struct Function<'p> {
    printer: CPrinter<'p>,
    flat: Flat<'p>,
}

impl Function<'_> {
    fn name(&self, array: usize) -> &'static str {
        self.flat.routine.arrays[array].name
    }

    /// Prints the beginning of a body: marks unused arguments, and checks the arguments.
    fn begin(&mut self, used: &[bool], some: bool, checks: &Checks) {
        let is_function = self.flat.routine.function.is_some();
        let outside = self.flat.routine.arrays.iter().enumerate();
        let outside = outside.filter(|(_, array)| matches!(array.role, Role::Argument | Role::Result));
        for (index, array) in outside {
            let is_used = used[index] && some || is_function;
            if self.flat.len(index) > 0 && !is_used {
                self.printer.writer.lines(&format!("(void){};", array.name));
            }
        }
        if is_function {
            self.check_arguments(checks);
        }
    }

    /// Prints the zeros of results whose every element is assigned once: together, as compilers
    /// vectorize them, or as a loop over all elements if the code is to be small.
    fn zeros(&mut self, list: &[Statement]) {
        let Self { printer: CPrinter { writer, real, .. }, flat } = self;
        let once = |array: &usize| flat.keeps_zeros(*array) && flat.begins_whole(*array);
        for array in (0..flat.routine.arrays.len()).filter(once) {
            let (name, zero) = (flat.routine.arrays[array].name, real.number(0.0));
            let assigned = list.iter().filter_map(|statement| match statement {
                Statement::Assign { to, index, values, .. } if to.array == array => Some((to, index, values)),
                _ => None,
            });
            let places = assigned.flat_map(|(to, index, values)| {
                let zeros = values.iter().enumerate().filter(|(_, value)| value.is_zero);
                zeros.map(|(k, _)| flat.index(*to, *index, k, |_, _| String::new()))
            });
            let mut places: Vec<usize> = places.filter_map(|place| place.parse().ok()).collect();
            places.sort_unstable();
            let entries: Vec<_> = places.iter().map(|place| format!("{name}[{place}] = {zero}")).collect();
            let (len, is_long) = (flat.len(array), entries.len() > LOOP);
            let head = format!(
                "#if defined(__OPTIMIZE_SIZE__)\nfor (int k = 0; k < {len}; k++) {{\n    {name}[k] = {zero};\n}}\n#else"
            );
            writer.lines(if is_long { &head } else { "" });
            filled(writer, "", &entries, "; ");
            writer.lines(if is_long { "#endif" } else { "" });
        }
    }

    /// Prints the checks of the arguments that no called function checks.
    fn check_arguments(&mut self, checks: &Checks) {
        let mut wrong = self.below(&checks.arguments, f64::INFINITY, "== 0").join(" || ");
        if self.is_within(checks) {
            let arrays = &self.flat.routine.arrays;
            let all = (0..arrays.len()).filter(|array| arrays[*array].role == Role::Argument);
            let all: Vec<usize> = all.filter(|array| self.flat.len(*array) > 0).collect();
            let below = self.below(&all, checks.limit, "!= 0").join(" && ");
            self.printer.comment("Results need no check if no argument is huge.");
            self.printer.writer.lines(&format!("const int is_within = ({below}) ? 1 : 0;"));
            if !wrong.is_empty() {
                wrong = format!("is_within == 0 && {}", grouped(&wrong, " || "));
            }
        }
        if !wrong.is_empty() {
            self.printer.leave(&wrong, self.printer.code("NOT_FINITE"));
        }
        if checks.arguments.iter().any(|array| self.name(*array) == "u") {
            self.printer.leave("inputs_are_in_range(u) == 0", self.printer.code("OUT_OF_RANGE"));
        }
    }

    /// Returns `true` if results are finite because the arguments are not huge.
    fn is_within(&self, checks: &Checks) -> bool {
        let arrays = self.flat.routine.arrays.iter().enumerate();
        let mut given = arrays.filter(|(_, array)| array.role == Role::Argument);
        !checks.bounded.is_empty() && given.any(|(index, _)| self.flat.len(index) > 0)
    }

    /// Returns the comparisons of arrays with a limit.
    fn below(&self, arrays: &[usize], limit: f64, compared: &str) -> Vec<String> {
        let limit = self.printer.real.number(limit);
        let one = |array: &usize| {
            let (name, len) = (self.name(*array), self.flat.len(*array));
            format!("are_below({name}, {len}, {limit}) {compared}")
        };
        arrays.iter().map(one).collect()
    }

    /// Prints the checks of the results and the return statement.
    fn end(&mut self, margin: Option<&str>, checks: &Checks) {
        if self.flat.routine.function.is_none() {
            return;
        }
        let real = self.printer.real;
        let open = if self.flat.routines.description.has_loops() { "NOT_CLOSED" } else { "NOT_FINITE" };
        let [ok, not_finite, singular] = ["OK", open, "SINGULAR"].map(|name| self.printer.code(name));
        if let Some(margin) = margin {
            self.printer.writer.lines(&format!("const {real} margin = {margin};"));
            let value = format!("(isnan(margin) != 0) ? {not_finite} : {singular}");
            let least = real.number(abbe_core::MINIMUM_MARGIN);
            self.printer.leave(&format!("!(margin >= {least})"), value);
        }
        let mut conditions = self.below(&checks.unbounded, f64::INFINITY, "!= 0");
        if self.is_within(checks) {
            let bounded = self.below(&checks.bounded, f64::INFINITY, "!= 0").join(" && ");
            let either = format!("is_within != 0 || {}", grouped(&bounded, " && "));
            let either = if conditions.is_empty() { either } else { format!("({either})") };
            conditions.insert(0, either);
        }
        self.printer.writer.lines(&match &conditions.join(" && ")[..] {
            "" => format!("return {ok};"),
            all => format!("return ({all}) ? {ok} : {not_finite};"),
        });
    }
}

/// Returns joined conditions as an operand, in parentheses if they are several.
fn grouped(conditions: &str, sign: &str) -> String {
    if conditions.contains(sign) { format!("({conditions})") } else { conditions.to_owned() }
}
