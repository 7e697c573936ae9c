//! Procedures in JavaScript.

use abbe_core::compensator::Status;

use super::functions::comment;
use super::operators::number;
use crate::print::expression::Expression;
use crate::print::flat::filled;
use crate::print::layout::Writer;
use crate::print::procedure::{Called, Printer, evaluated};
use crate::procedure::{Index, Kind, Procedure, Variable};
use crate::program::Routines;

/// Prints a procedure that another one calls.
pub(super) fn helper(writer: &mut Writer, routines: &Routines, procedure: &Procedure) {
    let arguments: Vec<&str> = procedure.arguments.iter().map(|argument| argument.name).collect();
    writer.blank();
    comment(writer, &procedure.documentation);
    writer.open(&format!("function {}({})", procedure.name, arguments.join(", ")));
    let mut printer = JavaScriptProcedure { writer, routines };
    printer.declarations(procedure);
    printer.statements(&procedure.body);
    writer.lines(&format!("return {};", procedure.results[0].name));
    writer.close("}");
}

/// Printer of a procedure.
pub(super) struct JavaScriptProcedure<'p> {
    pub(super) writer: &'p mut Writer,
    pub(super) routines: &'p Routines,
}

impl JavaScriptProcedure<'_> {
    /// Prints the declarations of constants, results and local variables.
    pub(super) fn declarations(&mut self, procedure: &Procedure) {
        for (name, values) in &procedure.constants {
            let entries: Vec<String> = values.iter().map(|value| number(*value)).collect();
            self.writer.array(&format!("const {name} = "), &entries, ";");
        }
        let mut later = Vec::new();
        for Variable { name, kind } in procedure.results.iter().chain(&procedure.locals) {
            match kind {
                Kind::Array(len) if procedure.begins_by_elements(name) => {
                    let keyword = if procedure.is_assigned_whole(name) { "let" } else { "const" };
                    self.writer.lines(&format!("{keyword} {name} = new Float64Array({len});"));
                }
                _ => later.push((*name).to_owned()),
            }
        }
        filled(self.writer, "let ", &later, ", ");
    }
}

impl Printer for JavaScriptProcedure<'_> {
    const BRANCH: [&'static str; 3] = ["if (", ") {", "}"];

    fn writer(&mut self) -> &mut Writer {
        self.writer
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(number(value), value)
    }

    fn function(&self, called: Called) -> String {
        match called {
            Called::Absolute => "Math.abs",
            Called::Root => "Math.sqrt",
            Called::Arctangent => "Math.atan2",
            Called::Clamped => "clamped",
        }
        .to_owned()
    }

    fn operators(&self) -> [&'static str; 3] {
        ["&&", "||", "==="]
    }

    fn status(&self, status: Status) -> String {
        format!("description.statuses.{}", status.name())
    }

    fn comment(&mut self, text: &str) {
        self.writer.comment(text);
    }

    fn assign(&mut self, place: &str, value: &str, sum: Option<&str>) {
        self.writer.lines(&match sum {
            Some(sum) => format!("{place} += {sum};"),
            None => format!("{place} = {value};"),
        });
    }

    fn copy(&mut self, to: &str, from: &str, _: usize) {
        self.writer.lines(&format!("{to} = Float64Array.from({from});"));
    }

    fn loop_head(&self, counter: &str, [from, to]: &[Index; 2], is_descending: bool) -> String {
        match is_descending {
            false => format!("for (let {counter} = {from}; {counter} < {to}; {counter}++) {{"),
            true => format!("for (let {counter} = {}; {counter} >= {from}; {counter}--) {{", to.clone() - 1),
        }
    }

    fn call(&mut self, procedure: &'static str, arguments: &[&'static str], result: &Variable) {
        self.writer.lines(&format!("{} = {procedure}({});", result.name, arguments.join(", ")));
    }

    fn evaluate(&mut self, function: &'static str, q: &'static str, results: &[&'static str]) {
        let (given, filled) = evaluated(self.routines, function, q, results, false);
        let call = format!("{function}({})", given.join(", "));
        let named: Vec<String> =
            filled.iter().map(|(array, name)| format!("{}: {name}", array.name)).collect();
        self.writer.lines(&match results {
            [result] => format!("{result} = {call};"),
            _ => format!("({{ {} }} = {call});", named.join(", ")),
        });
        for (array, name) in filled {
            let len = array.len(&self.routines.description);
            self.writer.lines(&format!("given('result', {name}, {len});"));
        }
    }
}
