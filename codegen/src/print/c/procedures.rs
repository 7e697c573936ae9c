//! Statements and procedures in C.

use std::fmt::Display;

use abbe_core::compensator::Status;

use super::{RESTRICT, Real, broken, comment};
use crate::print::{
    Binding, Called, Expression, Invocation, Printer, Results, Value, Writer, arrays, filled, harmless,
};
use crate::procedure::{Index, Kind, Procedure, Variable};
use crate::program::Routines;

/// Returns the number that a procedure returns, if its result is no array.
fn returned(procedure: &Procedure) -> Option<&Variable> {
    procedure.results.iter().find(|result| result.kind == Kind::Real)
}

/// Printer of statements.
pub(super) struct CPrinter<'p> {
    pub(super) writer: &'p mut Writer,
    pub(super) routines: &'p Routines,
    pub(super) real: Real,
}

impl CPrinter<'_> {
    fn declare_variable(&mut self, Variable { name, kind }: &Variable) {
        let real = self.real;
        self.writer.lines(&match kind {
            Kind::Array(len) => format!("{real} {name}[{len}];"),
            Kind::Real => format!("{real} {name} = {};", real.number(0.0)),
            Kind::Whole | Kind::Flag => format!("int {name} = 0;"),
        });
    }

    /// Returns the name of a status code.
    pub(super) fn code(&self, name: &str) -> String {
        format!("{}_{name}", self.routines.description.name.to_ascii_uppercase())
    }

    /// Prints the end of the function with a value if a condition holds.
    pub(super) fn leave(&mut self, condition: &str, value: impl Display) {
        self.guard(condition, &format!("return {value};"));
    }
}

impl Printer for CPrinter<'_> {
    const FUNCTIONS: [&'static str; 6] = ["fabs", "sqrt", "atan2", "clamped", "sine", "cosine"];
    const TRUTH: [&'static str; 2] = ["0", "1"];
    const BRANCH: [&'static str; 3] = ["if (", ") {", "}"];
    const ADDS_IN_PLACE: bool = true;
    const SKIPS_EMPTY: bool = true;
    const RESULTS: Results = Results::Given;

    fn writer(&mut self) -> &mut Writer {
        self.writer
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(self.real.number(value), value)
    }

    fn function(&self, called: Called) -> String {
        let name = Self::FUNCTIONS[called as usize];
        match called {
            Called::Absolute | Called::Root | Called::Arctangent => self.real.function(name),
            Called::Clamped | Called::Sine | Called::Cosine => name.to_owned(),
        }
    }

    fn flag(&self, name: &str) -> String {
        format!("{name} != 0")
    }

    fn status(&self, status: Status) -> String {
        self.code(status.name())
    }

    fn real(&self, whole: &Index) -> Expression {
        Expression::new(format!("({}){whole}", self.real), Binding::Atom)
    }

    fn nearest(&self, value: &Expression) -> String {
        let round = self.real.rounder();
        format!("(int)(({} + {round}) - {round})", value.text)
    }

    fn comment(&mut self, text: &str) {
        self.writer.lines(&format!("/* {} */", harmless(text)));
    }

    fn bind(&mut self, bindings: &[(String, String)]) {
        let real = self.real;
        bindings
            .iter()
            .for_each(|(name, value)| self.writer.lines(&format!("const {real} {name} = {value};")));
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

    fn head(&mut self, procedure: &Procedure, name: &str) {
        let real = self.real;
        let given = |Variable { name, kind }: &Variable| match kind {
            Kind::Array(len) => format!("const {real} {name}[{RESTRICT}({len})]"),
            Kind::Real => format!("{real} {name}"),
            Kind::Whole | Kind::Flag => format!("int {name}"),
        };
        let filled = |(name, len)| format!("{real} {name}[{RESTRICT}({len})]");
        let filled = arrays(&procedure.results).map(filled);
        let kind = if returned(procedure).is_some() { real.name() } else { "void" };
        let arguments: Vec<String> = procedure.arguments.iter().map(given).chain(filled).collect();
        self.writer.blank();
        comment(self.writer, &procedure.documentation);
        self.writer.lines(&broken(&format!("static {kind} {name}"), &arguments));
        self.writer.open_alone();
    }

    fn tail(&mut self, procedure: &Procedure) {
        if let Some(result) = returned(procedure) {
            self.writer.lines(&format!("return {};", result.name));
        }
        self.writer.close("}");
    }

    fn numbers(&mut self, name: &str, values: &[String]) {
        let head = format!("static const {} {name}[{}] = ", self.real, values.len());
        self.writer.braces(&head, values, ";");
    }

    /// Prints constants and local variables.
    fn declarations(&mut self, procedure: &Procedure, list: Option<&str>) {
        self.constants(procedure, list);
        let own = procedure.locals.iter().chain(returned(procedure));
        own.for_each(|variable| self.declare_variable(variable));
    }

    fn zeros(&mut self, name: &str, len: usize) {
        let real = self.real;
        self.writer.lines(&format!("{real} {name}[{len}] = {{ {} }};", real.number(0.0)));
    }

    fn create(&mut self, name: &str, entries: &[(String, &Value)]) {
        let values: Vec<&str> = entries.iter().map(|(_, value)| value.text.as_str()).collect();
        self.writer.braces(&format!("{} {name}[{}] = ", self.real, values.len()), &values, ";");
    }

    fn declare(&mut self, name: &str, len: usize) {
        self.writer.lines(&format!("{} {name}[{len}];", self.real));
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

    fn routines(&self) -> &Routines {
        self.routines
    }

    fn invoke(&mut self, Invocation { routine, is_function, given, filled, in_procedure }: &Invocation) {
        let filled = filled.iter().map(|(.., own)| own);
        let arrays: Vec<&str> = given.iter().map(|(_, own)| own).chain(filled).map(String::as_str).collect();
        let call = format!("{}_{routine}({});", self.routines.description.name, arrays.join(", "));
        if !is_function {
            return self.writer.lines(&call);
        }
        match in_procedure {
            true => self.writer.lines(&format!("status = {call}")),
            false => {
                self.writer.open_alone();
                self.writer.lines(&format!("const int status = {call}"));
            }
        }
        self.leave(&format!("status != {}", self.code(Status::Reached.name())), "status");
        if !in_procedure {
            self.writer.close("}");
        }
    }
}
