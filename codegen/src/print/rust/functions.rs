//! Prints the array functions of a module: generic over the scalar, without checks.

use abbe_core::{Function, function::Count};
use abbe_spec::Spec;

use super::operators::Rust;
use crate::print::{
    Expression, Flat, Statement, Statements, Value, Writer, array, call, fits, pattern, width,
};
use crate::program::{Array, ArrayRows, Block, Role, Routine, Routines, Row, Stage};

/// Prints one function.
pub(super) fn raw_function(writer: &mut Writer, spec: &Spec, routines: &Routines, routine: &Routine) {
    let statements = Statements::new(spec, Flat { routines, routine }, &Rust(&spec.tables));
    let head = if routine.function.is_some() { "pub fn" } else { "fn" };
    writer.documentation(routine.documentation);
    let arguments = arguments(routine, &statements.used);
    begin(writer, routine, &format!("{head} {}", routine.name), &arguments, statements.list.is_empty());
    if !statements.list.is_empty() {
        body(Printer { writer, routines, routine }, &statements);
    }
}

/// Returns `true` if one program gives both `J_e` and its distinct entries, which is the case for a
/// chain if neither is computed in loops.
pub(super) fn shares_columns(routines: &Routines) -> bool {
    let [dense, distinct] = [Function::ErrorJacobian, Function::ErrorJacobianDistinct]
        .map(|function| routines.function(function));
    let is_program =
        |routine: &Routine| matches!(&routine.stages[..], [Stage::Block(Block { repeated: None, .. })]);
    let is_shared = is_program(dense) && is_program(distinct) && dense.operations == distinct.operations;
    is_shared && routines.description.is_chain()
}

/// Prints `J_e` and its distinct entries by one shared function, which passes on each column as
/// soon as it is known.
pub(super) fn error_columns(writer: &mut Writer, spec: &Spec, routines: &Routines) {
    for function in [Function::ErrorJacobian, Function::ErrorJacobianDistinct] {
        let routine = routines.function(function);
        writer.documentation(routine.documentation);
        let all = vec![true; routine.arrays.len()];
        begin(writer, routine, &format!("pub fn {}", routine.name), &arguments(routine, &all), false);
        let names = routine.arrays.iter().filter(|array| array.role != Role::Margin);
        let names: Vec<&str> = names.map(|array| array.name).collect();
        let end = if names.len() < routine.arrays.len() { "" } else { ";" };
        writer.lines(&format!("error_columns({}){end}", names.join(", ")));
        writer.close("}");
        writer.blank();
    }
    let routine = routines.function(Function::ErrorJacobian);
    let statements = Statements::by_columns(spec, Flat { routines, routine }, &Rust(&spec.tables));
    let mut arguments = arguments(routine, &statements.used);
    if let Some(columns) = arguments.iter_mut().find(|argument| argument.starts_with("columns: ")) {
        *columns = "columns: &mut impl ErrorColumns<T>".to_owned();
    }
    writer.documentation("Computes either form of `J_e` and passes on each column as soon as it is known.");
    begin(writer, routine, "fn error_columns", &arguments, false);
    body(Printer { writer, routines, routine }, &statements);
}

/// Prints the head of a function.
fn begin(writer: &mut Writer, routine: &Routine, name: &str, arguments: &[String], is_empty: bool) {
    let has_margin = routine.arrays.iter().any(|array| array.role == Role::Margin);
    writer.lines("#[inline(always)]");
    let result = if has_margin { " -> T" } else { "" };
    writer.function(&format!("{name}<T: Scalar>"), arguments, result, is_empty);
}

fn arguments(routine: &Routine, used: &[bool]) -> Vec<String> {
    let outside = |(array, _): &(&Array, &bool)| matches!(array.role, Role::Argument | Role::Result);
    routine.arrays.iter().zip(used).filter(outside).map(argument).collect()
}

/// Prints the statements of a function and its end.
fn body(mut printer: Printer<'_>, Statements { list, constants, .. }: &Statements) {
    let given = list.iter().take_while(|statement| printer.unpacks_argument(statement)).count();
    for (index, statement) in list.iter().enumerate() {
        if index == given {
            printer.constants(*constants);
        }
        if let (Statement::Call { routine, arrays, fresh }, Some(Statement::Return(_))) =
            (statement, list.get(index + 1))
            && printer.gives_margin(arrays)
        {
            // A value that is returned immediately needs no name.
            let call = printer.call(routine, arrays, fresh);
            printer.writer.lines(&call);
            break;
        }
        printer.statement(statement);
    }
    if given == list.len() {
        printer.constants(*constants);
    }
    printer.writer.close("}");
}

/// Returns `name: &[T; SIZE]`, or mutable; the names of unused arguments start with an underscore.
fn argument((array, used): (&Array, &bool)) -> String {
    let unused = if *used { "" } else { "_" };
    let reference = if array.role == Role::Argument { "&" } else { "&mut " };
    format!("{unused}{}: {reference}{}", array.name, nested("T", array))
}

/// Returns the type of an array or an array of equal elements, from its innermost element.
fn nested(element: &str, array: &Array) -> String {
    let outer = |inner: String, count: &Count| format!("[{inner}; {}]", size(*count));
    array.shape.iter().rev().fold(element.to_owned(), outer)
}

/// Returns the name of a dimension.
fn size(count: Count) -> String {
    match count {
        Count::Exactly(count) => count.to_string(),
        Count::FramesAndTool => "FRAMES + 1".to_owned(),
        Count::BaseToTool => "FRAMES + 2".to_owned(),
        count => format!("{count:?}").to_ascii_uppercase(),
    }
}

/// Returns the index of the last of this many rows.
fn last(count: Count) -> String {
    match count {
        Count::FramesAndTool => "FRAMES".to_owned(),
        Count::BaseToTool => "FRAMES + 1".to_owned(),
        count => format!("{} - 1", size(count)),
    }
}

struct Printer<'p> {
    writer: &'p mut Writer,
    routines: &'p Routines,
    routine: &'p Routine,
}

impl Printer<'_> {
    fn unpacks_argument(&self, statement: &Statement) -> bool {
        matches!(statement, Statement::Unpack { from: ArrayRows { array, row: Row::All }, .. }
            if self.routine.arrays[*array].role == Role::Argument)
    }

    /// Prints the names of 0 and 1 if they are results.
    fn constants(&mut self, [zero, one]: [bool; 2]) {
        for (used, line) in [(zero, "let zero = T::constant(0.0);"), (one, "let one = T::constant(1.0);")] {
            if used {
                self.writer.lines(line);
            }
        }
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Unpack { names, from } => self.unpack(names, *from),
            Statement::Comment(text) => self.writer.comment(text),
            Statement::Let { name, value } => self.writer.lines(&format!("let {name} = {value};")),
            Statement::SinCos(pairs) => self.sines_and_cosines(pairs),
            Statement::Declare(array) => self.declare(*array),
            Statement::Clear(array) => {
                let array = &self.routine.arrays[*array];
                let value = nested("zero", array);
                let reference = if array.role == Role::Result { "*" } else { "" };
                self.writer.lines(&format!("{reference}{} = {value};", array.name));
            }
            Statement::Copy { from, to, fresh } => self.copy(*from, *to, *fresh),
            Statement::Assign { to, index, values, fresh } => self.assign(*to, *index, values, *fresh),
            Statement::Column { index, part, values } => self.give_column(*index, part, values),
            Statement::Call { routine, arrays, fresh } => {
                let named = if self.gives_margin(arrays) { "let margin = " } else { "" };
                let call = self.call(routine, arrays, fresh);
                self.writer.lines(&format!("{named}{call};"));
            }
            Statement::Sums { sums, terms, entries } => self.sums(*sums, *terms, *entries),
            Statement::For { repeated, body } => {
                let count = size(repeated.count);
                let range =
                    if repeated.backwards { format!("(0..{count}).rev()") } else { format!("0..{count}") };
                let counter = if body.iter().any(Statement::is_counted) { "i" } else { "_" };
                self.writer.open(&format!("for {counter} in {range}"));
                body.iter().for_each(|statement| self.statement(statement));
                if let Some(array) = repeated.while_positive {
                    let name = self.routine.arrays[array].name;
                    self.writer.open(&format!("if !{name}[0].is_positive()"));
                    self.writer.lines("break;");
                    self.writer.close("}");
                }
                self.writer.close("}");
            }
            Statement::Return(value) => self.writer.lines(value),
        }
    }

    fn unpack(&mut self, names: &[Option<String>], from: ArrayRows) {
        let array = &self.routine.arrays[from.array];
        let indent = self.writer.indent();
        let mut entries: Vec<String> =
            names.iter().map(|name| name.clone().unwrap_or_else(|| "_".to_owned())).collect();
        let nested = from.row == Row::All && array.shape.len() > 1 || array.row_rank() > 1;
        if nested && let Some(Count::Exactly(inner)) = array.shape.last() {
            let join = |entries: &[String]| match entries.iter().all(|entry| entry == "_") {
                true if array.role != Role::Argument => "_".to_owned(),
                _ => format!("[{}]", entries.join(", ")),
            };
            entries = entries.chunks(*inner).map(join).collect();
        }
        let place = self.place(from, 0);
        if let ([Some(name)], Row::Each { .. }) = (names, from.row) {
            return self.writer.lines(&format!("let {name} = {place};"));
        }
        let names = pattern(indent, "let ", &entries, " =");
        let last = names.lines().last().map_or(0, width);
        let fits = fits(indent, last + width(&place) + " ;".len());
        self.writer.lines(&if fits { format!("{names} {place};") } else { format!("{names}\n    {place};") });
    }

    /// Prints `let (s1, c1) = q1.sin_cos();`, or many pairs together.
    fn sines_and_cosines(&mut self, pairs: &[([String; 2], Expression)]) {
        let indent = self.writer.indent();
        let names: Vec<String> = pairs.iter().map(|([s, c], _)| format!("({s}, {c})")).collect();
        if let [(_, angle)] = pairs {
            let angle = angle.at_least(crate::print::expression::Binding::Atom);
            return self.writer.lines(&format!("let {} = {angle}.sin_cos();", names[0]));
        }
        let angles: Vec<String> = pairs.iter().map(|(_, angle)| angle.text.clone()).collect();
        let names = pattern(indent, "let ", &names, " =");
        let last = names.lines().last().map_or(0, width);
        let value = array(indent, "T::sin_cos_each(", &angles, ");");
        let first = value.lines().next().map_or(0, width);
        if fits(indent, last + 1 + first) {
            self.writer.lines(&format!("{names} {value}"));
        } else {
            self.writer.lines(&format!("{names}\n    {}", value.replace('\n', "\n    ")));
        }
    }

    fn declare(&mut self, array: usize) {
        let array = &self.routine.arrays[array];
        if array.role == Role::Zeros {
            let value = nested("zero", array);
            self.writer.lines(&format!("let mut {} = {value};", array.name));
        }
    }

    fn copy(&mut self, from: ArrayRows, to: usize, fresh: bool) {
        let from_rows = self.place(from, 0);
        let line = match from.row {
            _ if fresh => {
                let begins = self.begins(to);
                format!("{begins}{} = {from_rows};", self.routine.arrays[to].name)
            }
            Row::AllButFirst => {
                format!("<[_]>::copy_from_slice({}, &{from_rows});", self.routine.arrays[to].name)
            }
            _ => format!("{} = {from_rows};", self.place(ArrayRows::all(to), 0)),
        };
        self.writer.lines(&line);
    }

    /// Prints `columns.along(0, [x, y, z]);` for a translation, and `moment` and `turn` for a
    /// rotation.
    fn give_column(&mut self, index: usize, part: &str, values: &[Value]) {
        let entries: Vec<String> = match values.iter().all(|value| value.is_zero) {
            true => vec!["zero; 3".to_owned()],
            false => values.iter().map(|value| value.text.clone()).collect(),
        };
        let indent = self.writer.indent();
        let vector = array(indent + 4, "", &entries, "");
        let call = call(indent, &format!("columns.{part}"), &[index.to_string(), vector]);
        self.writer.lines(&(call + ";"));
    }

    /// Returns the beginning of a declaration with values, which is mutable if others follow.
    fn begins(&self, array: usize) -> &'static str {
        if self.routine.writes(array) > 1 { "let mut " } else { "let " }
    }

    fn assign(&mut self, to: ArrayRows, index: usize, values: &[Value], fresh: bool) {
        let target = &self.routine.arrays[to.array];
        let begins = if fresh { self.begins(to.array) } else { "" };
        let before = format!("{begins}{} = ", self.place(to, index));
        let indent = self.writer.indent();
        let text =
            |values: &[Value]| -> Vec<String> { values.iter().map(|value| value.text.clone()).collect() };
        let entries: Vec<String> = match (target.row_rank(), target.shape.last()) {
            (2, Some(Count::Exactly(inner))) => {
                values.chunks(*inner).map(|row| array(indent + 4, "", &text(row), "")).collect()
            }
            _ if !values.is_empty() && values.iter().all(|value| value.is_zero) => {
                vec![format!("zero; {}", values.len())]
            }
            _ => text(values),
        };
        self.writer.array(&before, &entries, ";");
    }

    /// Returns the expression of a row of an array, or of all of it.
    fn place(&self, ArrayRows { array, row }: ArrayRows, index: usize) -> String {
        let array = &self.routine.arrays[array];
        let outer = &array.shape[..array.shape.len() - array.row_rank()];
        let inner = |row: usize| match outer {
            [_, count] => {
                let count = count.value(&self.routines.description);
                format!("[{}][{}]", row / count, row % count)
            }
            _ => format!("[{row}]"),
        };
        let name = array.name;
        match row {
            Row::All if outer.is_empty() || (index == 0 && array.role == Role::Argument) => {
                let reference = matches!(array.role, Role::Argument | Role::Result);
                format!("{}{name}", if reference { "*" } else { "" })
            }
            Row::All => format!("{name}{}", inner(index)),
            Row::First => format!("{name}[0]"),
            Row::Last => format!("{name}[{}]", last(array.shape[0])),
            Row::AllButFirst => format!("{name}[1..]"),
            Row::Each { stride: 1, offset: 0 } => format!("{name}[i]"),
            Row::Each { stride: 1, offset } => format!("{name}[i + {offset}]"),
            Row::Each { offset, .. } if outer.len() == 2 => format!("{name}[i][{offset}]"),
            Row::Each { stride, offset: 0 } => format!("{name}[{stride} * i]"),
            Row::Each { stride, offset } => format!("{name}[{stride} * i + {offset}]"),
            Row::Listed { table, column } => {
                format!("{name}[{}[i].{column}]", self.routines.tables[table].name)
            }
        }
    }

    /// Returns `true` if a call returns the margin.
    fn gives_margin(&self, arrays: &[usize]) -> bool {
        arrays.iter().any(|array| self.routine.arrays[*array].role == Role::Margin)
    }

    /// Declares the arrays that a call initializes, and returns the call.
    fn call(&mut self, routine: &str, arrays: &[usize], fresh: &[usize]) -> String {
        fresh.iter().for_each(|array| self.declare(*array));
        let callee = self.routines.named(routine);
        let mut arguments = Vec::new();
        for (array, wanted) in arrays.iter().zip(&callee.arrays) {
            let array = &self.routine.arrays[*array];
            let is_local = array.role == Role::Zeros;
            let mutable = if wanted.role == Role::Argument { "&" } else { "&mut " };
            match wanted.role {
                Role::Margin => {}
                // A single row of an array of several dimensions.
                _ if array.shape.len() > wanted.shape.len() => {
                    arguments.push(format!("&mut {}[0]", array.name));
                }
                _ if is_local => arguments.push(format!("{mutable}{}", array.name)),
                _ => arguments.push(array.name.to_owned()),
            }
        }
        // A result may have the name of the function.
        let path = if self.routine.arrays.iter().any(|array| array.name == routine) { "self::" } else { "" };
        format!("{path}{routine}({})", arguments.join(", "))
    }

    fn sums(&mut self, sums: usize, terms: usize, entries: usize) {
        let name = self.routines.sums[sums].name;
        let [terms, entries] = [terms, entries].map(|array| &self.routine.arrays[array]);
        let flattened = ".as_flattened_mut()".repeat(entries.shape.len() - 1);
        let terms = terms.name;
        self.writer.lines(&format!("let entries = {}{flattened};", entries.name));
        self.writer
            .open(&format!("for (entry, constant) in ::core::iter::zip(&mut *entries, &{name}_CONSTANTS)"));
        self.writer.lines("*entry = T::constant(*constant);");
        self.writer.close("}");
        self.writer.open(&format!("for &(entry, term, factor) in &{name}_FACTORS"));
        self.writer
            .lines(&format!("entries[entry] = {terms}[term].mul_add(T::constant(factor), entries[entry]);"));
        self.writer.close("}");
    }
}
