//! What the loops of long chains go over.

use super::literal::number;
use crate::print::layout::Writer;
use crate::program::{Routines, Sums};

/// The tables and sums of a module, as constants.
pub(super) fn tables(writer: &mut Writer, routines: &Routines) {
    for table in &routines.tables {
        writer.blank();
        writer.documentation(table.documentation);
        let rows: Vec<String> =
            table.rows.iter().map(|[first, second]| format!("({first}, {second})")).collect();
        writer.array(&format!("const {}: [(usize, usize); {}] = ", table.name, rows.len()), &rows, ";");
    }
    for Sums { name, constants, factors } in &routines.sums {
        writer.blank();
        writer.documentation("What is constant in each entry.");
        let values: Vec<String> = constants.iter().map(|value| number(*value)).collect();
        writer.array(&format!("const {name}_CONSTANTS: [f64; {}] = ", values.len()), &values, ";");
        writer.blank();
        writer.documentation("Entry, term, and the factor with which the term is added.");
        let row =
            |(entry, term, factor): &(usize, usize, f64)| format!("({entry}, {term}, {})", number(*factor));
        let rows: Vec<String> = factors.iter().map(row).collect();
        writer.array(&format!("const {name}_FACTORS: [(usize, usize, f64); {}] = ", rows.len()), &rows, ";");
    }
}
