//! The tolerance verdict, in sentences.

use abbe::analysis::{Compliance, Measurand, Yield};

use super::conclusions::singular_sentence;
use crate::unit;
use abbe_spec::Spec;
use abbe_study::analyze::{
    CompensatedVerdicts, CompensationBasis, MachineVerdicts, Report, ToleranceVerdict, Verdict,
};
use abbe_study::number;
use abbe_study::study_file::{Criterion, JudgedMachine};

/// Returns the verdict in one line, such as `Verdict: not met`; `None` if the study has no
/// tolerance.
pub(super) fn verdict_line(report: &Report) -> Option<String> {
    let verdicts = report.verdicts.as_ref()?;
    let least = verdicts
        .all()
        .map(|verdict| verdict.compliance)
        .min_by(|a, b| a.probability.total_cmp(&b.probability));
    Some(match verdicts.verdict {
        Verdict::Met if verdicts.criterion == Criterion::Probability => {
            format!("Verdict: met with probability {}", probability(least?))
        }
        Verdict::Met => format!("Verdict: met {}", by_criterion(verdicts.criterion, &report.spec)),
        Verdict::NotMet => "Verdict: not met".to_owned(),
    })
}

/// Returns the sentences on each tolerance: for the machine as built, and for the compensated
/// one if it is known.
pub(super) fn verdict_sentences(report: &Report) -> Vec<String> {
    let Some(verdicts) = &report.verdicts else { return Vec::new() };
    let Some(compensated) = &verdicts.compensated else {
        return machine_sentences(report, &verdicts.as_built, None);
    };
    let mut sentences = vec![format!(
        "The verdict is on the machine {}.",
        match verdicts.machine {
            JudgedMachine::AsBuilt => "as built, without compensation",
            JudgedMachine::Compensated => "after compensation",
        }
    )];
    sentences.extend(machine_sentences(report, &verdicts.as_built, None));
    sentences.extend(machine_sentences(report, &compensated.verdicts, Some(compensated)));
    sentences
}

fn machine_sentences(
    report: &Report,
    verdicts: &MachineVerdicts,
    compensated: Option<&CompensatedVerdicts>,
) -> Vec<String> {
    verdicts.all().map(|verdict| tolerance_sentence(report, verdict, compensated)).collect()
}

fn tolerance_sentence(
    report: &Report,
    verdict: &ToleranceVerdict,
    compensated: Option<&CompensatedVerdicts>,
) -> String {
    let show = |value| unit::with_symbol(report, verdict.measurand, value);
    let name = match verdict.measurand {
        Measurand::Position => "Position",
        Measurand::Orientation => "Orientation",
    };
    let name = compensated.map_or(name.to_owned(), |_| format!("{name}, compensated"));
    let repeatable = match compensated.map(|compensated| compensated.basis) {
        None => "repeatable sources at their values",
        Some(CompensationBasis::Stated) => {
            "what the study says compensation leaves of the repeatable sources, with unknown signs"
        }
        Some(CompensationBasis::Identified) => {
            "all repeatable sources of the spec corrected, with the uncertainty of the identified errors \
             but not that of the place of the tool on the last frame"
        }
        Some(CompensationBasis::Published) => {
            "the published residual of the repeatable sources, in an unknown direction"
        }
    };
    let contains = format!("95 % of the errors there have a norm of at most {}.", show(verdict.u95));
    let tolerance = show(verdict.tolerance);
    let all = report.configurations_of(verdict.measurand);
    let left_out = match all < report.configurations {
        true => format!(" {}", singular_sentence(report)),
        false => String::new(),
    };
    let at = report.label_at(verdict.configuration);
    let all = compensated.map_or(all, |compensated| compensated.checked);
    let met = if verdict.verdict == Verdict::NotMet { "not met" } else { "met" };
    let normal = if verdict.is_bounded { "" } else { ", normal ones at 3 σ" };
    let judged = |what: &str, error: f64| {
        format!(
            "{name}: {met}. {what} {} of {tolerance}, at {at}, of {all} configurations. To first order, \
             with {repeatable}{normal}. The probability of keeping the tolerance is {} where it is least. \
             {contains}{left_out}",
            show(error),
            probability(verdict.compliance)
        )
    };
    match report.study.criterion {
        Criterion::WorstCase => {
            return judged("Over all signs, errors at their bounds add up to", verdict.worst_case);
        }
        Criterion::RootSumOfSquares => {
            let what = "By convention, not as a bound, the sum of the repeatable errors and the root sum of \
                        squares of the bounds of the others are";
            return judged(what, verdict.radius);
        }
        Criterion::Yield => {
            let machines = compensated.map_or_else(
                || report.verdicts.as_ref()?.as_built.yielded,
                |compensated| compensated.verdicts.yielded,
            );
            let share = |share: f64| format!("{} %", number::trimmed(100.0 * share, 2));
            let Some(Yield { machines, configurations, share: kept, interval: [from, to] }) = machines else {
                return String::new();
            };
            return format!(
                "{name}: {met}. Of {machines} machines drawn, {} keep every tolerance at all of {configurations} \
                 configurations, each with a probability of {}; with 95 % confidence {} to {}; {} is required. \
                 To first order, with {repeatable}.{left_out}",
                share(kept),
                number::at_least(report.study.probability),
                share(from),
                share(to),
                number::at_least(report.study.required_yield),
            );
        }
        Criterion::Probability => {}
    }
    let least = match verdict.configurations {
        1 if all == 1 => "the only configuration".to_owned(),
        some if some < all => {
            format!(
                "the lowest of {all} configurations, checked at the {some} most likely to be \
                 worst"
            )
        }
        _ => format!("the lowest of all {all} configurations"),
    };
    let required = number::at_least(report.study.probability);
    let enough = format!("{required} is required");
    format!(
        "{name}: {met}. The error is within {tolerance} with probability {}; {enough}. This \
         is {least}, at {at}. To first order, {repeatable}. {contains}{left_out}",
        probability(verdict.compliance)
    )
}

/// Formats the probability that the tolerance is met with its standard error, such as
/// `= 97.35 % ± 0.02 %`, or a bound, such as `< 0.002 %`.
pub(super) fn stated_probability(verdict: &ToleranceVerdict) -> String {
    let text = probability(verdict.compliance);
    if text.starts_with(['<', '>']) { text } else { format!("= {text}") }
}

/// Formats a probability with the standard error of its draws, such as `97.35 % ± 0.02 %`; a
/// one-sided bound if all draws agree.
fn probability(Compliance { probability, error, draws }: Compliance) -> String {
    let percent = |p: f64| format!("{} %", number::trimmed(100.0 * p, 2));
    match draws {
        // Rule of three: if none of N draws differs, the rate is below 3/N with 95 % confidence.
        Some(draws) if probability == 1.0 => {
            format!("> {} %", number::trimmed(100.0 * (1.0 - 3.0 / draws as f64), 3))
        }
        Some(draws) if probability == 0.0 => {
            format!("< {} %", number::trimmed(300.0 / draws as f64, 3))
        }
        Some(_) => format!("{} ± {}", percent(probability), percent(error.max(1e-4))),
        None if probability > 0.9999 && probability < 1.0 => "> 99.99 %".to_owned(),
        None if probability < 0.0001 && probability > 0.0 => "< 0.01 %".to_owned(),
        None => percent(probability),
    }
}

/// Names the criterion of a verdict; a normal error has no bound.
pub(in crate::views) fn by_criterion(criterion: Criterion, spec: &Spec) -> &'static str {
    match criterion {
        Criterion::WorstCase if spec.enabled_sources().all(|source| source.class.is_bounded()) => {
            "in the worst case"
        }
        Criterion::WorstCase => "in the worst case at 3 σ",
        Criterion::RootSumOfSquares => "by rss",
        Criterion::Probability => "by probability",
        Criterion::Yield => "by yield",
    }
}
