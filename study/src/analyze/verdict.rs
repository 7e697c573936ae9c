//! The tolerance verdict, in sentences.

use abbe::analysis::{Compliance, Measurand};

use super::report::{Report, ToleranceVerdict, Verdict, Verdicts};
use super::unit;
use crate::number;

impl Report {
    /// Returns the verdict in one line, such as `Verdict: not met`; `None` if the study has no
    /// tolerance.
    pub fn verdict_line(&self) -> Option<String> {
        let verdicts = self.verdicts.as_ref()?;
        let least = verdicts
            .all()
            .map(|verdict| verdict.compliance)
            .min_by(|a, b| a.probability.total_cmp(&b.probability));
        Some(match verdicts.verdict {
            Verdict::Met => "Verdict: met".to_owned(),
            Verdict::MetWithProbability => format!("Verdict: met with probability {}", probability(least?)),
            Verdict::NotMet => "Verdict: not met".to_owned(),
        })
    }

    /// Returns one sentence on each tolerance.
    pub fn verdict_sentences(&self) -> Vec<String> {
        self.verdicts.iter().flat_map(Verdicts::all).map(|verdict| self.tolerance_sentence(verdict)).collect()
    }

    fn tolerance_sentence(&self, verdict: &ToleranceVerdict) -> String {
        let show = |value| unit::with_symbol(self, verdict.measurand, value);
        let name = match verdict.measurand {
            Measurand::Position => "Position",
            Measurand::Orientation => "Orientation",
        };
        let tolerance = show(verdict.tolerance);
        let all = self.configurations_of(verdict.measurand);
        let left_out = match all < self.configurations {
            true => format!(" {}", self.singular_sentence()),
            false => String::new(),
        };
        if let (Verdict::Met, Some(largest)) = (verdict.verdict, verdict.largest) {
            return format!(
                "{name}: met. All random sources are bounded, and with the repeatable ones the \
                 error is at most {} of {tolerance} at each of the {} configurations, to first \
                 order.{left_out}",
                show(largest),
                all,
            );
        }
        let at = self.configuration(verdict.configuration);
        let at = at.map(|worst| number::unbroken(&self.label(worst))).unwrap_or_default();
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
        let how = match verdict.compliance.draws {
            Some(draws) => format!("random sources drawn {} times", number::short(draws as f64)),
            None if self.is_random(verdict.measurand) => "all random sources normal".to_owned(),
            None => "nothing is random".to_owned(),
        };
        let required = number::at_least(self.study.probability);
        let enough = format!("{required} is required");
        let met = if verdict.verdict == Verdict::NotMet { "not met" } else { "met" };
        format!(
            "{name}: {met}. The error is within {tolerance} with probability {}; {enough}. This \
             is {least}, at {at}. To first order, repeatable sources at their values, {how}.{left_out}",
            probability(verdict.compliance)
        )
    }

    fn is_random(&self, measurand: Measurand) -> bool {
        self.budget.errors(measurand).1.random_radius.value > 0.0
    }
}

impl ToleranceVerdict {
    /// Returns the probability that the tolerance is met with its standard error, such as
    /// `= 97.35 % ± 0.02 %`, or a bound, such as `< 0.002 %`.
    pub fn probability(&self) -> String {
        let text = probability(self.compliance);
        if text.starts_with(['<', '>']) { text } else { format!("= {text}") }
    }
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
