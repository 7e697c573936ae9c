//! Statements and procedures on NumPy arrays of configurations.
//!
//! A number is an array with one entry for each configuration. A branch therefore executes the
//! statements of every case, and assigns where its condition holds.

use abbe_core::compensator::Status;

use super::number;
use crate::print::{Binding, Expression, Invocation, OPEN, Printer, Value, Writer, harmless};
use crate::procedure::{Condition, Counter, Index, Procedure, Statement, Variable};
use crate::program::{Role, Routines};

/// Printer of statements.
pub(super) struct PythonPrinter<'p> {
    pub(super) writer: &'p mut Writer,
    pub(super) routines: &'p Routines,
    /// Conditions of the branches around the statement.
    pub(super) cases: Vec<String>,
}

impl PythonPrinter<'_> {
    /// Returns a value that is assigned in the present branch only.
    fn chosen(&self, value: &str, place: &str) -> String {
        let chosen = |case: &String| format!("np.where({case}, {value}, {place})");
        self.cases.last().map_or_else(|| value.to_owned(), chosen)
    }
}

/// 1.5 · 2⁵²: adding it rounds.
const ROUND: &str = "6755399441055744.0";

impl Printer for PythonPrinter<'_> {
    const FUNCTIONS: [&'static str; 6] = ["np.abs", "np.sqrt", "np.arctan2", "_clamped", "np.sin", "np.cos"];
    const OPERATORS: [&'static str; 3] = ["&", "|", "=="];
    const TRUTH: [&'static str; 2] = ["False", "True"];
    const BRANCH: [&'static str; 3] = ["if np.all(", "):", ""];
    const LOOP_END: &'static str = "";
    const LEAVE: &'static str = "break";
    const IS_MASKED: bool = true;
    const NOT: &'static str = "~";

    fn writer(&mut self) -> &mut Writer {
        self.writer
    }

    fn number(&self, value: f64) -> Expression {
        Expression::number(number(value), value)
    }

    fn status(&self, status: Status) -> String {
        format!("description[\"statuses\"][\"{}\"]", status.name())
    }

    fn dot(&self, counter: Counter, range: &[Index; 2], factors: &[(&'static str, Index); 2]) -> Expression {
        let [a, b] = factors.each_ref().map(|(array, index)| {
            let [first, behind] = range.each_ref().map(|end| index.with(counter, end));
            match index.factor(counter) {
                1 => format!("{array}[{first} : {behind}]"),
                step => format!("{array}[{first} : {behind} : {step}]"),
            }
        });
        Expression::new(format!("_dot({a}, {b})"), Binding::Atom)
    }

    fn comment(&mut self, text: &str) {
        self.writer.lines(format!("# {}", harmless(text)).trim_end());
    }

    fn assign(&mut self, place: &str, value: &str, _: Option<&str>) {
        let value = self.chosen(value, place);
        self.writer.lines(&format!("{place} = {value}"));
    }

    fn nearest(&self, value: &Expression) -> String {
        format!("({} + {ROUND} - {ROUND}).astype(int)", value.text)
    }

    /// A view of a local array would change with it.
    fn read(&self, place: String, role: Role) -> String {
        if role == Role::Argument { place } else { place + ".copy()" }
    }

    fn assign_all(&mut self, entries: &[(String, &Value)]) {
        entries.iter().for_each(|(place, value)| self.assign(place, &value.text, None));
    }

    fn head(&mut self, procedure: &Procedure, name: &str) {
        let arguments: Vec<&str> = procedure.arguments.iter().map(|argument| argument.name).collect();
        self.writer.lines("\n\n");
        self.writer.begin(&format!("def _{name}(batch, {}):", arguments.join(", ")));
        self.writer.lines("r\"\"\"");
        self.writer.documentation(&procedure.documentation);
        self.writer.lines("\"\"\"");
    }

    fn tail(&mut self, procedure: &Procedure) {
        self.writer.lines(&format!("return {}", procedure.results[0].name));
        self.writer.end();
    }

    fn unpack(&mut self, names: &str, list: &str) {
        self.writer.lines(&format!("[{names}] = {list}"));
    }

    fn numbers(&mut self, name: &str, values: &[String]) {
        self.writer.array(&format!("{name} = "), values, "");
    }

    fn zeros(&mut self, name: &str, len: usize) {
        self.writer.lines(&format!("{name} = np.zeros(({len},) + batch)"));
    }

    fn copy_rows(&mut self, to: &str, from: &str, [first, behind]: [usize; 2], len: usize, fresh: bool) {
        let is_whole = behind - first == len;
        let rows = if is_whole { String::new() } else { format!("[{first}:{behind}]") };
        self.writer.lines(&match fresh {
            true => format!("{to} = {from}{rows}.copy()"),
            false => format!("{to}[...] = {from}{rows}"),
        });
    }

    fn copy(&mut self, to: &str, from: &str, _: usize) {
        self.assign(to, &format!("{from}.copy()"), None);
    }

    fn loop_head(&self, counter: &str, [from, to]: &[Index; 2], is_descending: bool) -> String {
        match (is_descending, from.number()) {
            (false, Some(0)) => format!("for {counter} in range({to}):"),
            (false, _) => format!("for {counter} in range({from}, {to}):"),
            (true, _) => {
                let [last, before] = [to.clone() - 1, from.clone() - 1];
                format!("for {counter} in range({last}, {before}, -1):")
            }
        }
    }

    fn branch(&mut self, condition: &Condition, body: &[Statement]) {
        if let Condition::Is(_, index) = condition
            && index.number().is_some()
        {
            let condition = self.condition(condition);
            self.writer.begin(&format!("if {condition}:"));
            self.statements(body);
            return self.writer.end();
        }
        let condition = match (self.cases.last(), self.condition(condition)) {
            (Some(around), condition) => format!("{around} & ({condition})"),
            (None, condition) => condition,
        };
        let case = match (body, self.cases.len()) {
            ([Statement::Set(..) | Statement::SetFlag(..) | Statement::SetWhole(..)], _) => condition,
            (_, depth) => {
                let name = if depth == 0 { "case".to_owned() } else { format!("case_{}", depth + 1) };
                self.writer.lines(&format!("{name} = {condition}"));
                name
            }
        };
        self.cases.push(case);
        self.statements(body);
        self.cases.pop();
    }

    fn call(&mut self, procedure: &'static str, arguments: &[&'static str], result: &Variable) {
        self.assign(result.name, &format!("_{procedure}(batch, {})", arguments.join(", ")), None);
    }

    fn routines(&self) -> &Routines {
        self.routines
    }

    fn invoke(&mut self, Invocation { routine, given, filled, in_procedure, .. }: &Invocation) {
        let given: Vec<&str> = ["batch"].into_iter().chain(given.iter().map(|(_, own)| &own[..])).collect();
        let call = format!("_{routine}({})", given.join(", "));
        let names: Vec<&str> = filled.iter().map(|(.., own)| own.as_str()).collect();
        let results = names.join(", ");
        self.writer.lines(&match self.cases.last() {
            None => format!("{results} = {call}"),
            Some(case) => {
                format!("{results} = (np.where({case}, *pair) for pair in zip({call}, ({results})))")
            }
        });
        if *in_procedure {
            let finite: Vec<String> =
                names.iter().map(|name| format!("np.all(np.isfinite({name}))")).collect();
            self.writer.begin(&format!("if not ({}):", finite.join(" and ")));
            let why = if self.routines.description.has_loops() { OPEN } else { "a result is not finite" };
            self.writer.lines(&format!("raise ValueError(\"{why}\")"));
            self.writer.end();
        }
    }
}
