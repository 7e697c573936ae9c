//! Prints routines as functions.

use abbe_core::function::{self, Signature};
use abbe_core::{Description, Quantity};
use abbe_spec::Spec;

use super::operators::{Python, number};
use crate::print::flat::Flat;
use crate::print::layout::Writer;
use crate::print::statement::Statement;
use crate::print::statements::Statements;
use crate::print::text::harmless;
use crate::program::{Array, ArrayRows, Role, Routine, Routines, Row};

/// Prints the public function, which checks shapes and gives the results their documented shapes.
/// `behind` is the name and documentation of an additional result.
pub(super) fn face(
    writer: &mut Writer,
    description: &Description,
    signature: &Signature,
    behind: Option<[&str; 2]>,
    end: Option<&str>,
) {
    let name = signature.name;
    let has_default = |name| matches!(name, "s" | "u" | "last" | "change" | "largest" | "rotations");
    let optional = signature.arguments.iter().all(|array| array.name == "q" || has_default(array.name));
    let arguments: Vec<String> = signature
        .arguments
        .iter()
        .map(|array| format!("{}{}", array.name, if optional && array.name != "q" { "=None" } else { "" }))
        .collect();
    writer.blank();
    writer.blank();
    writer.begin(&format!("def {name}({}):", arguments.join(", ")));
    documentation(writer, description, signature, behind, end);
    let shape = |array: &function::Array| {
        let counts: Vec<String> =
            array.shape.iter().map(|count| count.value(description).to_string()).collect();
        tuple(&counts)
    };
    let given = signature.arguments.iter().map(|array| format!("{0}=({0}, {1})", array.name, shape(array)));
    let names: Vec<&str> = signature.arguments.iter().map(|array| array.name).collect();
    let names = names.join(", ");
    writer.lines(&format!("batch, {names} = _given({})", given.collect::<Vec<_>>().join(", ")));
    let shaped = |array: &function::Array| {
        let mut order: Vec<String> = (0..array.shape.len()).map(|axis| axis.to_string()).collect();
        if is_matrix(array) {
            let last = order.len() - 1;
            order.swap(last - 1, last);
        }
        format!("_behind({}, {}, {}, batch)", array.name, shape(array), tuple(&order))
    };
    let behind = behind.map(|[name, _]| name);
    let results: Vec<&str> = signature.results.iter().map(|array| array.name).chain(behind).collect();
    writer.lines(&format!("{} = _{name}(batch, {names})", results.join(", ")));
    let returned: Vec<String> =
        signature.results.iter().map(shaped).chain(behind.map(str::to_owned)).collect();
    writer.lines(&format!("return {}", returned.join(", ")));
    writer.end();
}

/// Returns a tuple, which has a comma if it has one entry.
fn tuple(entries: &[String]) -> String {
    let comma = if entries.len() == 1 { "," } else { "" };
    format!("({}{comma})", entries.join(", "))
}

/// Name and documentation of the margin, which follows the results of a function.
pub(super) const MARGIN: [&str; 2] =
    ["margin", "`cos ρ`; where it is 0, the rows of the orientation are not finite."];

/// Returns `true` if the numbers of an array are columns of matrices.
fn is_matrix(array: &function::Array) -> bool {
    array.quantity == Quantity::Pose || array.name == "columns"
}

fn documentation(
    writer: &mut Writer,
    description: &Description,
    signature: &Signature,
    behind: Option<[&str; 2]>,
    end: Option<&str>,
) {
    writer.lines("r\"\"\"");
    writer.documentation(signature.documentation);
    writer.documentation_line("");
    let shape = |array: &function::Array| {
        let mut shape: Vec<String> =
            array.shape.iter().map(|count| count.value(description).to_string()).collect();
        if is_matrix(array) {
            let last = shape.len() - 1;
            shape.swap(last - 1, last);
        }
        format!("Shape (..., {}). Unit: {}.", shape.join(", "), array.unit)
    };
    for array in signature.arguments {
        writer.documentation(&format!("{}: {} {}", array.name, array.documentation, shape(array)));
    }
    writer.documentation_line("");
    let several = if signature.results.len() > 1 || behind.is_some() { ", in this order" } else { "" };
    writer.documentation(&format!("Returns{several}:"));
    for array in signature.results {
        writer.documentation(&format!("{}: {} {}", array.name, array.documentation, shape(array)));
    }
    if let Some([name, documentation]) = behind {
        writer.documentation(&format!("{name}: {documentation} Shape (...)."));
    }
    if let Some(end) = end {
        writer.documentation_line("");
        writer.documentation(&format!("{end}."));
    }
    writer.lines("\"\"\"");
}

/// Prints the routine on flat arrays, whose first axis counts their numbers: each number is an
/// array of the configurations, which NumPy runs through without strides.
pub(super) fn kernel(writer: &mut Writer, spec: &Spec, routines: &Routines, routine: &Routine) {
    let Statements { list, .. } =
        Statements::new(spec, &routines.description, routine, &Python(&spec.tables));
    let given = routine.arrays.iter().filter(|array| array.role == Role::Argument);
    let arguments: Vec<&str> = ["batch"].into_iter().chain(given.map(|array| array.name)).collect();
    writer.blank();
    writer.blank();
    writer.begin(&format!("def _{}({}):", routine.name, arguments.join(", ")));
    if routine.function.is_none() {
        writer.lines("r\"\"\"");
        writer.documentation(routine.documentation);
        writer.lines("\"\"\"");
    }
    let mut printer = Printer { writer, flat: Flat { routines, routine } };
    list.iter().for_each(|statement| printer.statement(statement));
    let margin = list.iter().find_map(|statement| match statement {
        Statement::Return(value) => Some(value.as_str()),
        _ => None,
    });
    printer.results(margin);
    writer.end();
}

struct Printer<'p> {
    writer: &'p mut Writer,
    flat: Flat<'p>,
}

impl Printer<'_> {
    fn name(&self, array: usize) -> &'static str {
        self.flat.routine.arrays[array].name
    }

    /// Returns element k of row `index` of a place, in every configuration.
    fn place(&self, place: ArrayRows, index: usize, k: usize) -> String {
        let listed = |table: &str, column| format!("{table}[i][{column}]");
        format!("{}[{}]", self.name(place.array), self.flat.index(place, index, k, listed))
    }

    /// Returns the expression of some rows, in every configuration.
    fn part(&self, place: ArrayRows) -> String {
        let name = self.name(place.array);
        match (place.row, self.flat.range(place)) {
            (Row::First, [_, end]) => format!("{name}[:{end}]"),
            (Row::Last | Row::AllButFirst, [begin, _]) => format!("{name}[{begin}:]"),
            _ => name.to_owned(),
        }
    }

    fn declare(&mut self, array: usize) {
        self.writer.lines(&format!("{} = np.zeros(({},) + batch)", self.name(array), self.flat.len(array)));
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Unpack { names, from } => {
                // A view of a local array would change with it.
                let is_given = self.flat.routine.arrays[from.array].role == Role::Argument;
                let copied = if is_given { "" } else { ".copy()" };
                let named = names.iter().enumerate().filter_map(|(k, name)| Some((k, name.as_ref()?)));
                for (k, name) in named {
                    self.writer.lines(&format!("{name} = {}{copied}", self.place(*from, 0, k)));
                }
            }
            Statement::Comment(text) => self.writer.lines(format!("# {}", harmless(text)).trim_end()),
            Statement::Let { name, value } => self.writer.lines(&format!("{name} = {value}")),
            Statement::SinCos(pairs) => {
                for ([sine, cosine], angle) in pairs {
                    let angle = &angle.text;
                    self.writer.lines(&format!("{sine}, {cosine} = np.sin({angle}), np.cos({angle})"));
                }
            }
            Statement::Declare(array) => self.declare(*array),
            // Arrays are cleared where they are declared.
            Statement::Clear(_) => {}
            Statement::Copy { from, to, fresh } => {
                let (to, from) = (self.name(*to), self.part(*from));
                let line =
                    if *fresh { format!("{to} = {from}.copy()") } else { format!("{to}[...] = {from}") };
                self.writer.lines(&line);
            }
            Statement::Assign { to, index, values, fresh } => {
                // A newly declared array has one row.
                if *fresh {
                    self.declare(to.array);
                }
                // Zeros need no assignment to an array that has just been initialized; a loop may
                // have changed any other.
                let began = *fresh || self.flat.routine.arrays[to.array].role == Role::Result;
                let values = values.iter().enumerate().filter(|(_, value)| !(began && value.is_zero));
                for (k, value) in values {
                    self.writer.lines(&format!("{} = {}", self.place(*to, *index, k), value.text));
                }
            }
            Statement::Call { routine, arrays, .. } => self.call(routine, arrays),
            Statement::Sums { sums, terms, entries } => {
                let name = self.flat.routines.sums[*sums].name;
                let [terms, entries] = [terms, entries].map(|array| self.name(*array));
                self.writer.begin(&format!("for entry, constant in enumerate({name}_CONSTANTS):"));
                self.writer.lines(&format!("{entries}[entry] = constant"));
                self.writer.end();
                self.writer.begin(&format!("for entry, term, factor in {name}_FACTORS:"));
                self.writer.lines(&format!("{entries}[entry] += factor * {terms}[term]"));
                self.writer.end();
            }
            Statement::For { repeated, body } => {
                let count = repeated.count.value(&self.flat.routines.description);
                let head = match repeated.backwards {
                    false => format!("for i in range({count}):"),
                    true => format!(
                        "for i in range({}, -1, -1):",
                        number(count as f64 - 1.0).trim_end_matches(".0")
                    ),
                };
                self.writer.begin(&head);
                if body.is_empty() {
                    self.writer.lines("pass");
                }
                body.iter().for_each(|statement| self.statement(statement));
                self.writer.end();
            }
            // `results` prints the return; columns go to arrays.
            Statement::Return(_) | Statement::Column { .. } => {}
        }
    }

    fn call(&mut self, routine: &str, arrays: &[usize]) {
        let callee = self.flat.routines.named(routine);
        let is_given = |(_, array): &(&usize, &Array)| array.role == Role::Argument;
        let (given, filled): (Vec<_>, Vec<_>) = arrays
            .iter()
            .zip(&callee.arrays)
            .filter(|(_, array)| array.role != Role::Zeros)
            .partition(is_given);
        let names = |arrays: Vec<(&usize, &Array)>| {
            arrays.into_iter().map(|(array, _)| self.name(*array)).collect::<Vec<_>>()
        };
        let (given, filled) = (names(given), names(filled));
        let given: Vec<&str> = ["batch"].into_iter().chain(given).collect();
        self.writer.lines(&format!("{} = _{routine}({})", filled.join(", "), given.join(", ")));
    }

    /// Prints the return statement: the only result, or all in their order.
    fn results(&mut self, margin: Option<&str>) {
        let arrays = self.flat.routine.arrays.iter().enumerate();
        let results = arrays.filter(|(_, array)| array.role == Role::Result).map(|(index, _)| {
            match self.flat.len(index) {
                0 => "np.zeros((0,) + batch)".to_owned(),
                _ => self.name(index).to_owned(),
            }
        });
        // A constant margin has no axes for configurations.
        let margin = margin.map(|value| match value {
            "margin" => value.to_owned(),
            value => format!("np.broadcast_to({value}, batch)"),
        });
        let results: Vec<String> = results.chain(margin).collect();
        self.writer.lines(&format!("return {}", results.join(", ")));
    }
}
