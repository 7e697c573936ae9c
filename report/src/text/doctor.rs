//! Which convention some rows are in, as text.

use std::fmt::Write;

use abbe_study::doctor::{Finding, Report};
use abbe_study::number::digits;

/// So many readings that cannot be told apart are printed.
const SHOWN: usize = 8;

/// What `abbe doctor` prints.
pub fn doctor(report: &Report) -> String {
    let Report { rows, joints, seen, found, simpler, others, sentence, of_spec, length, .. } = report;
    let mut text =
        format!("{sentence}\n\nRead as joints: {}.\nRead as seen: {}.\n", joints.join(", "), seen.join(", "));
    if let Some(Finding { words, residual, both, .. }) = simpler {
        let _ = writeln!(
            text,
            "\nWith less changed {} {length} are left, more than noise, but perhaps errors of this machine: {words}.\nIf its errors may be as large, say so: `--within \"{} {length}\"`.",
            digits(*residual, 3),
            digits(1.2 * both, 2)
        );
    }
    if found.len() > 1 {
        let _ = writeln!(text, "\nThese readings cannot be told apart by these {rows} rows:");
        list(&mut text, found, length);
    }
    if !others.is_empty() {
        let _ = writeln!(text, "\nThe nearest of the others:");
        list(&mut text, others, length);
    }
    if !of_spec.is_empty() {
        let _ = writeln!(
            text,
            "\nNo map can hold this; change it in the spec (`--corrected SPEC` does, where its text can say it), or in the file:"
        );
        for line in of_spec {
            let _ = writeln!(text, "  {line}");
        }
    }
    text
}

fn list(text: &mut String, findings: &[Finding], length: &str) {
    for Finding { words, residual, angle, .. } in findings.iter().take(SHOWN) {
        let angle = angle.map_or(String::new(), |angle| format!(", {}°", digits(angle.to_degrees(), 2)));
        let _ = writeln!(text, "  {} {length}{angle}  {words}", digits(*residual, 3));
    }
    if findings.len() > SHOWN {
        let _ = writeln!(text, "  … and {} more", findings.len() - SHOWN);
    }
}
