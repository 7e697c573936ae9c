//! Prints routines as function blocks.

use std::collections::HashSet;

use abbe_core::function::Array as Described;
use abbe_spec::Spec;

use super::declarations::{
    argument, array, array_name, array_type, comment, document, numbers, section, variables,
};
use super::operators::{StructuredText, instance, number};
use crate::print::flat::{Flat, filled};
use crate::print::layout::Writer;
use crate::print::statement::Statement;
use crate::print::statements::Statements;
use crate::program::{Array, ArrayRows, Role, Routine, Routines, Row, Stage};

/// Prints one function block.
pub(super) fn block(
    writer: &mut Writer,
    spec: &Spec,
    routines: &Routines,
    routine: &Routine,
    syntax: &StructuredText,
) {
    let Statements { list, .. } = Statements::new(spec, &routines.description, routine, syntax);
    let mut printer = Printer { writer, spec, flat: Flat { routines, routine }, prefix: &syntax.prefix };
    printer.writer.blank();
    comment(printer.writer, routine.documentation);
    printer.writer.lines(&format!("FUNCTION_BLOCK {}_{}", syntax.prefix, routine.name));
    printer.arguments();
    printer.results();
    printer.locals(&list);
    printer.constants();
    printer.begin();
    list.iter().for_each(|statement| printer.statement(statement));
    printer.end();
    printer.writer.lines("END_FUNCTION_BLOCK");
}

struct Printer<'p> {
    writer: &'p mut Writer,
    spec: &'p Spec,
    flat: Flat<'p>,
    prefix: &'p str,
}

impl Printer<'_> {
    fn name(&self, array: usize) -> &'static str {
        array_name(self.flat.routine.arrays[array].name)
    }

    /// Returns the arrays of a role that have elements.
    fn arrays(&self, role: Role) -> Vec<usize> {
        let arrays = &self.flat.routine.arrays;
        (0..arrays.len()).filter(|array| arrays[*array].role == role && self.flat.len(*array) > 0).collect()
    }

    fn has_margin(&self) -> bool {
        !self.arrays(Role::Margin).is_empty()
    }

    /// Returns the description of an array of a function.
    fn described(&self, array: usize) -> Option<&'static Described> {
        let signature = self.flat.routine.function?.signature();
        let name = self.flat.routine.arrays[array].name;
        signature.arguments.iter().chain(signature.results).find(|one| one.name == name)
    }

    fn arguments(&mut self) {
        let arrays = self.arrays(Role::Argument);
        if arrays.is_empty() {
            return;
        }
        self.writer.begin("VAR_INPUT");
        for array in arrays {
            let description = &self.flat.routines.description;
            match self.described(array) {
                Some(described) => argument(self.writer, self.spec, description, described),
                None => self.local_array(array),
            }
        }
        self.writer.close("END_VAR");
    }

    fn results(&mut self) {
        self.writer.begin("VAR_OUTPUT");
        for array in self.arrays(Role::Result) {
            if let Some(described) = self.described(array) {
                document(self.writer, &self.flat.routines.description, described);
            }
            self.local_array(array);
        }
        if self.has_margin() {
            comment(self.writer, "cos(rho); where it is 0, rows 4-6 are undefined.");
            self.writer.lines("margin : LREAL;");
        }
        self.writer.lines("status : INT := 1;");
        self.writer.close("END_VAR");
    }

    fn local_array(&mut self, array: usize) {
        let (name, count) = (self.name(array), self.flat.len(array));
        self.writer.lines(&format!("{name} : {};", array_type(count, "LREAL")));
    }

    /// Prints the variables of the body: instances of other blocks, local arrays and numbers.
    fn locals(&mut self, list: &[Statement]) {
        self.writer.begin("VAR");
        let mut called = HashSet::new();
        for stage in &self.flat.routine.stages {
            if let Stage::Call { routine, .. } = stage
                && called.insert(*routine)
            {
                self.writer.lines(&format!("{} : {}_{routine};", instance(routine), self.prefix));
            }
        }
        for array in self.arrays(Role::Zeros) {
            self.local_array(array);
        }
        let mut names = Vec::new();
        named(list, &mut names);
        let mut known = HashSet::new();
        names.retain(|name: &String| known.insert(name.to_ascii_lowercase()));
        variables(self.writer, &names, "LREAL");
        self.writer.lines("total : LREAL;");
        self.writer.lines("i, k : DINT;");
        self.writer.lines("fault : BOOL;");
        self.writer.close("END_VAR");
    }

    /// Prints the tables that the block reads.
    fn constants(&mut self) {
        let inputs = self.checks_inputs();
        let (mut tables, mut sums) = (Vec::new(), Vec::new());
        for stage in &self.flat.routine.stages {
            match stage {
                Stage::Block(block) => {
                    tables.extend(block.reads.iter().chain(&block.writes).filter_map(
                        |place| match place.row {
                            Row::Listed { table, .. } => Some(table),
                            _ => None,
                        },
                    ));
                }
                Stage::Sums { sums: index, .. } => sums.push(*index),
                _ => {}
            }
        }
        tables.sort_unstable();
        tables.dedup();
        if !inputs && tables.is_empty() && sums.is_empty() {
            return;
        }
        section(self.writer, "VAR CONSTANT", |writer| {
            if inputs {
                let ends = |end: usize| self.spec.inputs.iter().map(|one| one.range[end]).collect::<Vec<_>>();
                numbers(writer, "lower_ranges", &ends(0));
                numbers(writer, "upper_ranges", &ends(1));
            }
            for table in tables {
                let table = &self.flat.routines.tables[table];
                comment(writer, table.documentation);
                for column in 0..2 {
                    let values: Vec<String> = table.rows.iter().map(|row| row[column].to_string()).collect();
                    array(writer, &format!("{}_{column}", table.name), "DINT", &values);
                }
            }
            for sums in sums.into_iter().map(|index| &self.flat.routines.sums[index]) {
                let name = sums.name;
                if !sums.constants.is_empty() {
                    numbers(writer, &format!("{name}_CONSTANTS"), &sums.constants);
                }
                if !sums.factors.is_empty() {
                    let column = |take: fn(&(usize, usize, f64)) -> usize| {
                        sums.factors.iter().map(|row| take(row).to_string()).collect::<Vec<_>>()
                    };
                    array(writer, &format!("{name}_ENTRIES"), "DINT", &column(|row| row.0));
                    array(writer, &format!("{name}_TERMS"), "DINT", &column(|row| row.1));
                    let factors: Vec<f64> = sums.factors.iter().map(|row| row.2).collect();
                    numbers(writer, &format!("{name}_FACTORS"), &factors);
                }
            }
        });
    }

    /// Returns `true` if the ranges of inputs are checked.
    fn checks_inputs(&self) -> bool {
        let arguments = self.arrays(Role::Argument);
        self.flat.routine.function.is_some()
            && arguments.into_iter().any(|array| self.name(array) == "inputs")
    }

    /// Prints the checks of the arguments.
    fn begin(&mut self) {
        self.writer.lines("fault := FALSE;");
        if self.flat.routine.function.is_none() {
            return;
        }
        if self.checks_inputs() {
            let count = self.spec.inputs.len();
            self.count("k", count);
            let within = format!("{}_is_within(inputs[k], lower_ranges[k], upper_ranges[k])", self.prefix);
            self.writer.lines(&format!("fault := fault OR NOT {within};"));
            self.writer.close("END_FOR;");
            self.leave("fault", "3");
        }
        let arrays = self.arrays(Role::Argument);
        let arrays: Vec<usize> = arrays.into_iter().filter(|array| self.name(*array) != "inputs").collect();
        if !arrays.is_empty() {
            self.sum(&arrays);
            let prefix = self.prefix;
            self.leave(&format!("NOT {prefix}_is_within(total, LREAL#0.0, LREAL#1.0E30)"), "1");
        }
    }

    /// Prints the sum of the sizes of all numbers of arrays, which is finite only if they are.
    fn sum(&mut self, arrays: &[usize]) {
        self.writer.lines("total := LREAL#0.0;");
        for array in arrays {
            let (name, count) = (self.name(*array), self.flat.len(*array));
            self.count("k", count);
            self.writer.lines(&format!("total := total + ABS({name}[k]);"));
            self.writer.close("END_FOR;");
        }
    }

    fn leave(&mut self, condition: &str, status: &str) {
        self.writer.begin(&format!("IF {condition} THEN"));
        self.writer.lines(&format!("status := {status};"));
        self.writer.lines("RETURN;");
        self.writer.close("END_IF;");
    }

    /// Prints the checks of the results and the status.
    fn end(&mut self) {
        if self.flat.routine.function.is_some() {
            if self.has_margin() {
                let least = number(abbe_core::MINIMUM_MARGIN);
                self.leave(&format!("NOT (margin >= {least})"), "2");
            }
            let results = self.arrays(Role::Result);
            if !results.is_empty() {
                self.sum(&results);
                let prefix = self.prefix;
                self.writer.lines(&format!(
                    "fault := fault OR NOT {prefix}_is_within(total, LREAL#0.0, LREAL#1.0E300);"
                ));
            }
        }
        self.writer.lines("status := 0;");
        self.writer.begin("IF fault THEN");
        self.writer.lines("status := 1;");
        self.writer.close("END_IF;");
    }

    fn count(&mut self, counter: &str, count: usize) {
        self.writer.begin(&format!("FOR {counter} := 0 TO {} DO", count - 1));
    }

    fn clear(&mut self, array: usize) {
        let (name, count) = (self.name(array), self.flat.len(array));
        self.count("k", count);
        self.writer.lines(&format!("{name}[k] := LREAL#0.0;"));
        self.writer.close("END_FOR;");
    }

    fn place(&self, place: ArrayRows, index: usize, k: usize) -> String {
        let listed = |table: &str, column| format!("{table}_{column}[i]");
        format!("{}[{}]", self.name(place.array), self.flat.index(place, index, k, listed))
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Unpack { names, from } => {
                let named = names.iter().enumerate().filter_map(|(k, name)| Some((k, name.as_ref()?)));
                for (k, name) in named {
                    self.writer.lines(&format!("{name} := {};", self.place(*from, 0, k)));
                }
            }
            Statement::Comment(text) => comment(self.writer, text),
            Statement::Let { name, value } => self.writer.lines(&format!("{name} := {value};")),
            Statement::SinCos(pairs) => {
                for ([sine, cosine], angle) in pairs {
                    let (prefix, angle) = (self.prefix, &angle.text);
                    self.writer.lines(&format!("{cosine} := {prefix}_cosine_and_sine({angle}, {sine});"));
                }
            }
            Statement::Declare(array)
                if !self.flat.keeps_zeros(*array) && !self.flat.begins_whole(*array) =>
            {
                self.clear(*array);
            }
            Statement::Declare(_) => {}
            // Local arrays are cleared where they are declared.
            Statement::Clear(array) if self.flat.routine.arrays[*array].role == Role::Zeros => {}
            Statement::Clear(array) => self.clear(*array),
            Statement::Copy { from, to, .. } => {
                let [first, _] = self.flat.range(*from);
                let (from, to, count) = (self.name(from.array), self.name(*to), self.flat.len(*to));
                let at = if first == 0 { "k".to_owned() } else { format!("k + {first}") };
                self.count("k", count);
                self.writer.lines(&format!("{to}[k] := {from}[{at}];"));
                self.writer.close("END_FOR;");
            }
            Statement::Assign { to, index, values, .. } => {
                let keeps_zeros = self.flat.keeps_zeros(to.array);
                let values = values.iter().enumerate().filter(|(_, value)| !(keeps_zeros && value.is_zero));
                let entry = |(k, value): (usize, &crate::print::expression::Value)| {
                    format!("{} := {}", self.place(*to, *index, k), value.text)
                };
                let entries: Vec<String> = values.map(entry).collect();
                filled(self.writer, "", &entries, "; ");
            }
            Statement::Call { routine, arrays, .. } => self.call(routine, arrays),
            Statement::Sums { sums, terms, entries } => self.sums(*sums, *terms, *entries),
            Statement::For { repeated, body } => {
                let count = repeated.count.value(&self.flat.routines.description);
                match repeated.backwards {
                    _ if count == 0 => return,
                    false => self.count("i", count),
                    true => self.writer.begin(&format!("FOR i := {} TO 0 BY -1 DO", count - 1)),
                }
                body.iter().for_each(|statement| self.statement(statement));
                self.writer.close("END_FOR;");
            }
            Statement::Return(margin) if margin != "margin" => {
                self.writer.lines(&format!("margin := {margin};"));
            }
            // Columns go to arrays.
            Statement::Return(_) | Statement::Column { .. } => {}
        }
    }

    fn sums(&mut self, sums: usize, terms: usize, entries: usize) {
        let sums = &self.flat.routines.sums[sums];
        let [terms, entries] = [terms, entries].map(|array| self.name(array));
        let name = sums.name;
        if !sums.constants.is_empty() {
            self.count("k", sums.constants.len());
            self.writer.lines(&format!("{entries}[k] := {name}_CONSTANTS[k];"));
            self.writer.close("END_FOR;");
        }
        if !sums.factors.is_empty() {
            self.count("k", sums.factors.len());
            let entry = format!("{entries}[{name}_ENTRIES[k]]");
            let product = format!("{name}_FACTORS[k] * {terms}[{name}_TERMS[k]]");
            self.writer.lines(&format!("{entry} := {entry} + {product};"));
            self.writer.close("END_FOR;");
        }
    }

    fn call(&mut self, routine: &str, arrays: &[usize]) {
        let callee = self.flat.routines.named(routine);
        let run = instance(routine);
        let both = || {
            let both = arrays.iter().zip(&callee.arrays);
            both.filter(|(array, _)| self.flat.len(**array) > 0).map(|(array, other)| (*array, other))
        };
        let given =
            |(array, other): (usize, &Array)| format!("{} := {}", array_name(other.name), self.name(array));
        let given: Vec<String> =
            both().filter(|(_, other)| other.role == Role::Argument).map(given).collect();
        let mut lines = vec![format!("{run}({});", given.join(", "))];
        for (array, other) in both().filter(|(_, other)| other.role != Role::Argument) {
            lines.push(format!("{} := {run}.{};", self.name(array), array_name(other.name)));
        }
        lines.iter().for_each(|line| self.writer.lines(line));
        self.writer.begin(&format!("IF {run}.status <> 0 THEN"));
        self.writer.lines(&format!("status := {run}.status;"));
        self.writer.lines("RETURN;");
        self.writer.close("END_IF;");
    }
}

/// Collects the names of numbers.
fn named(list: &[Statement], names: &mut Vec<String>) {
    for statement in list {
        match statement {
            Statement::Unpack { names: some, .. } => names.extend(some.iter().flatten().cloned()),
            Statement::Let { name, .. } => names.push(name.clone()),
            Statement::SinCos(pairs) => names.extend(pairs.iter().flat_map(|(pair, _)| pair.clone())),
            Statement::For { body, .. } => named(body, names),
            _ => {}
        }
    }
}
