//! `abbe doctor`: which convention some rows of joints and poses are in.

use std::fmt::Write;

use abbe_codegen::document::Document;
use abbe_codegen::expr::{Dimension, parse_value};
use abbe_study::Notes;
use abbe_study::doctor::{Doctor, Finding, Report};
use abbe_study::number::digits;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::output::{Outcome, Outputs, json};

/// So many readings that cannot be told apart are printed.
const SHOWN: usize = 8;

pub(crate) fn run(arguments: &arguments::Doctor) -> Result<Outcome, Failure> {
    let machine = arguments.subject.machine()?;
    let within = match &arguments.within {
        None => None,
        Some(text) => {
            let mut document = Document::new("--within", text.as_str());
            let length = machine.spec.length;
            let value = parse_value(&mut document, 0..text.len(), length, Dimension::LENGTH, "this length");
            Some(document.finish(value)?)
        }
    };
    let job = Doctor { machine, data: arguments.data.clone(), within };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let wanted = outputs.wanted(arguments.out.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let printed = match (wanted, &report.map) {
        (Some(file), Some(map)) => Some(outputs.finish([file.fill(map)?])?),
        (Some(_), None) => {
            Console::default().note("no reading fits: no map is written, and what was there stays");
            None
        }
        _ => None,
    };
    let text = if arguments.json { json(&report)? } else { text(&report) };
    let outcome = Outcome::checked(text, report.fits);
    Ok(match printed {
        Some(printed) => outcome.beside(printed),
        None => outcome,
    })
}

fn text(report: &Report) -> String {
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
        let _ = writeln!(text, "\nNo map can hold this; change it in the spec, or in the file:");
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
