//! JavaScript: an ES module of pure functions on `Float64Array`.
//!
//! Every function allocates its results, flat and in the order of the Rust arrays. A single result
//! is returned as it is, several results as an object. `functions` prints routines, `operators`
//! expressions, `procedures` and `compensated` the corrected commands.

mod compensated;
mod functions;
mod operators;
mod procedures;

use abbe_spec::Spec;
use abbe_spec::expr::Table;

use self::functions::{comment, function};
use self::operators::number;
use super::header::header;
use super::layout::Writer;
use super::lists::lists;
use super::records::records;
use super::text::escaped;
use crate::program::Routines;

/// Returns the source of a manipulator's module.
pub(super) fn module(spec: &Spec, routines: &Routines) -> String {
    let mut writer = Writer::new(" *");
    writer.lines("/**");
    header(&mut writer, spec, routines);
    writer.lines(" */");
    writer.blank();
    comment(&mut writer, "Names, units, limits and nominal values, in the order of the arguments.");
    writer.open("export const description =");
    records(&mut writer, &routines.description, str::to_owned, number);
    writer.close("};");
    for list in lists(routines.used_tables(), routines.used_sums()) {
        constant(&mut writer, list.documentation, &list.name, &list.entries(number));
    }
    for table in routines.used_lookup_tables() {
        lookup_table(&mut writer, table);
    }
    if routines.used_lookup_tables().next().is_some() {
        writer.blank();
        writer.lines(LOOKUP.trim_end());
    }
    for routine in &routines.list {
        function(&mut writer, spec, routines, routine);
    }
    compensated::compensated(&mut writer, spec, routines);
    writer.finish()
}

/// Prints a lookup table.
fn lookup_table(writer: &mut Writer, table: &Table) {
    let lookup = table.lookup();
    writer.blank();
    comment(writer, &table.documentation(&escaped(&table.description)));
    writer.open(&format!("const {} =", table.constant_name()));
    writer.lines(&format!(
        "first: {}, scale: {}, steps: {},",
        number(lookup.first),
        number(lookup.scale),
        lookup.steps
    ));
    let numbers = |values: &[f64]| values.iter().map(|value| number(*value)).collect::<Vec<_>>();
    writer.array("starts: ", &lookup.starts.iter().map(u32::to_string).collect::<Vec<_>>(), ",");
    writer.array("knots: ", &numbers(lookup.knots), ",");
    let pieces: Vec<String> =
        lookup.pieces.iter().map(|piece| format!("[{}]", numbers(piece).join(", "))).collect();
    writer.array("pieces: ", &pieces, ",");
    writer.close("};");
}

/// Value of a table or of one of its derivatives, by the algorithm of `LookupTable` in the crate
/// `abbe`.
const LOOKUP: &str = "\
/** Returns a derivative of a table at x; order 0 is the table itself. */
function lookup({ first, scale, steps, starts, knots, pieces }, order, x) {
    const even = starts.length === 0;
    const u = (x - first) * scale;
    if (Number.isNaN(u)) return NaN;
    // Adding 1.5 * 2^52 rounds to the nearest integer.
    const nearest = Math.min(Math.max(u - 0.5, -1), (even ? pieces : starts).length - 2);
    const bucket = nearest + 6755399441055744 - 6755399441055744;
    let piece = bucket + 1;
    let t = u - bucket;
    if (!even) {
        piece = starts[piece];
        for (let step = 2 ** (steps - 1); step >= 1; step /= 2) {
            if (x > knots[piece + step]) piece += step;
        }
        t = x - knots[piece];
    }
    const [a, b, c, d] = pieces[piece];
    const unit = even ? scale : 1;
    switch (order) {
        case 0: return ((d * t + c) * t + b) * t + a;
        case 1: return ((3 * d * t + 2 * c) * t + b) * unit;
        case 2: return (6 * d * t + 2 * c) * unit ** 2;
        default: return 6 * d * unit ** 3;
    }
}
";

fn constant(writer: &mut Writer, documentation: &str, name: &str, values: &[String]) {
    writer.blank();
    comment(writer, documentation);
    writer.array(&format!("const {name} = "), values, ";");
}
