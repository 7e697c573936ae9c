//! Statements and procedures in Matlab.

use super::number;
use crate::print::{Binding, Called, Expression, Invocation, OPEN, Printer, Writer, harmless};
use crate::procedure::{Counter, Index, Procedure, Variable};
use crate::program::Routines;

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

/// Printer of statements.
pub(super) struct MatlabPrinter<'p> {
    pub(super) writer: &'p mut Writer,
    pub(super) class: &'p str,
    pub(super) routines: &'p Routines,
}

impl Printer for MatlabPrinter<'_> {
    const FUNCTIONS: [&'static str; 6] = ["abs", "sqrt", "atan2", "clamped", "sin", "cos"];
    const BRANCH: [&'static str; 3] = ["if ", "", "end"];
    const LOOP_END: &'static str = "end";
    const LEAVE: &'static str = "break";
    const NOT: &'static str = "~";

    fn writer(&mut self) -> &mut Writer {
        self.writer
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(number(value), value)
    }

    fn function(&self, called: Called) -> String {
        let name = Self::FUNCTIONS[called as usize];
        if called == Called::Clamped { self.constant(name) } else { name.to_owned() }
    }

    /// Matrices begin at 1.
    fn at(&self, array: &str, index: &str) -> String {
        let (before, last) = index.rsplit_once(" + ").map_or(("", index), |(before, last)| (before, last));
        match (before, last.parse::<usize>()) {
            ("", Ok(last)) => format!("{array}({})", last + 1),
            (before, Ok(last)) => format!("{array}({before} + {})", last + 1),
            _ => format!("{array}({index} + 1)"),
        }
    }

    fn constant(&self, name: &str) -> String {
        format!("{}.{name}", self.class)
    }

    fn dot(&self, counter: Counter, range: &[Index; 2], factors: &[(&'static str, Index); 2]) -> Expression {
        let [a, b] = factors.each_ref().map(|(array, index)| {
            let [first, behind] = range.each_ref().map(|end| index.with(counter, end));
            let step = index.factor(counter);
            let last = behind - step;
            match step {
                1 => format!("{array}({}:{})", first + 1, last + 1),
                step => format!("{array}({}:{step}:{})", first + 1, last + 1),
            }
        });
        Expression::new(format!("sum({a} .* {b})"), Binding::Atom)
    }

    fn comment(&mut self, text: &str) {
        self.writer.lines(format!("% {}", harmless(text)).trim_end());
    }

    fn head(&mut self, procedure: &Procedure, name: &str) {
        let arguments: Vec<&str> = procedure.arguments.iter().map(|argument| argument.name).collect();
        let (result, arguments) = (procedure.results[0].name, arguments.join(", "));
        self.writer.blank();
        self.writer.begin(&format!("function {result} = {name}({arguments})"));
        self.writer.documentation(&procedure.documentation);
    }

    fn tail(&mut self, _: &Procedure) {
        self.writer.close("end");
    }

    fn unpack(&mut self, names: &str, property: &str) {
        self.writer.lines(&format!("[{names}] = {}.{property}{{:}};", self.class));
    }

    fn numbers(&mut self, name: &str, values: &[String]) {
        list(self.writer, name, ["[", "]"], values);
    }

    fn zeros(&mut self, name: &str, len: usize) {
        self.writer.lines(&format!("{name} = zeros(1, {len});"));
    }

    fn copy_rows(&mut self, to: &str, from: &str, [first, behind]: [usize; 2], len: usize, _: bool) {
        let is_whole = behind - first == len;
        let rows = if is_whole { String::new() } else { format!("({}:{behind})", first + 1) };
        self.assign(to, &format!("{from}{rows}"), None);
    }

    fn loop_head(&self, counter: &str, [from, to]: &[Index; 2], is_descending: bool) -> String {
        let last = to.clone() - 1;
        match is_descending {
            false => format!("for {counter} = {from}:{last}"),
            true => format!("for {counter} = {last}:-1:{from}"),
        }
    }

    fn call(&mut self, procedure: &'static str, arguments: &[&'static str], result: &Variable) {
        let call = format!("{}.{procedure}({})", self.class, arguments.join(", "));
        self.assign(result.name, &call, None);
    }

    fn routines(&self) -> &Routines {
        self.routines
    }

    fn invoke(&mut self, Invocation { routine, given, filled, in_procedure, .. }: &Invocation) {
        let given: Vec<&str> = given.iter().map(|(_, own)| own.as_str()).collect();
        let results: Vec<&str> = filled.iter().map(|(.., own)| own.as_str()).collect();
        let call = format!("{}.{routine}({})", self.class, given.join(", "));
        self.writer.lines(&format!("[{}] = {call};", results.join(", ")));
        if *in_procedure {
            let finite: Vec<String> =
                results.iter().map(|name| format!("all(isfinite({name}(:)))")).collect();
            let condition = format!("~({})", finite.join(" && "));
            let why = match self.routines.description.has_loops() {
                true => format!("error('abbe:closed', '{OPEN}');"),
                false => "error('abbe:finite', 'a result is not finite');".to_owned(),
            };
            self.guard(&condition, &why);
        }
    }
}
