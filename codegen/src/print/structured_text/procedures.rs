//! Statements in Structured Text, and procedures as function blocks.
//!
//! Corrected commands in Structured Text.
//!
//! The block keeps the corrections of the cycle before itself.
//!
//! Lookup tables in Structured Text: a function for each.

use abbe_core::compensator::{CHANGE, LARGEST, bound};
use abbe_core::function::{COMPENSATED, Signature};
use abbe_core::{Description, LookupTable};
use abbe_spec::{Spec, Table};
use indexmap::IndexSet;

use super::declarations::{argument, array_name, array_type, document, numbers, section, variables};
use super::{Support, comment, instance, number};
use crate::print::{
    Binding, Called, Expression, Invocation, LINE, Printer, Results, Value, Writer, arrays, commands,
    escaped, width,
};
use crate::procedure::{Index, Kind, Precision, Procedure, Variable, look_up};
use crate::program::{Routine, Routines};

/// Prints a procedure as a function that returns a number. A guarded one has an argument `fault`,
/// and the given statement at its end.
pub(super) fn scalar(
    writer: &mut Writer,
    routines: &Routines,
    procedure: &Procedure,
    name: &str,
    prefix: &str,
    guard: Option<&str>,
) {
    let result = procedure.results[0];
    writer.lines(&format!("FUNCTION {name} : LREAL"));
    // Callers give the arguments in this order.
    section(writer, "VAR_INPUT", |writer| {
        procedure.arguments.iter().for_each(|argument| declare(writer, prefix, &[*argument]));
    });
    if guard.is_some() {
        section(writer, "VAR_IN_OUT", |writer| writer.lines("fault : BOOL;"));
    }
    declarations(writer, procedure, prefix, &[result]);
    BlockPrinter { writer, routines, prefix, procedures: &[] }.statements(&procedure.body);
    guard.iter().for_each(|guard| writer.lines(guard));
    writer.lines(&format!("{name} := {};\nEND_FUNCTION", result.name));
}

/// Prints constants and variables, and `more` variables.
pub(super) fn declarations(writer: &mut Writer, procedure: &Procedure, prefix: &str, more: &[Variable]) {
    if !procedure.constants.is_empty() {
        section(writer, "VAR CONSTANT", |writer| {
            procedure.constants.iter().for_each(|(name, values)| numbers(writer, prefix, name, values));
        });
    }
    section(writer, "VAR", |writer| {
        for called in procedure.called() {
            writer.lines(&format!("{} : {prefix}_{called};", instance(called)));
        }
        declare(writer, prefix, more);
        declare(writer, prefix, &procedure.locals);
        let counters: Vec<String> = procedure.counters().into_iter().map(str::to_owned).collect();
        variables(writer, &counters, "DINT");
    });
}

/// Prints declarations of variables, those of one type together.
fn declare(writer: &mut Writer, prefix: &str, list: &[Variable]) {
    let lens: IndexSet<usize> = arrays(list).map(|(_, len)| len).collect();
    let one = |writer: &mut Writer, kind, of_type: &str| {
        let names =
            list.iter().filter(|variable| variable.kind == kind).map(|variable| variable.name.to_owned());
        variables(writer, &names.collect::<Vec<_>>(), of_type);
    };
    for len in lens {
        let of_type = array_type(writer, prefix, len, "LREAL");
        one(writer, Kind::Array(len), &of_type);
    }
    [(Kind::Real, "LREAL"), (Kind::Flag, "BOOL"), (Kind::Whole, "DINT")]
        .into_iter()
        .for_each(|(kind, of_type)| one(writer, kind, of_type));
}

/// Prints the call of an instance, on several lines if it is long.
fn call(writer: &mut Writer, run: &str, given: &[String]) {
    let mut line = format!("{run}(");
    for (k, argument) in given.iter().enumerate() {
        let end = if k + 1 < given.len() { "," } else { ");" };
        if writer.indent() + width(&line) + width(argument) + 3 > LINE {
            writer.lines(line.trim_end());
            line = " ".repeat(run.len() + 1);
        }
        line += &format!("{argument}{end} ");
    }
    writer.lines(line.trim_end());
}

/// Printer of the statements of a procedure.
pub(super) struct BlockPrinter<'p> {
    pub(super) writer: &'p mut Writer,
    pub(super) routines: &'p Routines,
    pub(super) prefix: &'p str,
    /// The procedures, whose inputs have names.
    pub(super) procedures: &'p [Procedure],
}

impl BlockPrinter<'_> {
    /// Prints the end of the block with a status if a condition holds.
    pub(super) fn leave(&mut self, condition: &str, status: &str) {
        self.guard(condition, &format!("status := {status};\nRETURN;"));
    }
}

impl Printer for BlockPrinter<'_> {
    const FUNCTIONS: [&'static str; 6] = [
        "ABS",
        "SQRT",
        Support::Arctangent.name(),
        Support::Clamped.name(),
        Support::Sine.name(),
        Support::Cosine.name(),
    ];
    const OPERATORS: [&'static str; 3] = ["AND", "OR", "="];
    const TRUTH: [&'static str; 2] = ["FALSE", "TRUE"];
    const BRANCH: [&'static str; 3] = ["IF ", " THEN", "END_IF;"];
    const LOOP_END: &'static str = "END_FOR;";
    const LOOPS_ONCE: bool = false;
    const HAS_LESS: bool = false;
    const LEAVE: &'static str = "EXIT;";
    const NOT: &'static str = "NOT ";
    const ASSIGN: [&'static str; 2] = [":=", ";"];
    const SKIPS_EMPTY: bool = true;
    const RESULTS: Results = Results::Kept;

    fn writer(&mut self) -> &mut Writer {
        self.writer
    }

    fn number(&self, value: f64) -> Expression {
        Expression::new(number(value), if value.is_sign_negative() { Binding::Choice } else { Binding::Atom })
    }

    fn head(&mut self, procedure: &Procedure, name: &str) {
        self.writer.blank();
        comment(self.writer, &procedure.documentation);
        self.writer.lines(&format!("FUNCTION_BLOCK {}_{name}", self.prefix));
        let prefix = self.prefix;
        section(self.writer, "VAR_INPUT", |writer| declare(writer, prefix, &procedure.arguments));
        section(self.writer, "VAR_OUTPUT", |writer| declare(writer, prefix, &procedure.results));
    }

    fn declarations(&mut self, procedure: &Procedure, _: Option<&str>) {
        declarations(self.writer, procedure, self.prefix, &[]);
    }

    fn tail(&mut self, _: &Procedure) {
        self.writer.lines("END_FUNCTION_BLOCK");
    }

    fn function(&self, called: Called) -> String {
        let name = Self::FUNCTIONS[called as usize];
        match called {
            Called::Absolute | Called::Root => name.to_owned(),
            _ => format!("{}_{name}", self.prefix),
        }
    }

    fn real(&self, whole: &Index) -> Expression {
        Expression::new(format!("DINT_TO_LREAL({whole})"), Binding::Atom)
    }

    fn nearest(&self, value: &Expression) -> String {
        format!("{}_{}({})", self.prefix, Support::Nearest.name(), value.text)
    }

    fn comment(&mut self, text: &str) {
        comment(self.writer, text);
    }

    fn array(&self, _: &Routine, name: &'static str) -> String {
        array_name(name).to_owned()
    }

    fn sines(&mut self, pairs: &[([String; 2], Expression)]) {
        for ([sine, cosine], angle) in pairs {
            let call = format!("{}_cosine_and_sine({}, {sine})", self.prefix, angle.text);
            self.assign(cosine, &call, None);
        }
    }

    /// Local arrays are declared above the statements.
    fn create(&mut self, _: &str, entries: &[(String, &Value)]) {
        self.assign_all(entries);
    }

    fn copy(&mut self, to: &str, from: &str, _: usize) {
        self.assign(to, from, None);
    }

    fn loop_head(&self, counter: &str, [from, to]: &[Index; 2], is_descending: bool) -> String {
        let last = to.clone() - 1;
        match is_descending {
            false => format!("FOR {counter} := {from} TO {last} DO"),
            true => format!("FOR {counter} := {last} TO {from} BY -1 DO"),
        }
    }

    fn call(&mut self, procedure: &'static str, arguments: &[&'static str], result: &Variable) {
        let callee = self.procedures.iter().find(|one| one.name == procedure).expect("it is described");
        let run = instance(procedure);
        let given = callee.arguments.iter().zip(arguments);
        let given: Vec<String> = given.map(|(wanted, name)| format!("{} := {name}", wanted.name)).collect();
        call(self.writer, &run, &given);
        self.writer.lines(&format!("{} := {run}.{};", result.name, callee.results[0].name));
    }

    fn routines(&self) -> &Routines {
        self.routines
    }

    fn invoke(&mut self, Invocation { routine, given, filled, .. }: &Invocation) {
        let run = instance(routine);
        let given: Vec<String> = given
            .iter()
            .map(|(name, own)| {
                let name = array_name(name);
                format!("{name} := {}", if own == "s" || own == "u" { name } else { own })
            })
            .collect();
        call(self.writer, &run, &given);
        self.leave(&format!("{run}.status <> 0"), &format!("{run}.status"));
        for (name, _, own) in filled {
            self.assign(own, &format!("{run}.{}", array_name(name)), None);
        }
    }
}

/// Prints the blocks of corrected commands and of where they begin, and those that they call.
pub(super) fn blocks(writer: &mut Writer, spec: &Spec, routines: &Routines, prefix: &str) {
    let (helpers, commands) = commands(spec, routines, Precision::Double);
    let helpers: Vec<Procedure> = helpers.into_iter().map(Procedure::with_loops).collect();
    let mut printer = BlockPrinter { writer, routines, prefix, procedures: &helpers };
    helpers.iter().for_each(|procedure| printer.helper(procedure, procedure.name, None));
    for (signature, procedure) in commands {
        let (procedure, is_cycle) = (procedure.with_loops(), signature.name == COMPENSATED.name);
        let writer = &mut *printer.writer;
        writer.blank();
        comment(writer, signature.documentation);
        writer.lines(&format!("FUNCTION_BLOCK {prefix}_{}", signature.name));
        interface(writer, prefix, spec, &routines.description, signature);
        let kept = Variable { name: "last", kind: Kind::Array(spec.variables.len()) };
        let more = [kept, Variable { name: "sum", kind: Kind::Real }];
        declarations(writer, &procedure, prefix, if is_cycle { &more } else { &more[1..] });
        let count = spec.variables.len().to_string();
        for text in [RESUME, ROTATIONS].into_iter().filter(|text| is_cycle || *text == ROTATIONS) {
            writer.lines(text.replace("COUNT", &count).replace("PREFIX", prefix).trim_end());
        }
        printer.statements(&procedure.body);
        if is_cycle {
            printer.writer.lines("last := correction;");
        }
        printer.writer.lines("END_FUNCTION_BLOCK");
    }
}

/// Begins where the drives stand.
const RESUME: &str = include_str!("resume.st");

/// Checks what no other block checks.
const ROTATIONS: &str = include_str!("rotations.st");

/// Prints inputs and outputs.
fn interface(
    writer: &mut Writer,
    prefix: &str,
    spec: &Spec,
    description: &Description,
    signature: &Signature,
) {
    let bounds = |bounds| -> Vec<f64> {
        description.variables.iter().map(|one| bound(description, one.kind, bounds)).collect()
    };
    let homes: Vec<f64> = description.variables.iter().map(|variable| variable.home).collect();
    section(writer, "VAR_INPUT", |writer| {
        for array in signature.arguments.iter().filter(|array| array.name != "last") {
            let values = match array.name {
                "change" => bounds(CHANGE),
                "largest" => bounds(LARGEST),
                "rotations" => vec![1.0; 3],
                _ => {
                    argument(writer, prefix, spec, description, array);
                    continue;
                }
            };
            document(writer, description, array);
            numbers(writer, prefix, array.name, &values);
        }
        if signature.name == COMPENSATED.name {
            comment(writer, WHEN);
            writer.lines("resume : BOOL;");
            comment(writer, STANDING);
            numbers(writer, prefix, "standing", &homes);
        }
    });
    section(writer, "VAR_OUTPUT", |writer| {
        comment(writer, OUTPUTS);
        for array in signature.results {
            document(writer, description, array);
            let values = match array.name {
                "corrected" | "command" => homes.clone(),
                _ => vec![0.0; array.len(description)],
            };
            numbers(writer, prefix, array.name, &values);
        }
        writer.lines("status : INT := 1;");
    });
}

const WHEN: &str = "TRUE begins anew where the drives stand: set it in each cycle in which they do not move, and in the \
     first one in which they do. No drive then moves further than change in that cycle, if q is within the limits.";

const STANDING: &str = "Where the drives stand while resume is TRUE, in the order and the units of q.";

const OUTPUTS: &str = "With the statuses 1 to 3 nothing is written, and the outputs are those of the last valid cycle, at first \
     the home position. With any other status, the commands are within the limits, and after is what is left at them.";

/// Prints the function of a table.
pub(super) fn function(writer: &mut Writer, routines: &Routines, table: &Table, name: &str, prefix: &str) {
    let lookup = table.lookup();
    // Beyond the ends a table may have no value.
    let is_missing = |(_, piece): &(usize, &[f64; 4])| piece.iter().any(|number| number.is_nan());
    let missing = lookup.pieces.iter().enumerate().filter(is_missing);
    let missing: Vec<String> = missing.map(|(piece, _)| format!("(piece = {piece})")).collect();
    let without = |number: f64| if number.is_nan() { 0.0 } else { number };
    let pieces: Vec<[f64; 4]> = lookup.pieces.iter().map(|piece| piece.map(without)).collect();
    let what = format!(
        "{} Order 0 is the table itself, 1 to 3 a derivative.",
        table.documentation(&escaped(&table.description))
    );
    let procedure = look_up(&LookupTable { pieces: &pieces, ..lookup }, lookup.scale, String::new());
    writer.blank();
    comment(writer, &what);
    let fault = (!missing.is_empty()).then(|| format!("fault := fault OR {};", missing.join(" OR ")));
    scalar(writer, routines, &procedure, name, prefix, Some(fault.as_deref().unwrap_or("")));
}
