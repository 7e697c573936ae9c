//! Procedures in C.

use abbe_core::compensator::Status;

use super::functions::{RESTRICT, comment, head_of};
use super::real::Real;
use crate::print::expression::Expression;
use crate::print::layout::Writer;
use crate::print::procedure::{Called, Printer, arrays, evaluated};
use crate::print::text::harmless;
use crate::procedure::{Index, Kind, Procedure, Variable};
use crate::program::{Role, Routines};

/// Prints a procedure that another one calls.
pub(super) fn helper(writer: &mut Writer, routines: &Routines, procedure: &Procedure, real: Real) {
    let given = arrays(&procedure.arguments).map(|(name, len)| (name, Role::Argument, len));
    let filled = arrays(&procedure.results).map(|(name, len)| (name, Role::Result, len));
    let number = procedure.results.iter().find(|result| result.kind == Kind::Real);
    let kind = if number.is_some() { real.name() } else { "void" };
    writer.blank();
    comment(writer, &procedure.documentation);
    writer.lines(&head_of(&format!("static {kind} {}", procedure.name), given.chain(filled), real, RESTRICT));
    writer.open_alone();
    let mut printer = CProcedure { writer, routines, real };
    printer.declarations(procedure);
    number.iter().for_each(|result| printer.declare(result));
    printer.statements(&procedure.body);
    if let Some(result) = number {
        writer.lines(&format!("return {};", result.name));
    }
    writer.close("}");
}

/// Printer of a procedure.
pub(super) struct CProcedure<'p> {
    pub(super) writer: &'p mut Writer,
    pub(super) routines: &'p Routines,
    pub(super) real: Real,
}

impl CProcedure<'_> {
    /// Prints the declarations of constants and local variables.
    pub(super) fn declarations(&mut self, procedure: &Procedure) {
        let real = self.real;
        for (name, values) in &procedure.constants {
            let entries: Vec<String> = values.iter().map(|value| real.number(*value)).collect();
            let head = format!("static const {real} {name}[{}] = ", entries.len());
            self.writer.braces(&head, &entries, ";");
        }
        procedure.locals.iter().for_each(|variable| self.declare(variable));
    }

    fn declare(&mut self, Variable { name, kind }: &Variable) {
        let real = self.real;
        self.writer.lines(&match kind {
            Kind::Array(len) => format!("{real} {name}[{len}];"),
            Kind::Real => format!("{real} {name} = {};", real.number(0.0)),
            Kind::Whole | Kind::Flag => format!("int {name} = 0;"),
        });
    }

    /// Returns the name of a status code.
    fn code(&self, name: &str) -> String {
        format!("{}_{name}", self.routines.description.name.to_ascii_uppercase())
    }
}

impl Printer for CProcedure<'_> {
    const BRANCH: [&'static str; 3] = ["if (", ") {", "}"];

    fn writer(&mut self) -> &mut Writer {
        self.writer
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(self.real.number(value), value)
    }

    fn function(&self, called: Called) -> String {
        match called {
            Called::Absolute => self.real.function("fabs"),
            Called::Root => self.real.function("sqrt"),
            Called::Arctangent => self.real.function("atan2"),
            Called::Clamped => "clamped".to_owned(),
        }
    }

    fn flag(&self, name: &str) -> String {
        format!("{name} != 0")
    }

    fn truth(&self, value: bool) -> String {
        u8::from(value).to_string()
    }

    fn status(&self, status: Status) -> String {
        self.code(status.name())
    }

    fn comment(&mut self, text: &str) {
        self.writer.lines(&format!("/* {} */", harmless(text)));
    }

    fn assign(&mut self, place: &str, value: &str, sum: Option<&str>) {
        self.writer.lines(&match sum {
            Some(sum) => format!("{place} += {sum};"),
            None => format!("{place} = {value};"),
        });
    }

    fn copy(&mut self, to: &str, from: &str, len: usize) {
        self.writer.open(&format!("for (int k = 0; k < {len}; k++)"));
        self.writer.lines(&format!("{to}[k] = {from}[k];"));
        self.writer.close("}");
    }

    fn loop_head(&self, counter: &str, [from, to]: &[Index; 2], is_descending: bool) -> String {
        match is_descending {
            false => format!("for (int {counter} = {from}; {counter} < {to}; {counter}++) {{"),
            true => format!("for (int {counter} = {}; {counter} >= {from}; {counter}--) {{", to.clone() - 1),
        }
    }

    fn call(&mut self, procedure: &'static str, arguments: &[&'static str], result: &Variable) {
        let arguments = arguments.join(", ");
        self.writer.lines(&match (result.kind, result.name) {
            (Kind::Array(_), name) => format!("{procedure}({arguments}, {name});"),
            (_, name) => format!("{name} = {procedure}({arguments});"),
        });
    }

    fn evaluate(&mut self, function: &'static str, q: &'static str, results: &[&'static str]) {
        let (given, _) = evaluated(self.routines, function, q, results, true);
        let arrays = [&given[..], results].concat().join(", ");
        let call = format!("{}_{function}({arrays})", self.routines.description.name);
        self.writer.lines(&format!("status = {call};"));
        self.writer.open(&format!("if (status != {})", self.code(Status::Reached.name())));
        self.writer.lines("return status;");
        self.writer.close("}");
    }
}
