//! Full text of a measurement.

mod sentences;

use abbe_metrology::measure::{InstrumentErrors, Report, Size};
use abbe_spec::Spec;
use abbe_study::number::{digits, fixed};

use super::{Table, wrapped};
pub(in crate::text) use sentences::agreement;
use sentences::decimals;
pub(crate) use sentences::sentences;

/// Returns what `abbe measure` prints.
pub(in crate::text) fn measurement(spec: &Spec, report: &Report) -> String {
    let mut parts = vec![format!("{}: measured\n\n", spec.title)];
    for line in report.file.lines() {
        parts[0] += &format!("{}\n", wrapped(&line, 2));
    }
    if report.base_fitted {
        parts[0] += &(wrapped(
            match report.instruments.is_empty() {
                true => {
                    "The station of the instrument was fitted to these rows, for the machine of \
                     the spec: errors common to all rows are not included."
                }
                false => {
                    "The stations of the instruments were fitted to these rows, for the machine \
                     of the spec: errors that they explain are not included. The map of `identify \
                     --out` has the identified stations."
                }
            },
            0,
        ) + "\n");
    }
    if report.tool_fitted {
        parts[0] += &(wrapped(
            "The place on the tool that the map does not state was fitted to these rows, for the machine \
             of the spec: errors that it absorbs are not included.",
            0,
        ) + "\n");
    }
    match report.instruments.is_empty() {
        true => parts.push(format!(
            "ΔX = measured − ideal, {} and mrad\n{}",
            report.length,
            errors(&report.errors, decimals(report))
        )),
        false => parts.push(format!(
            "Reading − prediction with the repeatable sources of the spec; in brackets the rms without them\n{}",
            instruments(&report.instruments)
        )),
    }
    parts.extend(sentences(report).into_iter().map(|sentence| wrapped(&sentence, 0) + "\n"));
    parts.join("\n")
}

fn instruments(all: &[InstrumentErrors]) -> String {
    let mut table =
        Table::new(&["", "unit", "read", "mean", "std. error", "rms", "(ideal)", "largest", "stated σ"]);
    for one in all {
        let show = |value: f64| digits(value, 4);
        let InstrumentErrors { name, unit, count, left, ideal, uncertainty, .. } = one;
        table.row([
            name.clone(),
            unit.clone(),
            count.to_string(),
            show(left.mean),
            left.standard_error.map_or(String::new(), |error| digits(error, 2)),
            show(left.rms),
            format!("({})", show(ideal.rms)),
            show(left.max),
            uncertainty.map_or("unknown".to_owned(), show),
        ]);
    }
    table.right(&[2, 3, 4, 5, 6, 7, 8]).to_string()
}

fn errors(sizes: &[Size], decimals: usize) -> String {
    let mut table = Table::new(&["", "mean", "rms", "largest", "3 σ about the mean"]);
    for size in sizes {
        let (factor, decimals) = if size.unit == "rad" { (1e3, 4) } else { (1.0, decimals) };
        let numbers =
            [size.mean, size.rms, size.max, size.three_sigma].map(|value| fixed(value * factor, decimals));
        table.row([&[size.name.to_owned()][..], &numbers].concat());
    }
    table.right(&[1, 2, 3, 4]).to_string()
}
