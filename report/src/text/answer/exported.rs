//! The answer of an export: what remains of the error when the files are used.

use abbe_study::export::{PoseDifference, Report};
use abbe_study::number::digits;

use super::{Answer, aligned, error_unit};

/// Number of gaps shown.
const SHOWN: usize = 4;

pub(in crate::text) fn exported(report: &Report) -> String {
    let Report { name, format, length, configurations, .. } = report;
    let mut answer = Answer::new(&format!("{name}: exported as {format}"));
    let (factor, unit) = error_unit(length);
    let [before, remains] = report.compared;
    let row = |name: &str, PoseDifference { position, angle }: &PoseDifference| {
        let figures =
            [factor * position.largest, factor * position.rms, 1e3 * angle.largest, 1e3 * angle.rms];
        let [a, b, c, d] = figures.map(|value| digits(value, 3));
        [name.to_owned(), a, b, c, d]
    };
    let head = ["tool", &format!("max {unit}"), &format!("rms {unit}"), "max mrad", "rms mrad"];
    let mut rows = vec![head.map(str::to_owned), row(before, &report.before)];
    rows.extend(report.at_nodes.iter().map(|difference| row("at the nodes", difference)));
    rows.push(row(remains, &report.remains));
    rows.extend(report.placed.iter().map(|difference| row("with axes placed", difference)));
    answer.block(&aligned(&rows, [false, true, true, true, true]));
    let mut facts = vec![("Sampled", format!("{configurations} random configurations"))];
    facts.extend(super::some("Left out", &report.left_out, SHOWN));
    facts.push(("Sign", report.sign.clone()));
    answer.facts(facts);
    answer.0
}
