//! Tolerances held against a budget.

use abbe::analysis::{Budget, Compliance, ErrorsAt, Measurand, compliance, normal_compliance};
use serde::Serialize;

use super::prepared::SEED;

/// Whether a tolerance is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// For certain: all random sources are bounded, and no draw of any of them exceeds it at any
    /// configuration of the workspace, to first order.
    Met,
    /// With the probability that the study asks for, or more, at every configuration where that was evaluated.
    MetWithProbability,
    /// With less than that at one of them.
    NotMet,
}

/// At how many configurations a probability is drawn at most. One is an integral if all sources are normal, and then it
/// is evaluated at all that the budget has listed.
const DRAWN: usize = 4;

/// The verdict on position or orientation. Lengths in the spec's unit, angles in rad.
///
/// The probability is the least of those at the configurations that were looked at: the one with the largest radius (the
/// norm of the repeatable errors and that of the random bounds, added), and those where an approximation has the tolerance
/// least likely met, [`Budget::least_likely`]. Repeatable sources are as they are, random ones drawn, to first order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// What it is about.
    pub measurand: Measurand,
    /// How large the norm of the error may be.
    pub tolerance: f64,
    /// Whether it is.
    pub verdict: Verdict,
    /// What no draw exceeds, if all random sources are bounded: all bounds added, each in the worst direction.
    pub largest: Option<f64>,
    /// How likely the tolerance is met: 1 if for certain.
    pub compliance: Compliance,
    /// Index of the configuration where that is; with the largest radius, if it is met for certain.
    pub configuration: Option<usize>,
    /// At how many configurations the probability was evaluated.
    pub configurations: usize,
}

impl Judged {
    /// Judges the errors of a budget; `errors_at` are those at a configuration.
    pub(super) fn new<'a, E>(
        budget: &Budget,
        measurand: Measurand,
        (tolerance, asked): (f64, f64),
        errors_at: impl Fn(Option<usize>) -> Result<ErrorsAt<'a>, E>,
    ) -> Result<Self, E> {
        let (sources, combined, _) = budget.errors(measurand);
        let bounded = sources.iter().all(|errors| errors.class.is_bounded() || errors.plain_max.norm == 0.0);
        let largest = bounded.then_some(combined.bounded_radius.value);
        let radius = combined.radius.configuration;
        if largest.is_some_and(|largest| largest <= tolerance) {
            let (verdict, configurations) = (Verdict::Met, 0);
            let compliance = Compliance { probability: 1.0, error: 0.0, draws: None };
            return Ok(Self {
                measurand,
                tolerance,
                verdict,
                largest,
                compliance,
                configuration: radius,
                configurations,
            });
        }
        let listed = budget.least_likely_of(measurand).iter().map(|index| Some(*index));
        let mut places = Vec::new();
        for index in [radius].into_iter().chain(listed.filter(|index| *index != radius)) {
            let errors = errors_at(index)?;
            let likely = normal_compliance(&errors, measurand, tolerance).probability;
            places.push((likely, index, errors));
        }
        // Where several are alike the largest radius comes first.
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        if places.iter().any(|(.., errors)| !errors.is_normal(measurand)) {
            places.truncate(DRAWN);
        }
        let configurations = places.len();
        let evaluate = |errors: &ErrorsAt| compliance(errors, measurand, tolerance, SEED);
        let (mut compliance, mut configuration) = (evaluate(&places[0].2), places[0].1);
        for (_, index, errors) in &places[1..] {
            let here = evaluate(errors);
            if here.probability < compliance.probability {
                (compliance, configuration) = (here, *index);
            }
        }
        let met = compliance.probability >= asked;
        let verdict = if met { Verdict::MetWithProbability } else { Verdict::NotMet };
        Ok(Self { measurand, tolerance, verdict, largest, compliance, configuration, configurations })
    }
}
