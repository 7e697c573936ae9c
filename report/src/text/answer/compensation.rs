//! The answer of a compensation: how many commands are corrected, and the error before and after.

use abbe::{Class, Description};
use abbe_metrology::compensate::{Report, RowSummary};
use abbe_study::number::{self, counted, length};

use super::{Answer, aligned, error_unit};

/// Number of reasons shown.
const REASONS: usize = 4;

pub(in crate::text) fn compensation(description: &Description, report: &Report) -> String {
    let within = length(report.tolerance, description.length);
    let mut answer = Answer::new(&format!(
        "{}: {} of {} commands corrected to within {within}",
        description.title,
        report.compensated,
        report.total_rows()
    ));
    let (factor, unit) = error_unit(report.length);
    let mut rows = vec![
        ["tool point", &format!("mean {unit}"), "rms", "max", "max orientation mrad"].map(str::to_owned),
    ];
    for (name, size) in [("as commanded", &report.before), ("corrected", &report.after)] {
        let [mean, rms, max] =
            [size.mean, size.rms, size.max].map(|value| number::visible(factor * value, 4));
        rows.push([name.to_owned(), mean, rms, max, number::visible(1e3 * size.angle_max, 4)]);
    }
    answer.block(&aligned(&rows, [false, true, true, true, true]));
    answer.facts(facts(description, report));
    answer.0
}

fn facts(description: &Description, report: &Report) -> Vec<(String, String)> {
    let mut facts: Vec<(String, String)> = Vec::new();
    let mut fact = |name: &str, text: String| facts.push((name.to_owned(), text));
    if !description.sources.iter().any(|source| source.class == Class::Repeatable) {
        fact("Sources", "the spec has no repeatable source: there is nothing to compensate".to_owned());
    }
    for (line, reason) in report.row_summary.reasons.iter().take(REASONS) {
        fact(&format!("Line {line}"), reason.clone());
    }
    if report.row_summary.failed > REASONS {
        fact("", format!("… and {} more rows not corrected", report.row_summary.failed - REASONS));
    }
    if let Some((line, turn)) = report.row_summary.farthest {
        let rows = counted(report.row_summary.far, "row", "rows");
        let degrees = turn.to_degrees();
        fact(
            "Far",
            format!(
                "{rows} with a joint more than {}° from its command; largest {degrees:.0}° (line {line})",
                RowSummary::FAR
            ),
        );
    }
    if report.mobility < 6 {
        let mobility = report.mobility;
        fact(
            "Freedom",
            format!(
                "the joints move the tool in {mobility} of 6 degrees of freedom; position has \
                priority"
            ),
        );
    }
    let other = report.other_tool.iter();
    facts.extend(other.map(|tool| ("Tool".to_owned(), super::other_tool(tool, report.length))));
    facts.extend(report.extrapolated.iter().map(|rows| ("Outside".to_owned(), super::outside(rows))));
    facts.extend(super::data(&report.file).into_iter().map(|(name, text)| (name.to_owned(), text)));
    facts
}
