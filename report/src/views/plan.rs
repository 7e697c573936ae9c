//! Plan: what the measurements will determine, and how well.

use abbe_metrology::data::Map;
use abbe_metrology::plan::{Input, Report};
use abbe_spec::{Spec, option::MODEL_ERROR_LENGTH};
use abbe_study::number::{digits, error_unit, quantity};

use super::identification::{combination, indistinguishable};
use crate::document::{Document, Section, Table, first, joined};

/// Number of errors named on the first screen.
const NAMED: usize = 8;

/// Describes a plan; `spec` and `map` are those of the job.
pub fn plan(spec: &Spec, map: &Map, report: &Report) -> Document {
    let (factor, unit) = error_unit(report.length);
    let predicted = &report.predicted;
    let [mean, rms, p95, max] =
        [predicted.mean, predicted.rms, predicted.p95, predicted.max].map(|value| digits(factor * value, 3));
    let columns = ["predicted σ of the tool point", &format!(">mean {unit}"), ">rms", ">95 %", ">max"];
    let row = [format!("at {} configurations of use", report.used), mean, rms, p95, max];
    Document {
        kind: "Measurement plan",
        machine: spec.title.clone(),
        title: report.title.clone(),
        headline: format!("{} rows determine {} of {} unknowns", report.rows, report.rank, report.unknowns),
        sections: vec![
            Section::answer().table(Table::new("", columns).rows([row])).facts(facts(map, report)),
            about(report),
            Section::full("Indistinguishable errors").table(indistinguishable(&report.groups)),
        ],
        ..Document::default()
    }
}

fn facts(map: &Map, report: &Report) -> Vec<(&'static str, String)> {
    let (factor, unit) = error_unit(report.length);
    let instrument = map.noise(factor, unit);
    let model = match report.model_error {
        0.0 => "; unmodelled errors are not included".to_owned(),
        error => format!("; model error {} {unit} (rms)", digits(factor * error, 3)),
    };
    let mut facts = vec![
        ("Plan", report.title.clone()),
        ("Machine", report.machine.to_string()),
        ("Noise", format!("instrument {instrument}{model}")),
        ("Condition", digits(report.condition, 3)),
    ];
    if report.sets.len() > 1 {
        let sets: Vec<String> = report.sets.iter().map(|set| format!("{} {}", set.rows, set.name)).collect();
        facts.push(("Sets", first(&sets, 6)));
    }
    let sums = report.sums.iter().flat_map(|one| {
        let with = |(other, factor): &(String, f64)| {
            combination(&[(other.clone(), 1.0), (one.name.clone(), *factor)])
        };
        one.acts_as.iter().map(with)
    });
    let sums: Vec<String> = sums.collect();
    if !sums.is_empty() {
        facts.push(("Sums", format!("{}: these rows determine the sum, not its parts", first(&sums, NAMED))));
    }
    if !report.unseen.is_empty() {
        let names: Vec<&str> = report.unseen.iter().map(|error| error.name.as_str()).collect();
        let text = "not observable in these rows, but they move the tool point in use";
        facts.push(("Unseen", format!("{}: {text}", first(&names, NAMED))));
    }
    if !report.weakly_determined.is_empty() {
        let names: Vec<&str> = report.weakly_determined.iter().map(|error| error.name.as_str()).collect();
        let text = "poorly determined by these rows; an identification leaves most of their prior";
        facts.push(("Weak", format!("{}: {text}", first(&names, NAMED))));
    }
    facts
}

fn about(report: &Report) -> Section {
    let (factor, unit) = error_unit(report.length);
    let sets = report.sets.iter().map(|set| format!("{} {}", set.rows, set.name));
    let sets = (!report.sets.is_empty()).then(|| format!("{} rows: {}.", report.rows, joined(sets)));
    let inputs = report.inputs.iter().map(|Input { name, unit, between }| {
        let [least, largest] = between.map(|value| quantity(value, unit));
        match between[0] == between[1] {
            true => format!("{name} stays at {least}"),
            false => format!("{name} from {least} to {largest}"),
        }
    });
    let inputs = (!report.inputs.is_empty()).then(|| format!("Inputs: {}.", joined(inputs)));
    let noise = match report.model_error {
        0.0 => format!(
            "The prediction covers the noise of the instrument only; `{MODEL_ERROR_LENGTH}` adds the errors \
             that the model does not have, from an earlier fit."
        ),
        _ => "The model error is a root mean square, independent between configurations.".to_owned(),
    };
    let unseen: Vec<String> = report
        .unseen
        .iter()
        .map(|error| {
            format!("{} ({} {unit} for 1 {})", error.name, digits(factor * error.moves, 2), error.per)
        })
        .collect();
    let unseen = (!unseen.is_empty()).then(|| {
        format!(
            "These errors move the tool point in use but have no effect on these rows; the predicted σ does \
             not include them: {}.",
            first(&unseen, NAMED)
        )
    });
    let weak = (!report.weakly_determined.is_empty()).then(|| {
        format!(
            "Poorly determined by these rows: {}. Other configurations, a target farther from the axes or a \
             better instrument determine them.",
            joined(report.weakly_determined.iter().map(|error| error.name.as_str()))
        )
    });
    Section::full("Prediction")
        .state("sets", sets)
        .state("inputs", inputs)
        .state("noise", noise.to_owned())
        .state("not_observable", unseen)
        .state("poorly_determined", weak)
}
