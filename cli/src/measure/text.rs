//! The results for people.

use abbe_codegen::spec::Spec;

use super::{Report, Size};
use crate::data::{Data, Map};
use crate::table::{Table, wrapped};
use abbe_study::number::{fixed, percent};

pub(super) fn of(spec: &Spec, map: &Map, data: &Data, report: &Report) -> String {
    let mut parts = vec![format!("{}: measured\n\n", spec.title)];
    for line in data.describe() {
        parts[0] += &format!("{}\n", wrapped(&line, 2));
    }
    if map.base_unknown {
        parts[0] += &(wrapped(
            "Where the instrument stands was fitted: what all rows have in common is not in the errors.",
            0,
        ) + "\n");
    }
    parts.push(format!(
        "ΔX = measured − ideal, {} and mrad\n{}",
        report.length,
        errors(&report.errors, decimals(report))
    ));
    parts.extend(sentences(report).into_iter().map(|sentence| wrapped(&sentence, 0) + "\n"));
    parts.join("\n")
}

fn decimals(report: &Report) -> usize {
    if report.length == "m" { 7 } else { 4 }
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

/// Repeatability and prediction in words.
pub(super) fn sentences(report: &Report) -> Vec<String> {
    let unit = report.length;
    let show = |value: f64| format!("{} {unit}", fixed(value, decimals(report)));
    let mut all = Vec::new();
    let repeated = &report.repeated;
    match (&repeated.ap, &repeated.rp, repeated.three_sigma) {
        (Some(ap), Some(rp), Some([x, y, z])) => {
            let few = if repeated.fewest < 30 {
                format!(" The standard asks for 30 visits; some have {}.", repeated.fewest)
            } else {
                String::new()
            };
            all.push(format!(
                "{} configurations were visited again, {} visits in all. Pose accuracy AP (from the commanded point to the \
                 barycentre of the visits, ISO 9283): {} on average, {} at most. Pose repeatability RP (mean distance from \
                 the barycentre and three standard deviations of that distance): {} on average, {} at most. Three standard \
                 deviations about the barycentres: x {}, y {}, z {}.{few}",
                repeated.configurations,
                repeated.visits,
                show(ap.mean),
                show(ap.max),
                show(rp.mean),
                show(rp.max),
                show(x),
                show(y),
                show(z),
            ));
        }
        _ => all.push(
            "No configuration was visited twice: accuracy and repeatability of ISO 9283 need visits of the same one."
                .to_owned(),
        ),
    }
    let explained = &report.explained;
    if explained.repeatable > 0 {
        all.push(format!(
            "The {} repeatable sources of the spec explain {} of the sum of squares; {} remain on average, {} at most.",
            explained.repeatable,
            percent(explained.share, 1.0),
            show(explained.left_mean),
            show(explained.left_max)
        ));
    } else {
        all.push(
            "The spec has no repeatable source that could explain them: `abbe identify` finds some."
                .to_owned(),
        );
    }
    let verdict = if explained.inside >= 0.95 { "at least 95 %, as it should be" } else { "fewer than 95 %" };
    let allow = match explained.random {
        0 => "what the instrument allows".to_owned(),
        random => format!("what its {random} random sources and the instrument allow"),
    };
    let inside = percent(explained.inside, 1.0);
    all.push(format!("{inside} of the rows are within {allow} about that: {verdict}."));
    all
}
