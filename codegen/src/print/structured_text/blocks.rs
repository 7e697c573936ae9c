//! Prints routines as function blocks.

use std::collections::HashSet;

use abbe_core::function::Array as Described;
use abbe_spec::Spec;

use super::declarations::{
    argument, array, array_name, array_type, comment, document, numbers, section, variables,
};
use super::operators::{StructuredText, initial, instance, number};
use super::procedures::BlockPrinter;
use crate::print::flat::Flat;
use crate::print::layout::Writer;
use crate::print::lists::lists;
use crate::print::routine::statements;
use crate::print::statement::Statement;
use crate::print::statements::Statements;
use crate::program::{Role, Routine, Routines, Row, Stage};

/// Prints one function block.
pub(super) fn block(
    writer: &mut Writer,
    spec: &Spec,
    routines: &Routines,
    routine: &Routine,
    syntax: &StructuredText,
) {
    let Statements { list, .. } = Statements::new(spec, &routines.description, routine, syntax);
    let (flat, prefix) = (Flat { routines, routine }, &syntax.prefix[..]);
    let mut printer = Block { writer, spec, flat, prefix };
    printer.writer.blank();
    comment(printer.writer, routine.documentation);
    printer.writer.lines(&format!("FUNCTION_BLOCK {}_{}", syntax.prefix, routine.name));
    printer.arguments();
    printer.results();
    printer.locals(&list);
    printer.constants();
    printer.begin();
    let mut body = BlockPrinter { writer: printer.writer, routines, prefix, procedures: &[] };
    let margin = statements(&mut body, flat, &list);
    printer.end(margin);
    printer.writer.lines("END_FUNCTION_BLOCK");
}

/// The declarations and checks of a block.
struct Block<'p> {
    writer: &'p mut Writer,
    spec: &'p Spec,
    flat: Flat<'p>,
    prefix: &'p str,
}

impl Block<'_> {
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
            let Routines { tables: all, sums: all_sums, .. } = self.flat.routines;
            let (tables, sums) =
                (tables.iter().map(|index| &all[*index]), sums.iter().map(|k| &all_sums[*k]));
            for list in lists(tables, sums) {
                comment(writer, list.documentation);
                let element = if list.is_whole { "DINT" } else { "LREAL" };
                array(writer, &list.name, element, &list.entries(initial));
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
    fn end(&mut self, margin: Option<&str>) {
        if let Some(margin) = margin.filter(|margin| *margin != "margin") {
            self.writer.lines(&format!("margin := {margin};"));
        }
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
