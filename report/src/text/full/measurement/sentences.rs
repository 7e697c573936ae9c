//! Repeatability and prediction in words.

use abbe_metrology::measure::{InstrumentErrors, MeanAndMax, Report};
use abbe_study::number::{fixed, percent};

use crate::text::full::identification::residual_verdict;

/// Repeatability and prediction in words.
pub(crate) fn sentences(report: &Report) -> Vec<String> {
    let mut all = vec![behind(report)];
    if report.instruments.is_empty() {
        all.extend(repeatability(report));
        all.extend(variation(report));
    }
    all.extend(report.drift.iter().map(|drift| drift.sentence.clone()));
    all.push(explained(report));
    all.extend(agreement(report).map(|(_, sentence)| sentence));
    all.extend(report.other_tool.iter().map(|tool| tool.sentence.clone()));
    all.extend(report.extrapolated.iter().map(|extrapolated| extrapolated.sentence.clone()));
    all.extend(report.accepted.iter().map(|accepted| accepted.sentence(report.unit)));
    all
}

fn behind(report: &Report) -> String {
    let configurations = match report.configurations {
        1 => "one configuration, so the scatter between configurations is unknown".to_owned(),
        count => format!(
            "{count} independent configurations; the standard error of the mean norm is {}",
            report.standard_error.map_or("not known".to_owned(), |error| show(report, error))
        ),
    };
    format!("Sample: {configurations}.")
}

fn show(report: &Report, value: f64) -> String {
    format!("{} {}", fixed(value, decimals(report)), report.length)
}

fn mean_and_max(report: &Report, value: &MeanAndMax) -> String {
    format!("{} on average, {} at most", show(report, value.mean), show(report, value.max))
}

fn repeatability(report: &Report) -> Vec<String> {
    let repeated = &report.repeated;
    let (Some(ap), Some(rp), Some([x, y, z])) = (&repeated.ap, &repeated.rp, repeated.three_sigma) else {
        let none = "No configuration was visited twice: accuracy and repeatability of ISO 9283 need repeated \
         visits.";
        return vec![none.to_owned()];
    };
    let few = if repeated.fewest < 30 {
        format!(" The standard requires 30 visits of each configuration; some have only {}.", repeated.fewest)
    } else {
        String::new()
    };
    let mut all = vec![format!(
        "{} repeated configurations, {} visits in all. Pose accuracy AP (from the commanded point \
         to the barycentre of the visits, ISO 9283, 7.2.1): {}. Pose repeatability RP (mean \
         distance from the barycentre plus three standard deviations of that distance, 7.2.2): \
         {}. Three standard deviations about the barycentres: x {}, y {}, z {}.{few}",
        repeated.configurations,
        repeated.visits,
        mean_and_max(report, ap),
        mean_and_max(report, rp),
        show(report, x),
        show(report, y),
        show(report, z),
    )];
    if let (Some(ap), Some(rp)) = (&repeated.ap_turns, &repeated.rp_turns) {
        all.push(format!(
            "Rotations about x, y, z (7.2.1, 7.2.2), maximum: AP {}; RP (three standard \
             deviations) {}.",
            turns(ap),
            turns(rp)
        ));
    }
    all
}

/// States the figures of ISO 9283 by direction, for distances, and for drift.
fn variation(report: &Report) -> Vec<String> {
    let turned = |turns_of: &Option<[MeanAndMax; 3]>| {
        turns_of.as_ref().map_or(String::new(), |values| format!("; rotations at most {}", turns(values)))
    };
    let mut all = Vec::new();
    if let Some(directions) = &report.repeated.directions {
        let few = if directions.fewest < 3 || directions.fewest_visits < 30 {
            format!(
                " The standard asks for three directions with 30 visits each; some have {} and {}.",
                directions.fewest, directions.fewest_visits
            )
        } else {
            String::new()
        };
        all.push(format!(
            "Multi-directional pose accuracy variation vAP (largest distance between the barycentres of two directions, 7.2.3), \
             {} configurations: {}{}.{few}",
            directions.configurations,
            mean_and_max(report, &directions.vap),
            turned(&directions.vap_turns)
        ));
    }
    if let Some(distances) = &report.repeated.distances {
        all.push(format!(
            "Between two configurations, {} pairs: distance accuracy AD (mean minus commanded \
             distance, 7.3.2): {}{}. Distance repeatability RD (three standard deviations, \
             7.3.3): {}{}.",
            distances.pairs,
            mean_and_max(report, &distances.ad),
            turned(&distances.ad_turns),
            mean_and_max(report, &distances.rd),
            turned(&distances.rd_turns)
        ));
    }
    if let Some(drift) = &report.repeated.drift {
        all.push(format!(
            "Drift of pose characteristics (7.6: AP and RP of successive groups of ten visits, \
             against the first ten), {} configurations, up to {} groups: dAP {}{}; dRP {}{}.",
            drift.configurations,
            drift.most,
            mean_and_max(report, &drift.dap),
            turned(&drift.dap_turns),
            mean_and_max(report, &drift.drp),
            turned(&drift.drp_turns)
        ));
    }
    all
}

/// States the share of the errors that the repeatable sources explain.
fn explained(report: &Report) -> String {
    let explained = &report.explained;
    match explained.repeatable {
        0 => "The spec has no repeatable source that could explain the errors: `abbe identify` \
         estimates them."
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
                "The {repeatable} repeatable sources of the spec explain {share} of the sum of squares{of}{lengths}."
            )
        }
    }
}

/// Compares the remaining errors with the stated uncertainty, by the test of `identify`; with
/// random sources, states the share of the rows within the predicted 95 % region.
pub(in crate::text) fn agreement(report: &Report) -> Option<(&'static str, String)> {
    match report.explained.random {
        0 => {
            let test = report.residual_test?;
            let or = ", or these rows were used to identify the spec";
            let verdict = residual_verdict(test.factor, test.p, "the spec does not have", or);
            Some(("Residuals", verdict))
        }
        random => region(report, random).map(|sentence| ("Region", sentence)),
    }
}

/// States the share of the rows within the predicted 95 % region; none of single readings.
fn region(report: &Report, random: usize) -> Option<String> {
    let explained = &report.explained;
    let (inside, [low, high]) = (explained.inside?, explained.likely?);
    let chance = format!("{random} random sources, independent in each row, and the noise of the instrument");
    let verdict = match inside {
        inside if inside < low => {
            "there may be errors that the spec does not have, or the instrument is worse than \
             stated"
        }
        inside if inside > high => "the random sources or the noise may be smaller than stated",
        _ => "as expected",
    };
    let [low, high] = [low, high].map(|share| percent(share.min(1.0), 1.0));
    Some(format!(
        "{} of the rows are within the predicted 95 % region, which covers {chance}: {verdict}. For 99 % of \
         the machines that match the spec, this share is {low} to {high}.",
        percent(inside, 1.0)
    ))
}

/// Returns how many decimals a length has.
pub(super) fn decimals(report: &Report) -> usize {
    if report.length == "m" { 7 } else { 4 }
}

/// The largest of three turns.
fn turns(values: &[MeanAndMax; 3]) -> String {
    let [a, b, c] = values.map(|value| fixed(value.max * 1e3, 4));
    format!("{a}, {b}, {c} mrad")
}
