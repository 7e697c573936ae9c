//! Tables for the loops of long chains, and lookup tables.

use abbe_spec::expr::Table;

use super::literal::number;
use crate::print::layout::{Writer, array};
use crate::print::text::escaped;
use crate::program::{Routines, Sums};

/// Prints a lookup table as a constant.
pub(super) fn lookup_table(writer: &mut Writer, table: &Table) {
    let (name, lookup) = (table.constant_name(), table.lookup());
    writer.blank();
    writer.documentation(&table.documentation(&escaped(&table.description)));
    writer.open(&format!("const {name}: ::abbe::LookupTable<'static> = ::abbe::LookupTable"));
    writer.lines(&format!("first: {},", number(lookup.first)));
    writer.lines(&format!("scale: {},", number(lookup.scale)));
    let starts: Vec<String> = lookup.starts.iter().map(u32::to_string).collect();
    writer.array("starts: &", &starts, ",");
    let knots: Vec<String> = lookup.knots.iter().map(|knot| number(*knot)).collect();
    writer.array("knots: &", &knots, ",");
    let indent = writer.indent() + 4;
    let piece = |piece: &[f64; 4]| array(indent, "", &piece.map(number), "");
    writer.array("pieces: &", &lookup.pieces.iter().map(piece).collect::<Vec<_>>(), ",");
    writer.lines(&format!("steps: {},", lookup.steps));
    writer.close("};");
}

/// Prints the tables and sums of a module as constants.
pub(super) fn tables(writer: &mut Writer, routines: &Routines) {
    for table in routines.used_tables() {
        writer.blank();
        writer.documentation(table.documentation);
        let rows: Vec<String> =
            table.rows.iter().map(|[first, second]| format!("({first}, {second})")).collect();
        writer.array(&format!("const {}: [(usize, usize); {}] = ", table.name, rows.len()), &rows, ";");
    }
    for Sums { name, constants, factors } in routines.used_sums() {
        writer.blank();
        writer.documentation("Constant term of each entry.");
        let values: Vec<String> = constants.iter().map(|value| number(*value)).collect();
        writer.array(&format!("const {name}_CONSTANTS: [f64; {}] = ", values.len()), &values, ";");
        writer.blank();
        writer.documentation("Entry, term, and factor of the term.");
        let row =
            |(entry, term, factor): &(usize, usize, f64)| format!("({entry}, {term}, {})", number(*factor));
        let rows: Vec<String> = factors.iter().map(row).collect();
        writer.array(&format!("const {name}_FACTORS: [(usize, usize, f64); {}] = ", rows.len()), &rows, ";");
    }
}
