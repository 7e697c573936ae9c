//! Full text of the doctor: conventions that fit.

use std::fmt::Write;

use abbe_metrology::doctor::{Finding, Report};
use abbe_study::number::digits;

/// So many readings that cannot be told apart are printed.
const SHOWN: usize = 8;

/// Prints the best interpretation and its alternatives.
pub(in crate::text) fn doctor(report: &Report) -> String {
    let Report { rows, joints, seen, found, simpler, others, sentence, of_spec, length, .. } = report;
    let mut text = format!(
        "{sentence}\n\nJoint columns: {}.\nMeasurement columns: {}.\n",
        joints.join(", "),
        seen.join(", ")
    );
    if let Some(Finding { words, residual, both, .. }) = simpler {
        let _ = writeln!(
            text,
            "\nA simpler interpretation leaves {} {length}, more than noise, but possibly errors \
             of this machine: {words}.\nIf its errors may be that large: `--within \"{} \
             {length}\"`.",
            digits(*residual, 3),
            digits(1.2 * both, 2)
        );
    }
    if found.len() > 1 {
        let _ = writeln!(text, "\nThese interpretations fit the {rows} rows equally well:");
        list(&mut text, found, length);
    }
    if !others.is_empty() {
        let _ = writeln!(text, "\nNext best interpretations:");
        list(&mut text, others, length);
    }
    if !of_spec.is_empty() {
        let _ = writeln!(
            text,
            "\nA map cannot express this; change the spec (`--corrected SPEC` does it where \
             possible) or the file:"
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
