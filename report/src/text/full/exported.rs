//! Files in another format and how good they are, as text.

use abbe_study::export::{PoseDifference, Report};
use abbe_study::number::digits;

use super::{Table, wrapped};

/// Prints the quality of exported files, without their paths.
pub(in crate::text) fn exported(report: &Report) -> String {
    let Report { name, format, changes, left_out, sign, configurations, seed, .. } = report;
    let mut parts = vec![
        format!("{name}: {format}\n"),
        format!(
            "{}, over {configurations} random configurations (seed {seed})\n{}",
            question(report),
            differences(report)
        ),
    ];
    if !changes.is_empty() {
        parts.push(format!("Changes\n{}", changes.concat()));
    }
    if !left_out.is_empty() {
        let lines: Vec<String> = left_out.iter().map(|line| format!("  {}\n", wrapped(line, 4))).collect();
        parts.push(format!("Not represented in this format\n{}", lines.concat()));
    }
    parts.push(format!("Sign convention\n  {}\n", wrapped(sign, 4)));
    parts.join("\n")
}

/// Heading of the comparison: of a model, or of corrected commands.
fn question(report: &Report) -> &'static str {
    match report.compared {
        ["nominal", _] => "Predicted minus real position of the tool",
        _ => "Error of the real tool",
    }
}

fn differences(report: &Report) -> String {
    let heading = [report.length, "mrad"];
    let [largest, rms] = ["largest", "rms"].map(|figure| heading.map(|unit| format!("{figure} ({unit})")));
    let mut table = Table::new(&["", &largest[0], &rms[0], &largest[1], &rms[1]]);
    let [before, remains] = report.compared;
    let at_nodes = report.at_nodes.as_ref().map(|difference| ("at the nodes", difference));
    let placed = report.placed.as_ref().map(|difference| ("with axes placed", difference));
    let rows = [(before, &report.before)]
        .into_iter()
        .chain(at_nodes)
        .chain([(remains, &report.remains)])
        .chain(placed);
    for (name, difference) in rows {
        let PoseDifference { position, angle } = difference;
        let figures = [position.largest, position.rms, 1e3 * angle.largest, 1e3 * angle.rms];
        table.row([&[name.to_owned()][..], &figures.map(|value| digits(value, 3))].concat());
    }
    table.right(&[1, 2, 3, 4]).to_string()
}
