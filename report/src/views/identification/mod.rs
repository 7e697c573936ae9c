//! Identification: accuracy on held-out rows, errors of the machine, and what the data determine.

mod accuracy;
mod answer;
mod errors;

use abbe_metrology::data::Map;
use abbe_metrology::identify::{Report, Sizes};
use abbe_spec::Spec;
use abbe_study::number::{digits, error_unit, fixed};

use super::shared::{NOTES, accepted, data_rows, instrument, notes};
use crate::document::{Card, Document, Section};
use crate::figures::residuals::{ErrorNames, Residual, scenes};
use accuracy::{accuracy, profiles, terms};
use answer::{answer, headline, places};
use errors::machine;
pub(super) use errors::{combination, indistinguishable};

/// Describes an identification; `spec` and `map` are those of the job.
pub fn identification(spec: &Spec, map: &Map, report: &Report) -> Document {
    Document {
        kind: "Errors from measurements",
        machine: spec.title.clone(),
        title: report.title.clone(),
        headline: headline(report),
        verdict: report.accepted.as_ref().map(|verdict| accepted(verdict, spec.length)),
        panel: "Errors at a configuration",
        sections: [
            vec![answer(spec, report), Section::page("").cards(cards(report))],
            figures(spec, report),
            vec![
                machine(report),
                placement(report),
                identifiable(report),
                accuracy(spec, report),
                terms(report),
                profiles(spec, report),
                Section::page("Instrument").facts(instrument(spec, map)),
                data_rows(&report.files),
                notes(&report.notes, NOTES),
            ],
        ]
        .concat(),
        is_signed: report.accepted.is_some(),
        record: report.record.clone(),
    }
}

fn cards(report: &Report) -> Vec<Card> {
    let (factor, unit) = error_unit(report.length);
    let show = |sizes: &Sizes| format!("{} {unit}", fixed(factor * sizes.mean, 4));
    let card = |name, value, note: &str| Card { name, value, note: note.to_owned() };
    let fitted = "mean position error of the fitted rows";
    let folds = format!("{}-fold", report.cross_validation.folds);
    let mut all = vec![
        card("Base and tool fitted", show(&report.fit.base_and_tool), fitted),
        card("Identified", show(&report.fit.after), "the same rows"),
        card("Cross-validation", show(&report.cross_validation.after), &folds),
    ];
    if let Some(test) = &report.test {
        let note = match report.test_rows_of_the_fit {
            0 => format!("{} rows, used for validation only", test.rows),
            known => format!("{} rows, {known} of them also in the fit", test.rows),
        };
        all.push(card("Test rows", show(&test.after), &note));
    }
    let known = format!("{} of {}", report.rank, report.unknowns);
    all.push(card("Identifiable", known, "combinations of unknowns"));
    all
}

fn figures(spec: &Spec, report: &Report) -> Vec<Section> {
    let names = ErrorNames { before: "base and tool fitted", after: "identified" };
    let section = |title, is_test: bool| {
        let points = report.points.iter().filter(|point| point.is_test == is_test && !point.is_rejected);
        let residuals = points.map(|point| Residual {
            q: &point.q,
            point: point.point,
            before: Some(point.before),
            after: point.after,
        });
        let residuals: Vec<Residual<'_>> = residuals.collect();
        let drawn = if residuals.is_empty() { Vec::new() } else { scenes(&residuals, &names, spec) };
        Section::page(title).figures(drawn)
    };
    vec![section("Rows of the fit, without outliers", false), section("Test rows", true)]
}

/// Lists the placement of the machine and of what is mounted on its tool.
fn placement(report: &Report) -> Section {
    let table = places(report);
    let words = if table.rows.is_empty() {
        "The placement of the machine and of its tool is fixed to the values of the map."
    } else {
        "Errors before the first joint cannot be distinguished from the placement of the machine, \
         nor errors after the last joint from the mounting of targets; they count as placement. A \
         placement is no error of the machine: it is not written to the spec and not compensated."
    };
    Section::full("Placement of the machine and of its tool")
        .table(table)
        .state("placement", words.to_owned())
}

/// Lists what the data determine, and what they cannot distinguish.
fn identifiable(report: &Report) -> Section {
    let unexplained = (report.unexplained > 0).then(|| {
        format!(
            "{} more combinations have no effect at these configurations; other configurations may \
             reveal them.",
            report.unexplained
        )
    });
    Section::full("Indistinguishable errors")
        .state(
            "identifiable",
            format!(
                "Identifiable: {} combinations of {} unknowns, {}.",
                report.rank, report.unknowns, report.machine
            ),
        )
        .table(indistinguishable(&report.groups))
        .state("unexplained_combinations", unexplained)
        .state(
            "condition",
            format!("Condition number {} (columns of unit length).", digits(report.condition, 3)),
        )
}
