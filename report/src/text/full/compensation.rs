//! Corrected commands and what they leave, as text.

use abbe::{Class, Description, VariableKind};

use abbe_metrology::compensate::{NormStatistics, Report, RowSummary};
use abbe_study::number::{NO_BREAK, counted, error_decimals, fixed, length, short, visible};

use super::{Table, wrapped};

/// Returns what `abbe compensate` prints, except where the commands are written.
pub(in crate::text) fn compensation(description: &Description, report: &Report) -> String {
    let mut parts = vec![format!("{}: compensated\n\n", description.title)];
    for line in report.file.lines() {
        parts[0] += &format!("{}\n", wrapped(&line, 2));
    }
    parts[0] += &format!("\n{}", done(description, report));
    let few = report.mobility < 6;
    parts.push(format!(
        "Error of the tool point ({}) and largest orientation error (mrad)\n{}",
        report.length,
        sizes(report, error_decimals(description.length))
    ));
    if few {
        let sentence = format!(
            "{} joints with {} degrees of freedom at the tool cannot correct a full pose, which \
             needs six: position has priority over orientation.",
            description.variables.len(),
            report.mobility
        );
        parts.push(wrapped(&sentence, 0) + "\n");
    }
    if !description.sources.iter().any(|source| source.class == Class::Repeatable) {
        parts.push("The spec has no repeatable source: there is nothing to compensate.\n".to_owned());
    }
    parts.extend(report.other_tool.iter().map(|tool| wrapped(&tool.sentence, 0) + "\n"));
    parts.extend(report.extrapolated.iter().map(|extrapolated| wrapped(&extrapolated.sentence, 0) + "\n"));
    let from = "Corrections cover the errors of the machine in its frame F_0, not the placement of the \
     instrument or of targets.";
    parts.push(wrapped(from, 0) + "\n");
    parts.push(commands(description, report));
    parts.join("\n")
}

fn sizes(report: &Report, decimals: usize) -> String {
    let mut table = Table::new(&["", "mean", "rms", "largest", "largest turn"]);
    for (name, NormStatistics { mean, rms, max, angle_max }) in
        [("as commanded", &report.before), ("corrected", &report.after)]
    {
        let lengths = [mean, rms, max].map(|value| visible(*value, decimals));
        let turn = visible(angle_max * 1e3, 4);
        table.row([&[name.to_owned()][..], &lengths, &[turn]].concat());
    }
    table.right(&[1, 2, 3, 4]).to_string()
}

/// The first rows.
fn commands(description: &Description, report: &Report) -> String {
    let unit = |kind| if kind == VariableKind::Revolute { "°" } else { report.length };
    let names =
        description.variables.iter().map(|variable| format!("{} ({})", variable.name, unit(variable.kind)));
    let names: Vec<String> = names.collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut table = Table::new(&[&["line"][..], &names, &["before", "after"]].concat());
    for row in &report.row_summary.first {
        let values = description.variables.iter().zip(&row.q.0);
        let values = values.map(|(variable, (_, value))| match variable.kind {
            VariableKind::Revolute => fixed(value.to_degrees(), 4),
            VariableKind::Prismatic => fixed(*value, error_decimals(description.length)),
        });
        let left = [row.before.length, row.after.length]
            .map(|value| visible(value, error_decimals(description.length)));
        table.row([&[row.line.to_string()][..], &values.collect::<Vec<_>>(), &left].concat());
    }
    let right: Vec<usize> = (0..description.variables.len() + 3).collect();
    let more = report.row_summary.rows - report.row_summary.first.len();
    let more = if more > 0 { format!("… and {more} more\n") } else { String::new() };
    format!("Corrected commands\n{}{more}", table.right(&right))
}

/// Counts compensated rows, and gives the reasons for the others.
fn done(description: &Description, report: &Report) -> String {
    let turn = match report.mobility {
        0..6 => String::new(),
        _ => format!(" and {}{NO_BREAK}mrad", short(1e3 * report.tolerance * description.length.in_metres())),
    };
    let tolerance = length(report.tolerance, description.length);
    let mut text = format!(
        "{} of {} commands corrected: the remaining error of the tool point is at most \
         {tolerance}{turn}.",
        report.compensated,
        report.total_rows()
    );
    text = wrapped(&text, 0) + "\n";
    let RowSummary { failed, reasons, far, farthest, .. } = &report.row_summary;
    for (line, reason) in reasons {
        text += &format!("  {}\n", wrapped(&format!("line {line}: {reason}"), 4));
    }
    if *failed > reasons.len() {
        text += &format!("  … and {} more\n", failed - reasons.len());
    }
    if let Some((line, turn)) = farthest {
        let sentence = format!(
            "In {} a joint moves by more than {}° from its command (line {line}: {:.0}°): review \
             {} before {} sent to the machine.",
            counted(*far, "row", "rows"),
            RowSummary::FAR,
            turn.to_degrees(),
            if *far == 1 { "it" } else { "them" },
            if *far == 1 { "it is" } else { "they are" }
        );
        text += &(wrapped(&sentence, 0) + "\n");
    }
    text
}
