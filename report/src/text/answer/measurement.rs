//! The answer of a measurement: acceptance, accuracy, repeatability, and the explained share.

use abbe_metrology::measure::Report;
use abbe_spec::Spec;
use abbe_study::number::{counted, digits, fixed, percent};

use super::full::measurement::agreement;
use super::{Answer, aligned, error_unit};

/// Number of instruments shown.
const SHOWN: usize = 8;

pub(in crate::text) fn measurement(spec: &Spec, report: &Report) -> String {
    let headline = match &report.accepted {
        Some(accepted) => accepted.sentence(report.unit),
        None => format!(
            "{} measured at {}",
            counted(report.rows, "row", "rows"),
            counted(report.configurations, "independent configuration", "independent configurations")
        ),
    };
    let mut answer = Answer::new(&format!("{}: {headline}", spec.title));
    answer.block(&if report.instruments.is_empty() { points(report) } else { instruments(report) });
    answer.facts(facts(report));
    answer.0
}

/// The error of the measured points, and what the spec leaves of it.
fn points(report: &Report) -> String {
    let (factor, unit) = error_unit(report.length);
    let mut rows = vec![["measured − ideal", "mean", "rms", "max", "3 σ", ""].map(str::to_owned)];
    rows.extend(report.errors.iter().map(|size| {
        let (factor, unit) = if size.unit == "rad" { (1e3, "mrad") } else { (factor, unit) };
        let [mean, rms, max, sigma] =
            [size.mean, size.rms, size.max, size.three_sigma].map(|value| fixed(factor * value, 4));
        // One row has no scatter.
        let sigma = if report.rows > 1 { sigma } else { String::new() };
        [size.name.to_owned(), mean, rms, max, sigma, unit.to_owned()]
    }));
    let explained = &report.explained;
    if explained.repeatable > 0 {
        let [mean, rms, max] = [explained.left_mean, explained.left_rms, explained.left_max]
            .map(|value| fixed(factor * value, 4));
        rows.push([
            "norm after the spec's errors".to_owned(),
            mean,
            rms,
            max,
            String::new(),
            unit.to_owned(),
        ]);
    }
    aligned(&rows, [false, true, true, true, true, false])
}

fn instruments(report: &Report) -> String {
    let all = &report.instruments;
    let head = ["reading − prediction", "count", "mean", "rms", "max", "rms if ideal", "stated σ", ""];
    let mut rows = vec![head.map(str::to_owned)];
    rows.extend(all.iter().take(SHOWN).map(|one| {
        let [mean, rms, max, ideal] =
            [one.left.mean, one.left.rms, one.left.max, one.ideal.rms].map(|value| digits(value, 4));
        let stated = one.uncertainty.map_or("unknown".to_owned(), |sigma| digits(sigma, 4));
        [one.name.clone(), one.count.to_string(), mean, rms, max, ideal, stated, one.unit.clone()]
    }));
    let more = match all.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!("  … and {more} more\n"),
    };
    aligned(&rows, [false, true, true, true, true, true, true, false]) + &more
}

fn facts(report: &Report) -> Vec<(&'static str, String)> {
    let (factor, unit) = error_unit(report.length);
    let show = |value: f64| format!("{} {unit}", fixed(factor * value, 4));
    let mut facts = Vec::new();
    let repeated = &report.repeated;
    if let (Some(ap), Some(rp)) = (&repeated.ap, &repeated.rp) {
        facts.push((
            "ISO 9283",
            format!(
                "AP {} mean, {} max; RP {} mean, {} max; {}, at least {} each",
                show(ap.mean),
                show(ap.max),
                show(rp.mean),
                show(rp.max),
                counted(repeated.configurations, "repeated configuration", "repeated configurations"),
                counted(repeated.fewest, "visit", "visits")
            ),
        ));
    }
    let explained = &report.explained;
    facts.push((
        "Explained",
        match explained.repeatable {
            0 => "nothing: the spec has no repeatable source".to_owned(),
            count => format!(
                "{} of the sum of squares, by {}",
                percent(explained.share, 1.0),
                counted(count, "repeatable source", "repeatable sources")
            ),
        },
    ));
    if report.instruments.iter().any(|one| one.unit == "px") {
        let (mean, max) = (show(explained.left_mean), show(explained.left_max));
        facts.push(("Distance", format!("corner to line of sight {mean} mean, {max} max")));
    }
    facts.extend(agreement(report));
    facts.extend(report.drift.iter().map(|order| ("Drift", order.sentence.clone())));
    facts.extend(report.other_tool.iter().map(|tool| ("Tool", super::other_tool(tool, report.length))));
    facts.extend(report.extrapolated.iter().map(|rows| ("Outside", super::outside(rows))));
    if report.base_fitted {
        facts.push(("Station", "fitted to these rows; errors that it absorbs are not included".to_owned()));
    }
    if report.tool_fitted {
        let place = "place on the tool fitted to these rows; errors that it absorbs are not included";
        facts.push(("Target", place.to_owned()));
    }
    facts.extend(super::data(&report.file));
    facts
}
