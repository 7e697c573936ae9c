//! Prints routines as function blocks.

use std::collections::HashSet;

use abbe_core::function::Array as Described;
use abbe_spec::Spec;

use super::declarations::{argument, array, array_name, array_type, document, numbers, section, variables};
use super::procedures::BlockPrinter;
use super::{StructuredText, comment, initial, instance, number};
use crate::print::lists::lists;
use crate::print::routine::statements;
use crate::print::{Flat, Printer, Statement, Statements, Writer};
use crate::program::{Role, Routine, Routines, Row, Stage};

/// Largest sum of the sizes of results, of numbers that are a REAL as well.
const LARGEST: &str = "LREAL#1.0E37 * LREAL#1.0E37";

/// Prints one function block.
pub(super) fn block(
    writer: &mut Writer,
    spec: &Spec,
    routines: &Routines,
    routine: &Routine,
    syntax: &StructuredText,
) {
    let (flat, prefix) = (Flat { routines, routine }, &syntax.prefix[..]);
    let Statements { list, .. } = Statements::new(spec, flat, syntax);
    writer.blank();
    comment(writer, routine.documentation);
    writer.lines(&format!("FUNCTION_BLOCK {prefix}_{}", routine.name));
    let printer = BlockPrinter { writer, routines, prefix, procedures: &[] };
    let mut block = Block { printer, spec, flat };
    block.arguments();
    block.results();
    block.locals(&list);
    block.constants();
    block.begin();
    let margin = statements(&mut block.printer, flat, &list);
    block.end(margin);
    writer.lines("END_FUNCTION_BLOCK");
}

/// The declarations and checks of a block.
struct Block<'p> {
    printer: BlockPrinter<'p>,
    spec: &'p Spec,
    flat: Flat<'p>,
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
        self.printer.writer.begin("VAR_INPUT");
        for array in arrays {
            let description = &self.flat.routines.description;
            match self.described(array) {
                Some(described) => {
                    argument(self.printer.writer, self.printer.prefix, self.spec, description, described);
                }
                None => self.local_array(array),
            }
        }
        self.printer.writer.close("END_VAR");
    }

    fn results(&mut self) {
        self.printer.writer.begin("VAR_OUTPUT");
        for array in self.arrays(Role::Result) {
            if let Some(described) = self.described(array) {
                document(self.printer.writer, &self.flat.routines.description, described);
            }
            self.local_array(array);
        }
        if self.has_margin() {
            comment(self.printer.writer, "cos(rho); where it is 0, rows 4-6 are undefined.");
            self.printer.writer.lines("margin : LREAL;");
        }
        self.printer.writer.lines("status : INT := 1;");
        self.printer.writer.close("END_VAR");
    }

    fn local_array(&mut self, array: usize) {
        let (name, count) = (self.name(array), self.flat.len(array));
        let of_type = array_type(self.printer.writer, self.printer.prefix, count, "LREAL");
        self.printer.writer.lines(&format!("{name} : {of_type};"));
    }

    /// Prints the variables of the body: instances of other blocks, local arrays and numbers.
    fn locals(&mut self, list: &[Statement]) {
        self.printer.writer.begin("VAR");
        let mut called = HashSet::new();
        for stage in &self.flat.routine.stages {
            if let Stage::Call { routine, .. } = stage
                && called.insert(*routine)
            {
                let prefix = self.printer.prefix;
                self.printer.writer.lines(&format!("{} : {prefix}_{routine};", instance(routine)));
            }
        }
        for array in self.arrays(Role::Zeros) {
            self.local_array(array);
        }
        let mut names = Vec::new();
        named(list, &mut names);
        let mut known = HashSet::new();
        names.retain(|name: &String| known.insert(name.to_ascii_lowercase()));
        variables(self.printer.writer, &names, "LREAL");
        self.printer.writer.lines("total : LREAL;");
        self.printer.writer.lines("i, k : DINT;");
        self.printer.writer.lines("fault : BOOL;");
        self.printer.writer.close("END_VAR");
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
        let prefix = self.printer.prefix;
        section(self.printer.writer, "VAR CONSTANT", |writer| {
            if inputs {
                let ends = |end: usize| self.spec.inputs.iter().map(|one| one.range[end]).collect::<Vec<_>>();
                numbers(writer, prefix, "lower_ranges", &ends(0));
                numbers(writer, prefix, "upper_ranges", &ends(1));
            }
            let Routines { tables: all, sums: all_sums, .. } = self.flat.routines;
            let (tables, sums) =
                (tables.iter().map(|index| &all[*index]), sums.iter().map(|k| &all_sums[*k]));
            for list in lists(tables, sums) {
                comment(writer, list.documentation);
                let element = if list.is_whole { "DINT" } else { "LREAL" };
                array(writer, prefix, &list.name, element, &list.entries(initial));
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
        self.printer.assign("fault", "FALSE", None);
        if self.flat.routine.function.is_none() {
            return;
        }
        if self.checks_inputs() {
            let within =
                format!("{}_is_within(inputs[k], lower_ranges[k], upper_ranges[k])", self.printer.prefix);
            self.each(self.spec.inputs.len(), "fault", &format!("fault OR NOT {within}"));
            self.printer.leave("fault", "3");
        }
        let arrays = self.arrays(Role::Argument);
        let arrays: Vec<usize> = arrays.into_iter().filter(|array| self.name(*array) != "inputs").collect();
        if !arrays.is_empty() {
            let is_huge = self.exceeds(&arrays, "LREAL#1.0E30");
            self.printer.leave(&is_huge, "1");
        }
    }

    /// Prints an assignment for each number of an array.
    fn each(&mut self, count: usize, place: &str, value: &str) {
        let range = [0.into(), count.into()];
        self.printer.repeat("k", &range, false, |printer| printer.assign(place, value, None));
    }

    /// Prints the sum of the sizes of all numbers of arrays, which is finite only if they are, and
    /// returns the condition that it exceeds a limit.
    fn exceeds(&mut self, arrays: &[usize], limit: &str) -> String {
        self.printer.assign("total", "LREAL#0.0", None);
        for array in arrays {
            let (name, count) = (self.name(*array), self.flat.len(*array));
            self.each(count, "total", &format!("total + ABS({name}[k])"));
        }
        format!("NOT {}_is_within(total, LREAL#0.0, {limit})", self.printer.prefix)
    }

    /// Prints the checks of the results and the status.
    fn end(&mut self, margin: Option<&str>) {
        if let Some(margin) = margin.filter(|margin| *margin != "margin") {
            self.printer.assign("margin", margin, None);
        }
        if self.flat.routine.function.is_some() {
            if self.has_margin() {
                self.printer.leave(&format!("NOT (margin >= {})", number(abbe_core::MINIMUM_MARGIN)), "2");
            }
            let results = self.arrays(Role::Result);
            if !results.is_empty() {
                let is_huge = self.exceeds(&results, LARGEST);
                self.printer.assign("fault", &format!("fault OR {is_huge}"), None);
            }
        }
        self.printer.assign("status", "0", None);
        // Arguments have been checked before.
        let open = self.flat.routine.function.is_some() && self.flat.routines.description.has_loops();
        self.printer.guard("fault", if open { "status := -1;" } else { "status := 1;" });
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
