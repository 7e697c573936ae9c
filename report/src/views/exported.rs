//! Export: what remains of the error when the files are used.

use abbe_study::export::{PoseDifference, Report};
use abbe_study::number::{digits, error_unit};

use super::shared::some;
use crate::document::{Document, Section, Table};

/// Number of gaps on the first screen.
const SHOWN: usize = 4;

/// Describes the quality of exported files, without their names.
pub fn exported(report: &Report) -> Document {
    let Report { name, format, length, changes, left_out, configurations, seed, .. } = report;
    let (factor, unit) = error_unit(length);
    let columns = ["tool", &format!(">max {unit}"), &format!(">rms {unit}"), ">max mrad", ">rms mrad"];
    let row = |(name, PoseDifference { position, angle }): (&str, &PoseDifference)| {
        let figures =
            [factor * position.largest, factor * position.rms, 1e3 * angle.largest, 1e3 * angle.rms];
        let [a, b, c, d] = figures.map(|value| digits(value, 3));
        [name.to_owned(), a, b, c, d]
    };
    let [before, remains] = report.compared;
    let rows = [(before, &report.before)]
        .into_iter()
        .chain(report.at_nodes.iter().map(|difference| ("at the nodes", difference)))
        .chain([(remains, &report.remains)])
        .chain(report.placed.iter().map(|difference| ("with axes placed", difference)));
    let mut facts = vec![("Sampled", format!("{configurations} random configurations"))];
    facts.extend(some("Left out", left_out, SHOWN));
    facts.push(("Sign", report.sign.clone()));
    let more = if left_out.len() > SHOWN { left_out.clone() } else { Vec::new() };
    let question = match report.compared {
        ["nominal", _] => "Compared: the predicted minus the real position of the tool",
        _ => "Compared: the error of the real tool",
    };
    Document {
        kind: "Exported files",
        machine: name.clone(),
        headline: format!("exported as {format}"),
        sections: vec![
            Section::answer().table(Table::new("", columns).rows(rows.map(row))).facts(facts),
            Section::full("Comparison")
                .state(
                    "compared",
                    format!("{question}, over {configurations} random configurations (seed {seed})."),
                )
                .list("left_out", "Not represented in this format:", more)
                .code(
                    "changes",
                    "Changes",
                    changes.iter().flat_map(|change| change.lines()).map(str::to_owned).collect(),
                ),
        ],
        ..Document::default()
    }
}
