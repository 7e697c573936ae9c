//! Statements and procedures in JavaScript.

use abbe_core::compensator::Status;

use super::number;
use crate::print::{Expression, Invocation, OPEN, Printer, Value, Writer, filled};
use crate::procedure::{Index, Kind, Procedure, Variable};
use crate::program::{Routine, Routines, Stage};

/// Prints a block comment.
pub(super) fn comment(writer: &mut Writer, text: &str) {
    writer.lines("/**");
    writer.documentation(text);
    writer.lines(" */");
}

/// Returns the value of the only property, or an object.
pub(super) fn one_or_object(properties: &[(&str, String)]) -> String {
    let property = |(name, value): &(&str, String)| match name == value {
        true => value.clone(),
        false => format!("{name}: {value}"),
    };
    match properties {
        [(_, value)] => value.clone(),
        several => format!("{{ {} }}", several.iter().map(property).collect::<Vec<_>>().join(", ")),
    }
}

/// Printer of statements.
pub(super) struct JavaScriptPrinter<'p> {
    pub(super) writer: &'p mut Writer,
    pub(super) routines: &'p Routines,
}

impl Printer for JavaScriptPrinter<'_> {
    const FUNCTIONS: [&'static str; 6] =
        ["Math.abs", "Math.sqrt", "Math.atan2", "clamped", "Math.sin", "Math.cos"];
    const OPERATORS: [&'static str; 3] = ["&&", "||", "==="];
    const BRANCH: [&'static str; 3] = ["if (", ") {", "}"];
    const ADDS_IN_PLACE: bool = true;

    fn writer(&mut self) -> &mut Writer {
        self.writer
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(number(value), value)
    }

    fn status(&self, status: Status) -> String {
        format!("description.statuses.{}", status.name())
    }

    fn comment(&mut self, text: &str) {
        self.writer.comment(text);
    }

    /// The name of an array differs from functions called in its scope.
    fn array(&self, routine: &Routine, name: &'static str) -> String {
        let is_called = |stage: &Stage| matches!(stage, Stage::Call { routine, .. } if *routine == name);
        format!("{name}{}", if routine.stages.iter().any(is_called) { "_" } else { "" })
    }

    fn bind(&mut self, bindings: &[(String, String)]) {
        let bindings: Vec<String> =
            bindings.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        filled(self.writer, "const ", &bindings, ", ");
    }

    fn head(&mut self, procedure: &Procedure, name: &str) {
        let arguments: Vec<&str> = procedure.arguments.iter().map(|argument| argument.name).collect();
        self.writer.blank();
        comment(self.writer, &procedure.documentation);
        self.writer.open(&format!("function {name}({})", arguments.join(", ")));
    }

    fn tail(&mut self, procedure: &Procedure) {
        self.writer.lines(&format!("return {};", procedure.results[0].name));
        self.writer.close("}");
    }

    fn unpack(&mut self, names: &str, object: &str) {
        self.writer.lines(&format!("const {{ {names} }} = {object};"));
    }

    fn numbers(&mut self, name: &str, values: &[String]) {
        self.writer.array(&format!("const {name} = "), values, ";");
    }

    /// Prints constants, results and local variables.
    fn declarations(&mut self, procedure: &Procedure, object: Option<&str>) {
        self.constants(procedure, object);
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

    fn zeros(&mut self, name: &str, len: usize) {
        self.writer.lines(&format!("const {name} = new Float64Array({len});"));
    }

    fn create(&mut self, name: &str, entries: &[(String, &Value)]) {
        let values: Vec<&str> = entries.iter().map(|(_, value)| value.text.as_str()).collect();
        self.writer.lines(&format!("const {name} = Float64Array.of({});", values.join(", ")));
    }

    fn copy_rows(&mut self, to: &str, from: &str, [first, behind]: [usize; 2], _: usize, fresh: bool) {
        self.writer.lines(&match fresh {
            true => format!("const {to} = {from}.slice({first}, {behind});"),
            false => format!("{to}.set({from}.subarray({first}, {behind}));"),
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

    fn routines(&self) -> &Routines {
        self.routines
    }

    fn invoke(&mut self, Invocation { routine, given, filled, in_procedure, .. }: &Invocation) {
        let given: Vec<&str> = given.iter().map(|(_, own)| own.as_str()).collect();
        let results: Vec<_> = filled.iter().map(|(name, _, own)| (*name, own.clone())).collect();
        let (results, call) = (one_or_object(&results), format!("{routine}({})", given.join(", ")));
        self.writer.lines(&match in_procedure {
            false => format!("const {results} = {call};"),
            true if filled.len() == 1 => format!("{results} = {call};"),
            true => format!("({results} = {call});"),
        });
        for (_, len, own) in filled.iter().filter(|_| *in_procedure) {
            let name = if self.routines.description.has_loops() { OPEN } else { "result" };
            self.writer.lines(&format!("given('{name}', {own}, {len});"));
        }
    }
}
