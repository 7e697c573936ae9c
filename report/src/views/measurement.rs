//! Measurement: acceptance, accuracy, repeatability, and the explained share.

use abbe_metrology::Judged;
use abbe_metrology::data::Map;
use abbe_metrology::measure::{InstrumentErrors, MeanAndMax, Report};
use abbe_spec::{Spec, option::IDENTIFY_OUT};
use abbe_study::number::{counted, digits, error_unit, fixed, percent};

use super::shared::{
    NOTES, accepted, data_rows, drift_clauses, extrapolated, first_notes, first_rows, instrument, notes,
    residual_verdict,
};
use crate::document::{Card, Document, Section, Table};
use crate::figures::measured;

/// Number of instruments on the first screen.
const SHOWN: usize = 8;

/// Describes a measurement; `spec` and `map` are those of the job.
pub fn measurement(spec: &Spec, map: &Map, report: &Report) -> Document {
    let headline = match &report.accepted {
        Some(verdict) => accepted(verdict, report.unit).text,
        None => format!(
            "{} measured at {}",
            counted(report.rows, "row", "rows"),
            counted(report.configurations, "independent configuration", "independent configurations")
        ),
    };
    let (points, instruments) = match report.instruments.is_empty() {
        true => (Some(points(report, map.is_corrected)), None),
        false => (None, Some(instruments(report))),
    };
    let mut first = Section::answer();
    first = points.into_iter().chain(instruments).fold(first, Section::table);
    Document {
        kind: "Measured",
        machine: spec.title.clone(),
        title: report.title.clone(),
        headline,
        verdict: report.accepted.as_ref().map(|verdict| accepted(verdict, report.unit)),
        panel: "Errors at a configuration",
        sections: vec![
            first.facts(facts(report)),
            Section::page("").cards(cards(report, map.is_corrected)),
            Section::page("Figures").figures(measured::scenes(report, spec)),
            rule(report),
            fitted(report),
            standards(report),
            explained(report),
            all_instruments(report),
            notes(&report.notes, NOTES),
            Section::page("Instrument").facts(instrument(spec, map)),
            data_rows(std::slice::from_ref(&report.file)),
        ],
        is_signed: report.accepted.is_some(),
        record: report.record.clone(),
    }
}

/// Tabulates the error of the measured points, and what the spec leaves of it: with corrected
/// commands, how far they are from where the program meant.
fn points(report: &Report, is_corrected: bool) -> Table {
    let (lengths, length) = error_unit(report.length);
    let (title, left) = match is_corrected {
        true => ("measured − ideal at these commands", "norm from what the program meant"),
        false => ("measured − ideal", "norm after the spec's errors"),
    };
    let columns = [title, ">mean", ">rms", ">max", ">3 σ", ""];
    let mut table = Table::new("", columns).rows(report.errors.iter().map(|size| {
        let (factor, unit) = if size.unit == "rad" { (1e3, "mrad") } else { (lengths, length) };
        let [mean, rms, max, sigma] =
            [size.mean, size.rms, size.max, size.three_sigma].map(|value| fixed(factor * value, 4));
        // One row has no scatter.
        let sigma = if report.rows > 1 { sigma } else { String::new() };
        [size.name.to_owned(), mean, rms, max, sigma, unit.to_owned()]
    }));
    let explained = &report.explained;
    if explained.repeatable > 0 {
        let [mean, rms, max] = [explained.left_mean, explained.left_rms, explained.left_max]
            .map(|value| fixed(lengths * value, 4));
        table.row([left.to_owned(), mean, rms, max, String::new(), length.to_owned()]);
    }
    table
}

fn instruments(report: &Report) -> Table {
    let columns =
        ["reading − prediction", ">count", ">mean", ">rms", ">max", ">rms if ideal", ">stated σ", ""];
    let all = &report.instruments;
    let mut table = Table::new("", columns).rows(all.iter().take(SHOWN).map(|one| {
        let [mean, rms, max, ideal] =
            [one.left.mean, one.left.rms, one.left.max, one.ideal.rms].map(|value| digits(value, 4));
        [one.name.clone(), one.count.to_string(), mean, rms, max, ideal, stated(one), one.unit.clone()]
    }));
    if all.len() > SHOWN {
        table.rest = format!("… and {} more", all.len() - SHOWN);
    }
    table
}

fn stated(one: &InstrumentErrors) -> String {
    one.uncertainty.map_or("unknown".to_owned(), |sigma| digits(sigma, 4))
}

/// Tabulates all instruments, with the standard errors of their means.
fn all_instruments(report: &Report) -> Section {
    let columns =
        ["name", "unit", ">read", ">mean", ">std. error", ">rms", ">rms if ideal", ">max", ">stated σ"];
    let rows = report.instruments.iter().map(|one| {
        let [mean, rms, ideal, max] =
            [one.left.mean, one.left.rms, one.ideal.rms, one.left.max].map(|value| digits(value, 4));
        let error = one.left.standard_error.map_or(String::new(), |error| digits(error, 2));
        let (name, unit) = (one.name.clone(), one.unit.clone());
        [name, unit, one.count.to_string(), mean, error, rms, ideal, max, stated(one)]
    });
    let caption = "Reading − prediction with the repeatable sources of the spec; if ideal: without them";
    Section::full("Instruments").table(Table::new(caption, columns).rows(rows))
}

fn facts(report: &Report) -> Vec<(&'static str, String)> {
    let explained = &report.explained;
    let mut facts = Vec::new();
    let repeated = &report.repeated;
    if let (Some(ap), Some(rp)) = (&repeated.ap, &repeated.rp) {
        let text = format!(
            "AP {} mean, {} max; RP {} mean, {} max; {}, at least {} each",
            show(report, ap.mean),
            show(report, ap.max),
            show(report, rp.mean),
            show(report, rp.max),
            counted(repeated.configurations, "repeated configuration", "repeated configurations"),
            counted(repeated.fewest, "visit", "visits")
        );
        facts.push(("ISO 9283", text));
    }
    let text = match explained.repeatable {
        0 => "nothing: the spec has no repeatable source".to_owned(),
        count => format!(
            "{} of the sum of squares, by {}",
            percent(explained.share, 1.0),
            counted(count, "repeatable source", "repeatable sources")
        ),
    };
    facts.push(("Explained", text));
    facts.extend(report.agreed.iter().map(|verdict| ("Model", accepted(verdict, report.unit).text)));
    if report.instruments.iter().any(|one| one.unit == "px") {
        let (mean, max) = (show(report, explained.left_mean), show(report, explained.left_max));
        facts.push(("Distance", format!("corner to line of sight {mean} mean, {max} max")));
    }
    facts.extend(agreement(report));
    facts.extend(report.drift.iter().map(|order| ("Drift", drift_clauses(order, report.unit).concat())));
    facts.extend(report.extrapolated.iter().map(|rows| ("Outside", extrapolated(rows))));
    if report.base_fitted {
        facts.push(("Station", "fitted to these rows; errors that it absorbs are not included".to_owned()));
    }
    if report.tool_fitted {
        let place = "place on the tool fitted to these rows; errors that it absorbs are not included";
        facts.push(("Target", place.to_owned()));
    }
    facts.extend(first_notes(&report.notes));
    facts.extend(first_rows(std::slice::from_ref(&report.file)));
    facts
}

fn cards(report: &Report, is_corrected: bool) -> Vec<Card> {
    let explained = &report.explained;
    let norm = report.errors.iter().find(|size| size.name == "norm");
    let values = norm.into_iter().flat_map(|norm| match is_corrected {
        true => [explained.left_mean, explained.left_rms, explained.left_max],
        false => [norm.mean, norm.rms, norm.max],
    });
    let note = if is_corrected { "from what the program meant" } else { "measured − ideal" };
    let card = |(name, value)| Card { name, value: show(report, value), note: note.to_owned() };
    let norms = ["Mean error", "Root mean square", "Largest error"].into_iter().zip(values).map(card);
    let rows = Card {
        name: "Rows",
        value: report.rows.to_string(),
        note: format!("{} independent configurations", report.configurations),
    };
    norms.chain([rows]).collect()
}

/// States the rule by which the machine was accepted or not.
fn rule(report: &Report) -> Section {
    let rule = report.accepted.as_ref().map(|verdict| {
        let target = match verdict.judged {
            Judged::Corrected => {
                "where the machine with the errors of its spec should be with these commands"
            }
            _ => "the ideal machine",
        };
        let rule = if verdict.limits.iter().all(|limit| limit.uncertainty > 0.0) {
            "A figure is accepted if it is within its limit by at least the expanded uncertainty of the \
             measurement, and rejected if beyond by more than that (ISO 14253-1, JCGM 106: a risk of at \
             most 5 %, one-sided, by the stated uncertainty of the instrument)."
        } else {
            "The uncertainty of the measurement is not stated, and not counted."
        };
        format!("Errors from {target} are judged. {rule}")
    });
    Section::full("Decision rule").state("decision_rule", rule)
}

/// States what was fitted to the rows, and is therefore not among their errors.
fn fitted(report: &Report) -> Section {
    let station = report.base_fitted.then_some(match report.instruments.is_empty() {
        true => {
            "The station of the instrument was fitted to these rows, for the machine of the spec: errors \
             common to all rows are not included."
                .to_owned()
        }
        false => format!(
            "The stations of the instruments were fitted to these rows, for the machine of the spec: \
             errors that they explain are not included. The map of `{IDENTIFY_OUT}` has the identified \
             stations."
        ),
    });
    let target = report.tool_fitted.then(|| {
        "The place on the tool that the map does not state was fitted to these rows, for the machine of \
         the spec: errors that it absorbs are not included."
            .to_owned()
    });
    Section::full("Fitted to these rows").state("fitted_station", station).state("fitted_target", target)
}

fn show(report: &Report, value: f64) -> String {
    let (factor, unit) = error_unit(report.length);
    format!("{} {unit}", fixed(factor * value, 4))
}

fn mean_and_max(report: &Report, value: &MeanAndMax) -> String {
    format!("{} on average, {} at most", show(report, value.mean), show(report, value.max))
}

/// Formats the largest of three rotations.
fn rotations(values: &[MeanAndMax; 3]) -> String {
    let [a, b, c] = values.map(|value| fixed(value.max * 1e3, 4));
    format!("{a}, {b}, {c} mrad")
}

fn with_rotations(values: &Option<[MeanAndMax; 3]>) -> String {
    values.as_ref().map_or(String::new(), |values| format!("; rotations at most {}", rotations(values)))
}

/// States the figures of ISO 9283, if points were measured.
fn standards(report: &Report) -> Section {
    let section = Section::full("Accuracy and repeatability").state("sample", sample(report));
    if !report.instruments.is_empty() {
        return section;
    }
    section
        .state("repeatability", repeatability(report))
        .state("repeatability_of_rotations", repeatability_of_rotations(report))
        .state("directions", directions(report))
        .state("distances", distances(report))
        .state("drift_of_characteristics", drift(report))
}

fn sample(report: &Report) -> String {
    let configurations = match report.configurations {
        1 => "one configuration, so the scatter between configurations is unknown".to_owned(),
        count => format!(
            "{count} independent configurations; the standard error of the mean norm is {}",
            report.standard_error.map_or("not known".to_owned(), |error| show(report, error))
        ),
    };
    format!("Sample: {configurations}.")
}

fn repeatability(report: &Report) -> String {
    let repeated = &report.repeated;
    let (Some(ap), Some(rp), Some(about)) = (&repeated.ap, &repeated.rp, repeated.three_sigma) else {
        return "No configuration was visited twice: accuracy and repeatability of ISO 9283 need repeated \
                visits."
            .to_owned();
    };
    let few = match repeated.fewest {
        30.. => String::new(),
        few => format!(" The standard requires 30 visits of each configuration; some have only {few}."),
    };
    let [x, y, z] = about.map(|value| show(report, value));
    format!(
        "{} repeated configurations, {} visits in all. Pose accuracy AP (from the commanded point to the \
         barycentre of the visits, ISO 9283, 7.2.1): {}. Pose repeatability RP (mean distance from the \
         barycentre plus three standard deviations of that distance, 7.2.2): {}. Three standard \
         deviations about the barycentres: x {x}, y {y}, z {z}.{few}",
        repeated.configurations,
        repeated.visits,
        mean_and_max(report, ap),
        mean_and_max(report, rp),
    )
}

fn repeatability_of_rotations(report: &Report) -> Option<String> {
    let (ap, rp) = (report.repeated.ap_turns.as_ref()?, report.repeated.rp_turns.as_ref()?);
    Some(format!(
        "Rotations about x, y, z (7.2.1, 7.2.2), maximum: AP {}; RP (three standard deviations) {}.",
        rotations(ap),
        rotations(rp)
    ))
}

fn directions(report: &Report) -> Option<String> {
    let directions = report.repeated.directions.as_ref()?;
    let few = match directions.fewest < 3 || directions.fewest_visits < 30 {
        false => String::new(),
        true => format!(
            " The standard asks for three directions with 30 visits each; some have {} and {}.",
            directions.fewest, directions.fewest_visits
        ),
    };
    Some(format!(
        "Multi-directional pose accuracy variation vAP (largest distance between the barycentres of two \
         directions, 7.2.3), {} configurations: {}{}.{few}",
        directions.configurations,
        mean_and_max(report, &directions.vap),
        with_rotations(&directions.vap_turns)
    ))
}

fn distances(report: &Report) -> Option<String> {
    let distances = report.repeated.distances.as_ref()?;
    Some(format!(
        "Between two configurations, {} pairs: distance accuracy AD (mean minus commanded distance, \
         7.3.2): {}{}. Distance repeatability RD (three standard deviations, 7.3.3): {}{}.",
        distances.pairs,
        mean_and_max(report, &distances.ad),
        with_rotations(&distances.ad_turns),
        mean_and_max(report, &distances.rd),
        with_rotations(&distances.rd_turns)
    ))
}

fn drift(report: &Report) -> Option<String> {
    let drift = report.repeated.drift.as_ref()?;
    Some(format!(
        "Drift of pose characteristics (7.6: AP and RP of successive groups of ten visits, against the \
         first ten), {} configurations, up to {} groups: dAP {}{}; dRP {}{}.",
        drift.configurations,
        drift.most,
        mean_and_max(report, &drift.dap),
        with_rotations(&drift.dap_turns),
        mean_and_max(report, &drift.drp),
        with_rotations(&drift.drp_turns)
    ))
}

/// States the share of the errors that the repeatable sources explain.
fn explained(report: &Report) -> Section {
    let section = Section::full("Errors that the spec explains");
    let explained = &report.explained;
    let sentence = match explained.repeatable {
        0 => "The spec has no repeatable source that could explain the errors: `abbe identify` estimates \
              them."
            .to_owned(),
        repeatable => {
            let lengths = match report.instruments.iter().all(InstrumentErrors::is_angle) {
                true if !report.instruments.is_empty() => String::new(),
                _ => format!(
                    "; {} remain on average, {} at most",
                    show(report, explained.left_mean),
                    show(report, explained.left_max)
                ),
            };
            let of = if report.instruments.is_empty() { "" } else { " in units of the uncertainty" };
            let share = percent(explained.share, 1.0);
            format!(
                "The {repeatable} repeatable sources of the spec explain {share} of the sum of \
                 squares{of}{lengths}."
            )
        }
    };
    section
        .state("explained", sentence)
        .state("extrapolated", report.extrapolated.as_ref().map(|rows| rows.sentence.clone()))
}

/// Compares the remaining errors with the stated uncertainty, by the test of `identify`; with
/// random sources, states the share of the rows within the predicted 95 % region.
fn agreement(report: &Report) -> Option<(&'static str, String)> {
    match report.explained.random {
        0 => {
            let test = report.residual_test?;
            let or = ", or these rows were used to identify the spec";
            Some(("Residuals", residual_verdict(test.factor, test.p, "the spec does not have", or)))
        }
        random => region(report, random).map(|sentence| ("Region", sentence)),
    }
}

/// States the share of the rows within the predicted 95 % region; none of single readings.
fn region(report: &Report, random: usize) -> Option<String> {
    let explained = &report.explained;
    let (inside, [low, high]) = (explained.inside?, explained.likely?);
    let verdict = match inside {
        inside if inside < low => {
            "there may be errors that the spec does not have, or the instrument is worse than stated"
        }
        inside if inside > high => "the random sources or the noise may be smaller than stated",
        _ => "as expected",
    };
    let [low, high] = [low, high].map(|share| percent(share.min(1.0), 1.0));
    Some(format!(
        "{} of the rows are within the predicted 95 % region, which covers {random} random sources, \
         independent in each row, and the noise of the instrument: {verdict}. For 99 % of the machines \
         that match the spec, this share is {low} to {high}.",
        percent(inside, 1.0)
    ))
}
