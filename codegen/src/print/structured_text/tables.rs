//! Lookup tables in Structured Text: a function for each, by the algorithm of `LookupTable` in the
//! crate `abbe`.

use abbe_spec::expr::Table;

use super::declarations::{array, comment, numbers, section};
use super::operators::number;
use crate::print::layout::Writer;
use crate::print::text::escaped;

/// Prints the function of a table.
pub(super) fn function(writer: &mut Writer, table: &Table, name: &str, prefix: &str) {
    let lookup = table.lookup();
    let is_even = lookup.starts.is_empty();
    let buckets = if is_even { lookup.pieces.len() } else { lookup.starts.len() } - 2;
    // Beyond the ends a table may have no value.
    let is_missing = |(_, piece): &(usize, &[f64; 4])| piece.iter().any(|number| number.is_nan());
    let missing: Vec<String> = lookup
        .pieces
        .iter()
        .enumerate()
        .filter(is_missing)
        .map(|(piece, _)| format!("(piece = {piece})"))
        .collect();
    let pieces: Vec<f64> =
        lookup.pieces.iter().flatten().map(|number| if number.is_nan() { 0.0 } else { *number }).collect();
    writer.blank();
    let what = format!(
        "{} Order 0 is the table itself, 1 to 3 a derivative.",
        table.documentation(&escaped(&table.description))
    );
    comment(writer, &what);
    writer.lines(&format!("FUNCTION {name} : LREAL"));
    section(writer, "VAR_INPUT", |writer| writer.lines("order : DINT;\nx : LREAL;"));
    section(writer, "VAR_IN_OUT", |writer| writer.lines("fault : BOOL;"));
    section(writer, "VAR", |writer| {
        writer.lines(if is_even { "piece : DINT;" } else { "piece, stride, next : DINT;" });
        writer.lines("bucket, rest, factor, a, b, c, d : LREAL;");
    });
    section(writer, "VAR CONSTANT", |writer| {
        if !is_even {
            let starts: Vec<String> = lookup.starts.iter().map(u32::to_string).collect();
            array(writer, "starts", "DINT", &starts);
            numbers(writer, "knots", lookup.knots);
        }
        numbers(writer, "pieces", &pieces);
    });
    let mut text = vec![
        format!("rest := (x - {}) * {};", grouped(lookup.first), number(lookup.scale)),
        format!("bucket := LIMIT(-LREAL#1.0, rest - LREAL#0.5, {});", number(buckets as f64)),
        format!("piece := {prefix}_nearest(bucket);"),
        "rest := rest - DINT_TO_LREAL(piece);".to_owned(),
        "piece := piece + 1;".to_owned(),
        format!("factor := {};", number(lookup.scale)),
    ];
    if !is_even {
        let stride = if lookup.steps == 0 { 0 } else { 1 << (lookup.steps - 1) };
        text.push("piece := starts[piece];".to_owned());
        text.push(format!("stride := {stride};"));
        text.push(UNEVEN.replace("LAST", &(lookup.knots.len() - 1).to_string()).trim_end().to_owned());
    }
    if !missing.is_empty() {
        text.push(format!("fault := fault OR {};", missing.join(" OR ")));
    }
    text.push(PIECE.replace("NAME", name).trim_end().to_owned());
    text.iter().for_each(|lines| writer.lines(lines));
    writer.lines("END_FUNCTION");
}

/// Returns a number as the right operand of a difference.
fn grouped(value: f64) -> String {
    if value.is_sign_negative() { format!("({})", number(value)) } else { number(value) }
}

/// Bisection for pieces of different widths.
const UNEVEN: &str = "\
WHILE stride > 0 DO
    next := piece + stride;
    IF next <= LAST THEN
        IF x > knots[next] THEN
            piece := next;
        END_IF;
    END_IF;
    stride := stride / 2;
END_WHILE;
rest := x - knots[piece];
factor := LREAL#1.0;
";

const PIECE: &str = "\
a := pieces[4 * piece];
b := pieces[4 * piece + 1];
c := pieces[4 * piece + 2];
d := pieces[4 * piece + 3];
IF order = 0 THEN
    NAME := rest * (rest * (rest * d + c) + b) + a;
ELSIF order = 1 THEN
    NAME := factor * (rest * (rest * (LREAL#3.0 * d) + LREAL#2.0 * c) + b);
ELSIF order = 2 THEN
    NAME := factor * (factor * (rest * (LREAL#6.0 * d) + LREAL#2.0 * c));
ELSE
    NAME := factor * (factor * (factor * (LREAL#6.0 * d)));
END_IF;
";
