//! The results for people.

use abbe_codegen::spec::Spec;
use abbe_study::measure::{Report, Size};
use abbe_study::number::fixed;

use crate::table::{Table, wrapped};

pub(super) fn text(spec: &Spec, report: &Report) -> String {
    let mut parts = vec![format!("{}: measured\n\n", spec.title)];
    for line in report.file.lines() {
        parts[0] += &format!("{}\n", wrapped(&line, 2));
    }
    if report.base_fitted {
        parts[0] += &(wrapped(
            "Where the instrument stands was found from these rows, for the machine as its spec has it: what all rows have in common is not in the errors.",
            0,
        ) + "\n");
    }
    parts.push(format!(
        "ΔX = measured − ideal, {} and mrad\n{}",
        report.length,
        errors(&report.errors, report.decimals())
    ));
    parts.extend(report.sentences().into_iter().map(|sentence| wrapped(&sentence, 0) + "\n"));
    parts.join("\n")
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
