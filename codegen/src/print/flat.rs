//! Flat arrays of a routine, for languages without arrays of arrays.

use super::{NARROW, Writer, width};
use crate::program::{ArrayRows, Block, Role, Routine, Routines, Row, Stage};

/// Memory of the results of a function.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Results {
    /// The function creates them, filled with zeros.
    Created,
    /// The caller gives them, with any numbers.
    Given,
    /// They keep their numbers from call to call.
    Kept,
}

/// The arrays of one routine.
#[derive(Clone, Copy)]
pub(super) struct Flat<'p> {
    pub(super) routines: &'p Routines,
    pub(super) routine: &'p Routine,
}

impl Flat<'_> {
    /// Returns the number of elements of an array.
    pub(super) fn len(&self, array: usize) -> usize {
        self.routine.arrays[array].len(&self.routines.description)
    }

    /// Returns `true` if an array need not be cleared, and zeros need not be assigned to it: a
    /// result keeps its numbers from call to call, so that entries which nothing but a zero is
    /// assigned to are always 0.
    pub(super) fn keeps_zeros(&self, array: usize) -> bool {
        let Routine { arrays, stages, .. } = self.routine;
        let repeats = |stage: &Stage| {
            matches!(stage, Stage::Block(Block { repeated: Some(_), .. })) && stage.writes(array)
        };
        let is_written_once = self.routine.writes(array) == 1;
        arrays[array].role == Role::Result && is_written_once && !stages.iter().any(repeats)
    }

    /// Returns `true` if the first stage that writes a result writes all of it.
    pub(super) fn begins_whole(&self, array: usize) -> bool {
        let Routine { arrays, stages, .. } = self.routine;
        let is_whole = |stage: &Stage| match stage {
            Stage::Block(block) => block.repeated.is_none() && block.writes.contains(&ArrayRows::all(array)),
            Stage::Clear(_) => false,
            _ => true,
        };
        let first = stages.iter().find(|stage| stage.writes(array));
        arrays[array].role == Role::Result && first.is_some_and(is_whole)
    }

    /// Returns the start and end of fixed rows, or of the whole array for rows that a loop counts.
    pub(super) fn range(&self, ArrayRows { array, row }: ArrayRows) -> [usize; 2] {
        let (all, row_len) =
            (self.len(array), self.routine.arrays[array].row_len(&self.routines.description));
        match row {
            Row::First => [0, row_len],
            Row::Last => [all - row_len, all],
            Row::AllButFirst => [row_len, all],
            Row::All | Row::Each { .. } | Row::Listed { .. } => [0, all],
        }
    }

    /// Returns the index of element k of row `index` of a place. The loop counter is `i`, and
    /// `listed` prints an entry of a table.
    pub(super) fn index(
        &self,
        ArrayRows { array, row }: ArrayRows,
        index: usize,
        k: usize,
        listed: impl Fn(&str, usize) -> String,
    ) -> String {
        let declared = &self.routine.arrays[array];
        let len = match row {
            Row::All => declared.row_len(&self.routines.description),
            _ => declared.place_len(row, &self.routines.description),
        };
        let plus = |factor: String, k: usize| if k == 0 { factor } else { format!("{factor} + {k}") };
        let times = |factor: usize, what: &str| {
            if factor == 1 { what.to_owned() } else { format!("{factor} * {what}") }
        };
        match row {
            Row::All | Row::First => (len * index + k).to_string(),
            Row::AllButFirst => (declared.row_len(&self.routines.description) + k).to_string(),
            Row::Last => (self.len(array) - len + k).to_string(),
            Row::Each { stride, offset } => plus(times(stride * len, "i"), offset * len + k),
            Row::Listed { table, column } => {
                plus(times(len, &listed(self.routines.tables[table].name, column)), k)
            }
        }
    }
}

/// Prints entries one after the other, as many as fit on a line.
pub(super) fn filled(writer: &mut Writer, before: &str, entries: &[String], between: &str) {
    let mut line = String::new();
    for entry in entries {
        if !line.is_empty() && width(&line) + width(entry) > NARROW + 20 {
            writer.lines(&format!("{before}{line};"));
            line.clear();
        }
        if !line.is_empty() {
            line.push_str(between);
        }
        line.push_str(entry);
    }
    if !line.is_empty() {
        writer.lines(&format!("{before}{line};"));
    }
}
