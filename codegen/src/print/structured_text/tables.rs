//! Lookup tables in Structured Text: a function for each.

use abbe_core::LookupTable;
use abbe_spec::expr::Table;

use super::declarations::comment;
use super::procedures::scalar;
use crate::print::layout::Writer;
use crate::print::text::escaped;
use crate::procedure::look_up;
use crate::program::Routines;

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
