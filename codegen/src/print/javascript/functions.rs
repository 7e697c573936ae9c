//! Prints routines as functions.

use abbe_core::function::Signature;
use abbe_core::{Description, Function};
use abbe_spec::Spec;

use super::operators::{JavaScript, number};
use crate::print::flat::{Flat, filled};
use crate::print::layout::Writer;
use crate::print::statement::Statement;
use crate::print::statements::Statements;
use crate::program::{Array, ArrayRows, Role, Routine, Routines, Row, Stage};

/// Prints one function.
pub(super) fn function(writer: &mut Writer, spec: &Spec, routines: &Routines, routine: &Routine) {
    let Statements { list, .. } =
        Statements::new(spec, &routines.description, routine, &JavaScript(&spec.tables));
    writer.blank();
    writer.lines("/**");
    match routine.function.map(Function::signature) {
        Some(signature) => {
            let margin = ["margin", "`cos ρ`; where it is 0, rows 4–6 are not finite."];
            let behind = signature.has_margin(routines.description.orientation).then_some(margin);
            documentation(writer, &routines.description, signature, behind);
        }
        None => writer.documentation(routine.documentation),
    }
    writer.lines(" */");
    let given = routine.arrays.iter().filter(|array| array.role == Role::Argument);
    let arguments: Vec<&str> = given.map(|array| array.name).collect();
    let export = if routines.exports(routine) { "export " } else { "" };
    writer.open(&format!("{export}function {}({})", routine.name, arguments.join(", ")));
    let mut printer = Printer { writer, flat: Flat { routines, routine } };
    list.iter().for_each(|statement| printer.statement(statement));
    let margin = match list.last() {
        Some(Statement::Return(value)) => Some(value.as_str()),
        _ => None,
    };
    printer.results(margin);
    writer.close("}");
}

/// Prints the documentation of a function: its signature, and what it returns in addition to the
/// results.
pub(super) fn documentation(
    writer: &mut Writer,
    description: &Description,
    signature: &Signature,
    behind: Option<[&str; 2]>,
) {
    writer.documentation(signature.documentation);
    writer.documentation_line("");
    let numbers = |array: &abbe_core::function::Array| {
        let shape = array.shape.iter().map(|count| count.value(description).to_string());
        format!(
            "{} Size: {}. Unit: {}.",
            array.documentation,
            shape.collect::<Vec<_>>().join(" × "),
            array.unit
        )
    };
    for array in signature.arguments {
        writer.documentation(&format!("@param {{Float64Array}} {} {}", array.name, numbers(array)));
    }
    match (signature.results, behind) {
        ([array], None) => writer.documentation(&format!("@returns {{Float64Array}} {}", numbers(array))),
        (several, behind) => {
            writer.documentation("@returns {object} Object with the properties:");
            for array in several {
                writer.documentation(&format!("- `{}`: {}", array.name, numbers(array)));
            }
            if let Some([name, documentation]) = behind {
                writer.documentation(&format!("- `{name}`: {documentation}"));
            }
        }
    }
}

/// Prints a block comment.
pub(super) fn comment(writer: &mut Writer, text: &str) {
    writer.lines("/**");
    writer.documentation(text);
    writer.lines(" */");
}

struct Printer<'p> {
    writer: &'p mut Writer,
    flat: Flat<'p>,
}

impl Printer<'_> {
    /// Returns the name of an array, which must differ from functions called in its scope.
    fn name(&self, array: usize) -> String {
        let Flat { routine, .. } = self.flat;
        let name = routine.arrays[array].name;
        let is_called = |stage: &Stage| matches!(stage, Stage::Call { routine, .. } if *routine == name);
        format!("{name}{}", if routine.stages.iter().any(is_called) { "_" } else { "" })
    }

    fn len(&self, array: usize) -> usize {
        self.flat.len(array)
    }

    /// Returns the expression of some rows.
    fn part(&self, place: ArrayRows) -> String {
        let name = self.name(place.array);
        match (place.row, self.flat.range(place)) {
            (Row::First, [_, end]) => format!("{name}.subarray(0, {end})"),
            (Row::Last | Row::AllButFirst, [begin, _]) => format!("{name}.subarray({begin})"),
            _ => name,
        }
    }

    /// Returns element k of row `index` of a place.
    fn place(&self, place: ArrayRows, index: usize, k: usize) -> String {
        let listed = |table: &str, column| match column {
            0 => format!("{table}[2 * i]"),
            column => format!("{table}[2 * i + {column}]"),
        };
        format!("{}[{}]", self.name(place.array), self.flat.index(place, index, k, listed))
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Unpack { names, from } => {
                let named = names.iter().enumerate().filter_map(|(k, name)| Some((k, name.as_ref()?)));
                let entry = |(k, name): (usize, &String)| format!("{name} = {}", self.place(*from, 0, k));
                let entries: Vec<String> = named.map(entry).collect();
                filled(self.writer, "const ", &entries, ", ");
            }
            Statement::Comment(text) => self.writer.comment(text),
            Statement::Let { name, value } => self.writer.lines(&format!("const {name} = {value};")),
            Statement::SinCos(pairs) => {
                for ([sine, cosine], angle) in pairs {
                    let angle = &angle.text;
                    let line = format!("const {sine} = Math.sin({angle}), {cosine} = Math.cos({angle});");
                    self.writer.lines(&line);
                }
            }
            Statement::Declare(array) => {
                let line = format!("const {} = new Float64Array({});", self.name(*array), self.len(*array));
                self.writer.lines(&line);
            }
            // Arrays are cleared where they are declared.
            Statement::Clear(_) => {}
            Statement::Copy { from, to, fresh } => {
                let (to, from) = (self.name(*to), self.part(*from));
                let line = if *fresh {
                    format!("const {to} = {from}.slice();")
                } else {
                    format!("{to}.set({from});")
                };
                self.writer.lines(&line);
            }
            Statement::Assign { to, values, fresh: true, .. } => {
                let values: Vec<&str> = values.iter().map(|value| value.text.as_str()).collect();
                let line = format!("const {} = Float64Array.of({});", self.name(to.array), values.join(", "));
                self.writer.lines(&line);
            }
            Statement::Assign { to, index, values, fresh: false } => {
                // Results have been initialized with zeros.
                let is_result = self.flat.routine.arrays[to.array].role == Role::Result;
                let values = values.iter().enumerate().filter(|(_, value)| !(is_result && value.is_zero));
                let entry = |(k, value): (usize, &crate::print::expression::Value)| {
                    format!("{} = {}", self.place(*to, *index, k), value.text)
                };
                let entries: Vec<String> = values.map(entry).collect();
                filled(self.writer, "", &entries, "; ");
            }
            Statement::Call { routine, arrays, .. } => self.call(routine, arrays),
            Statement::Sums { sums, terms, entries } => {
                let name = self.flat.routines.sums[*sums].name;
                let [terms, entries] = [terms, entries].map(|array| self.name(*array));
                self.writer.lines(&format!("{entries}.set({name}_CONSTANTS);"));
                self.writer.open(&format!("for (let k = 0; k < {name}_FACTORS.length; k += 3)"));
                let factor = format!("{name}_FACTORS[k + 2] * {terms}[{name}_FACTORS[k + 1]]");
                self.writer.lines(&format!("{entries}[{name}_FACTORS[k]] += {factor};"));
                self.writer.close("}");
            }
            Statement::For { repeated, body } => {
                let count = repeated.count.value(&self.flat.routines.description);
                let head = match repeated.backwards {
                    false => format!("for (let i = 0; i < {count}; i++)"),
                    true => format!("for (let i = {}; i >= 0; i--)", number(count as f64 - 1.0)),
                };
                self.writer.open(&head);
                body.iter().for_each(|statement| self.statement(statement));
                self.writer.close("}");
            }
            // `results` prints the return; columns go to arrays.
            Statement::Return(_) | Statement::Column { .. } => {}
        }
    }

    fn call(&mut self, routine: &str, arrays: &[usize]) {
        let callee = self.flat.routines.named(routine);
        let is_given = |(_, array): &(&usize, &Array)| array.role == Role::Argument;
        let (given, filled): (Vec<_>, Vec<_>) = arrays.iter().zip(&callee.arrays).partition(is_given);
        let given: Vec<String> = given.into_iter().map(|(array, _)| self.name(*array)).collect();
        let results = match &filled[..] {
            [(array, _)] => self.name(**array),
            several => {
                let entry = |(array, found): &(&usize, &Array)| match self.name(**array) {
                    name if name == found.name => name,
                    name => format!("{}: {name}", found.name),
                };
                format!("{{ {} }}", several.iter().map(entry).collect::<Vec<_>>().join(", "))
            }
        };
        self.writer.lines(&format!("const {results} = {routine}({});", given.join(", ")));
    }

    /// Prints the return statement: the only result, or an object of all results.
    fn results(&mut self, margin: Option<&str>) {
        let arrays = self.flat.routine.arrays.iter().enumerate();
        let results = arrays.filter(|(_, array)| array.role == Role::Result).map(|(index, array)| {
            let value =
                if self.len(index) == 0 { "new Float64Array(0)".to_owned() } else { self.name(index) };
            (array.name, value)
        });
        let margin = margin.map(|value| ("margin", value.to_owned()));
        let results: Vec<(&str, String)> = results.chain(margin).collect();
        let line = match &results[..] {
            [(_, value)] => format!("return {value};"),
            several => {
                let entry = |(name, value): &(&str, String)| match name == value {
                    true => value.clone(),
                    false => format!("{name}: {value}"),
                };
                format!("return {{ {} }};", several.iter().map(entry).collect::<Vec<_>>().join(", "))
            }
        };
        self.writer.lines(&line);
    }
}
