//! Writes the Denavit-Hartenberg numbers of the real machine.
//!
//! `fit` finds the numbers, `text` writes and reads them. Four numbers per joint cannot hold all
//! errors: between nominally parallel axes, the tilt that `alpha` does not describe would take a
//! `d` of the size of the arm divided by the tilt. The fit leaves it out.

mod fit;
mod text;

use abbe::Pose;
use abbe_spec::diagnostic::listed;
use abbe_spec::number::{digits, short};
use abbe_spec::{DhConvention, DhNumber, Diagnostics};

use super::table::DhTable;
use crate::export::report::{UNCHANGED, nominal_sign, unreadable};
use crate::export::{ExportReport, ExportedFile, RealMachine};

/// Writes the table whose tool is closest to the real one over the workspace.
///
/// # Errors
///
/// A frame of the spec has no Denavit-Hartenberg numbers.
pub fn write(machine: &RealMachine) -> Result<ExportReport, Diagnostics> {
    let nominal = DhTable::nominal(machine)?;
    let mut table = nominal.clone();
    fit::fit(&mut table, machine);
    let text = text::write(&table, machine);
    let read = DhTable { rows: text::read(&text).map_err(unreadable)?, ..table.clone() };
    let word = table.convention.name();
    let mut left_out: Vec<String> = machine.held_at_mean().into_iter().collect();
    let ends = [("base", nominal.base), ("tool", nominal.tool)];
    let ends: Vec<&str> =
        ends.iter().filter(|(_, pose)| *pose != Pose::IDENTITY).map(|(name, _)| *name).collect();
    if !ends.is_empty() {
        left_out.push(format!(
            "The table contains the joints only: apply the {} of the spec in addition, unchanged.",
            listed(&ends)
        ));
    }
    left_out.extend(parallel_axes(&nominal, machine));
    left_out.push(
        "The DH numbers of the last frame represent four of its six errors; the other two belong \
         to the tool."
            .to_owned(),
    );
    let format = format!("Denavit-Hartenberg numbers, {word}");
    let files = vec![ExportedFile { name: format!("{}.dh.csv", machine.spec.name), text }];
    let sign = sign(&nominal, &table, machine);
    Ok(ExportReport { left_out, sign, ..ExportReport::for_model(machine, format, files, |q| read.pose(q)) })
}

/// Returns a sentence about neighbouring parallel axes, if there are any.
fn parallel_axes(table: &DhTable, machine: &RealMachine) -> Option<String> {
    let moving: Vec<usize> =
        (0..table.rows.len()).filter(|row| table.rows[*row].variable.is_some()).collect();
    let pairs = moving.windows(2).filter_map(|pair| {
        let [one, next] = *pair else { return None };
        // The angle between the axes is the sum of the alpha of all rows from one to the next.
        let between = match table.convention {
            DhConvention::Standard => one..next,
            DhConvention::Modified => one + 1..next + 1,
        };
        let alpha: f64 = between.map(|row| table.rows[row].numbers[DhNumber::Alpha as usize]).sum();
        let name =
            |row: usize| table.rows[row].variable.map(|variable| &*machine.spec.variables[variable].name);
        let turns = [one, next].iter().all(|row| !table.rows[*row].prismatic);
        (alpha.sin().abs() < 1e-3 && turns).then_some(format!("{} and {}", name(one)?, name(next)?))
    });
    let pairs: Vec<String> = pairs.collect();
    (!pairs.is_empty()).then(|| {
        format!(
            "Between parallel axes ({}) a table represents one of the two tilts: the rotation \
             alpha about x.",
            pairs.join(", ")
        )
    })
}

/// Returns the sentence about the sign: that of the number whose change moves the tool most.
fn sign(nominal: &DhTable, table: &DhTable, machine: &RealMachine) -> String {
    let reach = table.reach();
    let mut most: Option<(f64, usize, DhNumber, f64, f64)> = None;
    for (row, (old, new)) in nominal.rows.iter().zip(&table.rows).enumerate() {
        for number in DhNumber::ALL {
            let (old, new) = (old.numbers[number as usize], new.numbers[number as usize]);
            let weight = if matches!(number, DhNumber::Theta | DhNumber::Alpha) { reach } else { 1.0 };
            let size = (new - old).abs() * weight;
            if most.as_ref().is_none_or(|(most, ..)| size > *most) {
                most = Some((size, row, number, old, new));
            }
        }
    }
    let most = most.filter(|(size, ..)| *size > UNCHANGED);
    let Some((_, row, number, old, new)) = most else { return nominal_sign() };
    let unit = match number {
        DhNumber::Theta | DhNumber::Alpha => "rad",
        DhNumber::A | DhNumber::D => machine.spec.length.symbol(),
    };
    format!(
        "The table holds the numbers of the real arm, which replace the nominal ones: {} of {} is \
         {} {unit}; in the spec it is {} {unit}. The real value is {} by {} {unit}; do not \
         subtract anything from it.",
        number.name(),
        table.rows[row].name,
        digits(new, 8),
        short(old),
        if new >= old { "larger" } else { "smaller" },
        digits((new - old).abs(), 4),
    )
}
