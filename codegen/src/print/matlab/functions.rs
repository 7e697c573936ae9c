//! Prints routines as functions.

use abbe_core::function::{self, Signature};
use abbe_core::{Description, Function};
use abbe_spec::Spec;

use super::operators::{Matlab, number};
use crate::print::flat::Flat;
use crate::print::layout::Writer;
use crate::print::statement::Statement;
use crate::print::statements::Statements;
use crate::print::text::harmless;
use crate::program::{Array, ArrayRows, Role, Routine, Routines, Row};

/// Prints one function.
pub(super) fn function(
    writer: &mut Writer,
    class: &str,
    spec: &Spec,
    routines: &Routines,
    routine: &Routine,
) {
    let Statements { list, .. } =
        Statements::new(spec, &routines.description, routine, &Matlab { class, spec });
    let names = |role| routine.arrays.iter().filter(move |array| array.role == role).map(|array| array.name);
    let arguments: Vec<&str> = names(Role::Argument).collect();
    let results: Vec<&str> = names(Role::Result).chain(names(Role::Margin)).collect();
    writer.blank();
    let (name, arguments) = (routine.name, arguments.join(", "));
    writer.begin(&format!("function [{}] = {name}({arguments})", results.join(", ")));
    match routine.function.map(Function::signature) {
        Some(signature) => {
            let margin = ["margin", "cos(rho); where it is 0, rows 4-6 are not finite."];
            let behind = signature.has_margin(routines.description.orientation).then_some(margin);
            documentation(writer, &routines.description, signature, behind);
        }
        None => writer.documentation(routine.documentation),
    }
    if routine.function.is_some() {
        let given = routine.arrays.iter().filter(|array| array.role == Role::Argument);
        checks(writer, class, given.map(|array| (array.name, array.len(&routines.description))));
    }
    let mut printer = Printer { writer, class, flat: Flat { routines, routine } };
    list.iter().for_each(|statement| printer.statement(statement));
    printer.end();
    writer.close("end");
}

/// Prints the arguments and results of a function, and an additional result if given.
pub(super) fn documentation(
    writer: &mut Writer,
    description: &Description,
    signature: &Signature,
    behind: Option<[&str; 2]>,
) {
    let shape = |array: &function::Array| {
        let counts = array.shape.iter().rev().map(|count| count.value(description).to_string());
        let shape: Vec<String> = counts.collect();
        match &shape[..] {
            [one] => format!("{one} numbers"),
            several => several.join(" x "),
        }
    };
    writer.documentation(signature.documentation);
    let arrays = signature.arguments.iter().map(|array| (array, "argument"));
    for (array, role) in arrays.chain(signature.results.iter().map(|array| (array, "result"))) {
        writer.documentation_line("");
        writer.documentation(&format!(
            "{role} {}: {} Size: {}. Unit: {}.",
            array.name,
            array.documentation,
            shape(array),
            array.unit
        ));
    }
    if let Some([name, documentation]) = behind {
        writer.documentation_line("");
        writer.documentation(&format!("result {name}: {documentation}"));
    }
}

/// Prints the checks of sizes and of the ranges of inputs.
pub(super) fn checks<'a>(
    writer: &mut Writer,
    class: &str,
    arguments: impl Iterator<Item = (&'a str, usize)>,
) {
    for (name, count) in arguments {
        writer.lines(&format!("{class}.is_given('{name}', {name}, {count});"));
        if name == "u" && count > 0 {
            let outside = format!("u(:) < {class}.ranges(:, 1) | u(:) > {class}.ranges(:, 2)");
            writer.begin(&format!("if any({outside})"));
            writer.lines("error('abbe:range', 'an input is outside its range');");
            writer.close("end");
        }
    }
}

/// Prints `name = [first second …];` with a few entries per line.
pub(super) fn list(writer: &mut Writer, name: &str, [open, close]: [&str; 2], entries: &[String]) {
    let inner = entries.join(" ");
    if inner.len() < 70 {
        return writer.lines(&format!("{name} = {open}{inner}{close};"));
    }
    writer.lines(&format!("{name} = {open} ..."));
    entries.chunks(4).for_each(|line| writer.lines(&format!("    {} ...", line.join(" "))));
    writer.lines(&format!("{close};"));
}

struct Printer<'p> {
    writer: &'p mut Writer,
    class: &'p str,
    flat: Flat<'p>,
}

impl Printer<'_> {
    fn name(&self, array: usize) -> &'static str {
        self.flat.routine.arrays[array].name
    }

    /// Returns element k of row `index` of a place. Loops count from 0, matrices from 1.
    fn place(&self, place: ArrayRows, index: usize, k: usize) -> String {
        let listed = |table: &str, column| format!("{}.{table}(i + 1, {})", self.class, column + 1);
        let flat = self.flat.index(place, index, k, listed);
        let from_1 = match (flat.parse::<usize>(), flat.rsplit_once(" + ")) {
            (Ok(flat), _) => (flat + 1).to_string(),
            (_, Some((before, last))) if last.parse::<usize>().is_ok() => {
                format!("{before} + {}", last.parse::<usize>().map_or(1, |last| last + 1))
            }
            _ => format!("{flat} + 1"),
        };
        format!("{}({from_1})", self.name(place.array))
    }

    /// Returns the expression of some rows.
    fn part(&self, place: ArrayRows) -> String {
        let name = self.name(place.array);
        match (place.row, self.flat.range(place)) {
            (Row::First | Row::Last | Row::AllButFirst, [begin, end]) => {
                format!("{name}({}:{end})", begin + 1)
            }
            (_, [_, end]) => format!("{name}(1:{end})"),
        }
    }

    fn declare(&mut self, array: usize) {
        self.writer.lines(&format!("{} = zeros(1, {});", self.name(array), self.flat.len(array)));
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Unpack { names, from } => {
                let named = names.iter().enumerate().filter_map(|(k, name)| Some((k, name.as_ref()?)));
                for (k, name) in named {
                    self.writer.lines(&format!("{name} = {};", self.place(*from, 0, k)));
                }
            }
            Statement::Comment(text) => self.writer.lines(format!("% {}", harmless(text)).trim_end()),
            Statement::Let { name, value } => self.writer.lines(&format!("{name} = {value};")),
            Statement::SinCos(pairs) => {
                for ([sine, cosine], angle) in pairs {
                    let angle = &angle.text;
                    self.writer.lines(&format!("{sine} = sin({angle});"));
                    self.writer.lines(&format!("{cosine} = cos({angle});"));
                }
            }
            Statement::Declare(array) => self.declare(*array),
            // Arrays are cleared where they are declared.
            Statement::Clear(_) => {}
            Statement::Copy { from, to, .. } => {
                self.writer.lines(&format!("{} = {};", self.name(*to), self.part(*from)));
            }
            Statement::Assign { to, index, values, fresh } => {
                // A newly declared array has one row.
                if *fresh {
                    self.declare(to.array);
                }
                let began = *fresh || self.flat.routine.arrays[to.array].role == Role::Result;
                let values = values.iter().enumerate().filter(|(_, value)| !(began && value.is_zero));
                for (k, value) in values {
                    self.writer.lines(&format!("{} = {};", self.place(*to, *index, k), value.text));
                }
            }
            Statement::Call { routine, arrays, .. } => self.call(routine, arrays),
            Statement::Sums { sums, terms, entries } => {
                let (name, class) = (self.flat.routines.sums[*sums].name, self.class);
                let [terms, entries] = [terms, entries].map(|array| self.name(*array));
                self.writer.lines(&format!("{entries} = {class}.{name}_CONSTANTS;"));
                self.writer.begin(&format!("for k = 1:size({class}.{name}_FACTORS, 1)"));
                let column = |column| format!("{class}.{name}_FACTORS(k, {column})");
                let sum = format!("{entries}({}) + {} * {terms}({})", column(1), column(3), column(2));
                self.writer.lines(&format!("{entries}({}) = {sum};", column(1)));
                self.writer.close("end");
            }
            Statement::For { repeated, body } => {
                let count = repeated.count.value(&self.flat.routines.description);
                let head = match repeated.backwards {
                    false => format!("for i = 0:{}", number(count as f64 - 1.0)),
                    true => format!("for i = {}:-1:0", number(count as f64 - 1.0)),
                };
                self.writer.begin(&head);
                body.iter().for_each(|statement| self.statement(statement));
                self.writer.close("end");
            }
            Statement::Return(margin) if margin != "margin" => {
                self.writer.lines(&format!("margin = {margin};"));
            }
            // Columns go to arrays.
            Statement::Return(_) | Statement::Column { .. } => {}
        }
    }

    fn call(&mut self, routine: &str, arrays: &[usize]) {
        let callee = self.flat.routines.named(routine);
        let is_given = |(_, array): &(&usize, &Array)| array.role == Role::Argument;
        let (given, filled): (Vec<_>, Vec<_>) = arrays.iter().zip(&callee.arrays).partition(is_given);
        let names = |arrays: &[(&usize, &Array)]| {
            arrays.iter().map(|(array, _)| self.name(**array)).collect::<Vec<_>>().join(", ")
        };
        let (results, class) = (names(&filled), self.class);
        self.writer.lines(&format!("[{results}] = {class}.{routine}({});", names(&given)));
    }

    /// Prints the conversion of results to matrices.
    fn end(&mut self) {
        for (index, array) in self.flat.routine.arrays.iter().enumerate() {
            if array.role != Role::Result {
                continue;
            }
            let counts = array.shape.iter().rev();
            let shape: Vec<String> =
                counts.map(|count| count.value(&self.flat.routines.description).to_string()).collect();
            let name = array.name;
            match &shape[..] {
                [_] if self.flat.len(index) > 0 => {}
                [_] => self.writer.lines(&format!("{name} = zeros(1, 0);")),
                _ if self.flat.len(index) == 0 => {
                    self.writer.lines(&format!("{name} = zeros({});", shape.join(", ")));
                }
                _ => self.writer.lines(&format!("{name} = reshape({name}, {});", shape.join(", "))),
            }
        }
    }
}
