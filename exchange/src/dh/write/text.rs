//! Text of a table: CSV with the columns that `abbe import --dh` reads.

use std::fmt::Write;

use abbe_spec::DhConvention;

use crate::dh::table::{DhTable, Row};
use crate::export::RealMachine;
use crate::export::report::{DECIMALS, rounded};

/// Writes a table.
pub(super) fn write(table: &DhTable, machine: &RealMachine) -> String {
    let unit = machine.spec.length.symbol();
    let (word, product) = match table.convention {
        DhConvention::Standard => ("Standard", "Rz(theta) Tz(d) Tx(a) Rx(alpha)"),
        DhConvention::Modified => ("Modified", "Rx(alpha) Tx(a) Rz(theta) Tz(d)"),
    };
    let mut text = format!(
        "# {word} DH numbers of {}: {product}. A joint adds to theta, or to d where it slides\n\
         joint,kind,sign,theta (rad),d ({unit}),a ({unit}),alpha (rad)\n",
        machine.spec.name
    );
    for Row { name, variable, prismatic, reversed, numbers } in &table.rows {
        let [theta, d, a, alpha] = numbers.map(|number| rounded(number, DECIMALS));
        let kind = match (variable, prismatic) {
            (None, _) => "fixed",
            (_, false) => "revolute",
            (_, true) => "prismatic",
        };
        let sign = if *reversed { -1 } else { 1 };
        let name = match name.contains([',', '"', ';']) {
            true => format!("\"{}\"", name.replace('"', "'")),
            false => name.clone(),
        };
        let _ = writeln!(text, "{name},{kind},{sign},{theta},{d},{a},{alpha}");
    }
    text
}

/// Reads the rows of a text of [`write`]; variables are numbered in their order.
pub(super) fn read(text: &str) -> Result<Vec<Row>, String> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let (mut rows, mut moved) = (Vec::new(), 0);
    for record in reader.deserialize::<(String, String, f64, f64, f64, f64, f64)>() {
        let (name, kind, sign, theta, d, a, alpha) = record.map_err(|error| error.to_string())?;
        let variable = (kind != "fixed").then_some(moved);
        moved += usize::from(variable.is_some());
        let numbers = [theta, d, a, alpha];
        rows.push(Row { name, variable, prismatic: kind == "prismatic", reversed: sign < 0.0, numbers });
    }
    Ok(rows)
}
