//! Whether the tolerance is met, in sentences.

use abbe::analysis::{Compliance, Measurand};

use super::report::{Report, ToleranceVerdict, Verdict, Verdicts};
use super::unit;
use crate::number;

impl Report {
    /// `Verdict: not met`.
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

    /// A sentence on each tolerance.
    pub fn verdict_sentences(&self) -> Vec<String> {
        self.verdicts.iter().flat_map(Verdicts::all).map(|judged| self.judgement(judged)).collect()
    }

    fn judgement(&self, judged: &ToleranceVerdict) -> String {
        let show = |value| unit::shown(self, judged.measurand, value);
        let name = match judged.measurand {
            Measurand::Position => "Position",
            Measurand::Orientation => "Orientation",
        };
        let tolerance = show(judged.tolerance);
        if let (Verdict::Met, Some(largest)) = (judged.verdict, judged.largest) {
            return format!(
                "{name}: met for certain. All random sources are bounded, and together with the repeatable ones they make at most \
                 {} of {tolerance} at each of the {} configurations, to first order.",
                show(largest),
                self.configurations,
            );
        }
        let at = self.configuration(judged.configuration);
        let at = at.map(|worst| number::unbroken(&self.label(worst))).unwrap_or_default();
        let all = self.configurations;
        let least = match judged.configurations {
            1 if all == 1 => "the only configuration".to_owned(),
            some if some < all => {
                format!(
                    "the least of {all} configurations ({some} were drawn at, those where an approximation has it lowest)"
                )
            }
            _ => format!("the least of all {all} configurations"),
        };
        let how = match judged.compliance.draws {
            Some(draws) => format!("random ones drawn {} times", number::short(draws as f64)),
            None if self.is_random(judged.measurand) => "random ones all normal".to_owned(),
            None => "nothing is random".to_owned(),
        };
        let asked = number::at_least(self.study.probability);
        let enough = match judged.verdict {
            Verdict::NotMet => format!("{asked} are asked for"),
            _ => format!("{asked} are enough"),
        };
        let met = if judged.verdict == Verdict::NotMet { "not met" } else { "met" };
        format!(
            "{name}: {met}. The error is within {tolerance} with probability {}; {enough}. This is {least}, at {at}. To first \
             order, repeatable sources as they are, {how}.",
            probability(judged.compliance)
        )
    }

    fn is_random(&self, measurand: Measurand) -> bool {
        self.budget.errors(measurand).1.random_radius.value > 0.0
    }
}

/// `97.35 % ± 0.02 %` with the standard error of draws; what all draws say is a bound.
fn probability(Compliance { probability, error, draws }: Compliance) -> String {
    let percent = |p: f64| format!("{} %", number::trimmed(100.0 * p, 2));
    match draws {
        // No draw out of N was otherwise: 95 % sure that less than 3/N are.
        Some(draws) if probability == 1.0 => {
            format!("more than {} %", number::trimmed(100.0 * (1.0 - 3.0 / draws as f64), 3))
        }
        Some(draws) if probability == 0.0 => {
            format!("less than {} %", number::trimmed(300.0 / draws as f64, 3))
        }
        Some(_) => format!("{} ± {}", percent(probability), percent(error.max(1e-4))),
        None if probability > 0.9999 && probability < 1.0 => "more than 99.99 %".to_owned(),
        None if probability < 0.0001 && probability > 0.0 => "less than 0.01 %".to_owned(),
        None => percent(probability),
    }
}
