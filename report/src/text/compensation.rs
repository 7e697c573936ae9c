//! Corrected commands and what they leave, as text.

use abbe::{Class, Description, VariableKind};

use abbe_study::compensate::{Report, Size, Told};
use abbe_study::number::{counted, error_decimals, fixed, length, short};

use super::{Table, wrapped};

/// Returns what `abbe compensate` prints, except where the commands are written.
pub fn compensation(description: &Description, report: &Report) -> String {
    let mut parts = vec![format!("{}: compensated\n\n", description.title)];
    for line in report.file.lines() {
        parts[0] += &format!("{}\n", wrapped(&line, 2));
    }
    parts[0] += &format!("\n{}", done(description, report));
    let few = report.mobility < 6;
    parts.push(format!(
        "How far the tool point is from where it should be ({}), and its largest turn (mrad)\n{}",
        report.length,
        sizes(report, error_decimals(description.length))
    ));
    if few {
        let sentence = format!(
            "{} joints that move the tool in {} ways cannot correct a whole pose, which takes six: the tool point comes first, \
             then as much of the turn as is possible.",
            description.variables.len(),
            report.mobility
        );
        parts.push(wrapped(&sentence, 0) + "\n");
    }
    if !description.sources.iter().any(|source| source.class == Class::Repeatable) {
        parts.push("The spec has no repeatable source: there is nothing to compensate.\n".to_owned());
    }
    let from = "Corrected are the errors of the machine alone, as its frame F_0 sees them: not where it stands before an \
                instrument, and not where targets are mounted.";
    parts.push(wrapped(from, 0) + "\n");
    parts.push(commands(description, report));
    parts.join("\n")
}

fn sizes(report: &Report, decimals: usize) -> String {
    let mut table = Table::new(&["", "mean", "rms", "largest", "largest turn"]);
    for (name, Size { mean, rms, max, angle_max }) in
        [("as commanded", &report.before), ("corrected", &report.after)]
    {
        let lengths = [mean, rms, max].map(|value| fixed(*value, decimals));
        let turn = fixed(angle_max * 1e3, 4);
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
    for row in &report.told.first {
        let values = description.variables.iter().zip(&row.q.0);
        let values = values.map(|(variable, (_, value))| match variable.kind {
            VariableKind::Revolute => format!("{:.4}", value.to_degrees()),
            VariableKind::Prismatic => fixed(*value, error_decimals(description.length)),
        });
        let left = [row.before.length, row.after.length]
            .map(|value| fixed(value, error_decimals(description.length)));
        table.row([&[row.line.to_string()][..], &values.collect::<Vec<_>>(), &left].concat());
    }
    let right: Vec<usize> = (0..description.variables.len() + 3).collect();
    let more = report.told.rows - report.told.first.len();
    let more = if more > 0 { format!("… and {more} more\n") } else { String::new() };
    format!("Corrected commands\n{}{more}", table.right(&right))
}

/// What is done, and what is not and why.
fn done(description: &Description, report: &Report) -> String {
    let turn = match report.mobility {
        0..6 => String::new(),
        _ => format!(" and {} rad", short(report.tolerance * description.length.in_metres())),
    };
    let tolerance = length(report.tolerance, description.length);
    let mut text = format!(
        "{} of {} rows are compensated: no more than {tolerance}{turn} is left at the tool point.",
        report.compensated,
        report.asked()
    );
    text = wrapped(&text, 0) + "\n";
    let Told { failed, reasons, far, farthest, .. } = &report.told;
    for (line, reason) in reasons {
        text += &format!("  {}\n", wrapped(&format!("line {line}: {reason}"), 4));
    }
    if *failed > reasons.len() {
        text += &format!("  … and {} more\n", failed - reasons.len());
    }
    if let Some((line, turn)) = farthest {
        let sentence = format!(
            "In {} a joint turns by more than {}° from its command (line {line}: by {:.0}°): look at {} before {} sent.",
            counted(*far, "row", "rows"),
            Told::FAR,
            turn.to_degrees(),
            if *far == 1 { "it" } else { "them" },
            if *far == 1 { "it is" } else { "they are" }
        );
        text += &(wrapped(&sentence, 0) + "\n");
    }
    text
}
