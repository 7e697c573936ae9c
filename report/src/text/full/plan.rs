//! Full text of a plan.

use abbe_metrology::data::Map;
use abbe_metrology::plan::{Input, Report, UndeterminedError};
use abbe_spec::Spec;
use abbe_study::number::{digits, quantity};

use super::{indistinguishable, wrapped};

/// Returns what `abbe plan` prints, except where the configurations are written.
pub(in crate::text) fn plan(spec: &Spec, map: &Map, report: &Report) -> String {
    let unit = report.length;
    let mut text = format!("{}: measurement plan\n\n{}\n", spec.title, wrapped(&report.title, 0));
    let sets: Vec<String> = report.sets.iter().map(|set| format!("{} {}", set.rows, set.name)).collect();
    if !sets.is_empty() {
        text += &format!("{} rows: {}.\n", report.rows, sets.join(", "));
    }
    let inputs: Vec<String> = report.inputs.iter().map(input).collect();
    if !inputs.is_empty() {
        text += &format!("{}\n", wrapped(&format!("Inputs: {}.", inputs.join(", ")), 0));
    }
    let sentence = format!(
        "They determine {} combinations of {} unknowns ({}), with a condition number of {}.",
        report.rank,
        report.unknowns,
        report.machine,
        digits(report.condition, 3)
    );
    text += &format!("{}\n", wrapped(&sentence, 0));
    let fine = |value: f64| format!("{} {unit}", digits(value, 3));
    let model = match report.model_error {
        0.0 => String::new(),
        error => format!(
            " and a model error of {} (root mean square, independent between configurations)",
            fine(error)
        ),
    };
    let sentence = format!(
        "With an instrument uncertainty of {}{model}, the predicted standard deviation of \
         the tool point of the identified machine is {} on average over {} configurations of use, \
         and {} at most.",
        map.noise(1.0, unit),
        fine(report.predicted.mean),
        report.used,
        fine(report.predicted.max)
    );
    text += &format!("{}\n", wrapped(&sentence, 0));
    if report.model_error == 0.0 {
        let sentence = "This covers the noise of the instrument only; `--model-error LENGTH` adds \
            the errors that the model does not have, from an earlier fit.";
        text += &format!("{}\n", wrapped(sentence, 0));
    }
    if !report.unseen.is_empty() {
        text += &format!("{}\n", wrapped(&unseen(&report.unseen, unit), 0));
    }
    if let Some(mounting) = &report.mounting {
        let sentence = format!("Hidden: {}. Mount {}.", mounting.statement, mounting.advice);
        text += &format!("{}\n", wrapped(&sentence, 0));
    }
    if !report.not_known.is_empty() {
        let names: Vec<&str> = report.not_known.iter().map(|not_known| &not_known.name[..]).collect();
        let line = format!(
            "Poorly determined by these rows: {}. An identification will fix them at zero. Other \
             configurations, a target farther from the axes or a better instrument determine \
             them.",
            names.join(", ")
        );
        text += &format!("{}\n", wrapped(&line, 0));
    }
    text + &format!("\n{}\n", indistinguishable::table(&report.groups))
}

/// `payload goes from 0 kg to 5 kg`, or `payload stays at 0 kg`.
fn input(Input { name, unit, between }: &Input) -> String {
    let [least, largest] = between.map(|value| quantity(value, unit));
    match between[0] == between[1] {
        true => format!("{name} stays at {least}"),
        false => format!("{name} from {least} to {largest}"),
    }
}

/// Number of errors named.
const NAMED: usize = 6;

/// Lists errors that the rows do not show.
fn unseen(unseen: &[UndeterminedError], unit: &str) -> String {
    let each = unseen.iter().take(NAMED);
    let each =
        each.map(|error| format!("{} ({} {unit} for 1 {})", error.name, digits(error.moves, 2), error.per));
    let more = match unseen.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!(
        "These errors move the tool point in use but have no effect on these rows; the figures \
         above do not include them: {}{more}.",
        each.collect::<Vec<_>>().join(", ")
    )
}
