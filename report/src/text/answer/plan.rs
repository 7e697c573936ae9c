//! The answer of a plan: what the measurements will determine, and how well.

use abbe_metrology::data::Map;
use abbe_metrology::plan::Report;
use abbe_spec::Spec;
use abbe_study::number::digits;

use super::{Answer, aligned, error_unit, first};

pub(in crate::text) fn plan(spec: &Spec, map: &Map, report: &Report) -> String {
    let (factor, unit) = error_unit(report.length);
    let mut answer = Answer::new(&format!(
        "{}: {} rows determine {} of {} unknowns",
        spec.title, report.rows, report.rank, report.unknowns
    ));
    let predicted = &report.predicted;
    let [mean, rms, p95, max] =
        [predicted.mean, predicted.rms, predicted.p95, predicted.max].map(|value| digits(factor * value, 3));
    let head = ["predicted σ of the tool point", &format!("mean {unit}"), "rms", "95 %", "max"];
    let row = [format!("at {} configurations of use", report.used), mean, rms, p95, max];
    answer.block(&aligned(&[head.map(str::to_owned), row], [false, true, true, true, true]));
    let names = |names: Vec<&str>| first(&names, 8);
    let instrument = map.noise(factor, unit);
    let model = match report.model_error {
        0.0 => "; errors that the model does not have come on top".to_owned(),
        error => format!("; model error {} {unit} (rms)", digits(factor * error, 3)),
    };
    let mut facts = vec![
        ("Machine", report.machine.to_string()),
        ("Noise", format!("instrument {instrument}{model}")),
        ("Condition", digits(report.condition, 3)),
    ];
    if report.sets.len() > 1 {
        let sets: Vec<String> = report.sets.iter().map(|set| format!("{} {}", set.rows, set.name)).collect();
        facts.push(("Sets", first(&sets, 6)));
    }
    if !report.unseen.is_empty() {
        let unseen = names(report.unseen.iter().map(|error| &error.name[..]).collect());
        facts.push((
            "Unseen",
            format!("{unseen}: not observable in these rows, but they move the tool point in use"),
        ));
    }
    if let Some(mounting) = &report.mounting {
        facts.push(("Hidden", mounting.statement.clone()));
        facts.push(("Mount", mounting.advice.clone()));
    }
    if !report.not_known.is_empty() {
        let weak = names(report.not_known.iter().map(|error| &error.name[..]).collect());
        facts.push((
            "Weak",
            format!(
                "{weak}: poorly determined by these rows; an identification would fix them at \
                zero"
            ),
        ));
    }
    answer.facts(facts);
    answer.0
}
