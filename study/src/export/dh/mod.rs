//! A table of Denavit-Hartenberg numbers.
//!
//! `rows` finds the nominal numbers of the chain, `fit` those whose tool is nearest to the real one, `text` writes and reads them.
//! Four numbers a joint are not enough for all that can be wrong: where two axes should be parallel, a tilt of one of them about
//! the common normal and past it would take a `d` that is as long as the arm is large by the tilt. It is left out.

mod fit;
mod rows;
mod text;

use abbe::{Pose, VariableKind};
use abbe_spec::diagnostic::{Diagnostics, listed};
use abbe_spec::{DhConvention, DhNumber};

pub(super) use self::rows::Table;
use super::found::Found;
use super::{ExportedFile, MODEL, Report, UNCHANGED, as_nominal};
use crate::mistake;
use crate::number::{digits, short};

/// The table, and what remains of the errors with it.
pub(super) fn report(found: &Found) -> Result<Report, Diagnostics> {
    let nominal = Table::nominal(found)?;
    let mut table = nominal.clone();
    fit::fit(&mut table, found);
    let text = text::write(&table, found);
    let read = text::read(&text).map_err(|message| {
        mistake::with_help("abbe export", message, "this is a mistake of abbe: please report the spec")
    })?;
    let read = Table { rows: read, ..table.clone() };
    let word = table.convention.name();
    let mut left_out: Vec<String> = found.held_at_mean().into_iter().collect();
    let ends = [("base", nominal.base), ("tool", nominal.tool)];
    let ends: Vec<&str> =
        ends.iter().filter(|(_, pose)| *pose != Pose::IDENTITY).map(|(name, _)| *name).collect();
    if !ends.is_empty() {
        left_out.push(format!(
            "The table goes from the first joint to the last: the {} of the spec comes beside it, as it is.",
            listed(&ends)
        ));
    }
    left_out.extend(tilts(&nominal, found));
    left_out.push(
        "Of the six errors of the last frame a table holds what its own four numbers can do; the rest belongs to the tool."
            .to_owned(),
    );
    let format = format!("Denavit-Hartenberg numbers, {word}");
    let files = vec![ExportedFile { name: format!("{}.dh.csv", found.spec.name), text }];
    let remains = found.of_model(|q| read.pose(q));
    let sign = sign(&nominal, &table, found);
    Ok(Report { left_out, ..found.report(format, files, MODEL, remains, sign) })
}

/// Neighbouring axes that are parallel.
fn tilts(table: &Table, found: &Found) -> Option<String> {
    let moved: Vec<usize> = (0..table.rows.len()).filter(|row| table.rows[*row].variable.is_some()).collect();
    let pairs = moved.windows(2).filter_map(|pair| {
        let [one, next] = *pair else { return None };
        // The angle between them is the alpha of all rows from one to the next.
        let between = match table.convention {
            DhConvention::Standard => one..next,
            DhConvention::Modified => one + 1..next + 1,
        };
        let alpha: f64 = between.map(|row| table.rows[row].numbers[DhNumber::Alpha as usize]).sum();
        let name =
            |row: usize| table.rows[row].variable.map(|variable| &*found.spec.variables[variable].name);
        let turns = [one, next].iter().all(|row| !table.rows[*row].prismatic);
        (alpha.sin().abs() < 1e-3 && turns).then_some(format!("{} and {}", name(one)?, name(next)?))
    });
    let pairs: Vec<String> = pairs.collect();
    (!pairs.is_empty()).then(|| {
        format!(
            "Where axes are parallel ({}) a table holds one of the two tilts between them, that by alpha.",
            pairs.join(", ")
        )
    })
}

/// The number that changes most, as it moves the tool.
fn sign(nominal: &Table, table: &Table, found: &Found) -> String {
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
    let Some((_, row, number, old, new)) = most else { return as_nominal() };
    let unit = match number {
        DhNumber::Theta | DhNumber::Alpha => "rad",
        DhNumber::A | DhNumber::D => found.spec.length.symbol(),
    };
    format!(
        "These are the numbers of the real arm, to be used in place of the nominal ones: {} of {} is {} {unit} where the spec has \
         {} {unit}. The real one is {} by {} {unit}, and nothing is to be subtracted from it.",
        number.name(),
        table.rows[row].name,
        digits(new, 8),
        short(old),
        if new >= old { "larger" } else { "smaller" },
        digits((new - old).abs(), 4),
    )
}

/// The row of a joint is one that slides.
pub(super) fn slides(kind: VariableKind) -> bool {
    kind == VariableKind::Prismatic
}
