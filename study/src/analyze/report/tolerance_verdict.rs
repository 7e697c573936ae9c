//! Tolerances held against a budget.

use abbe::analysis::{Budget, Compliance, ErrorsAt, Measurand, compliance, normal_compliance};
use serde::Serialize;

use super::error_sites::ErrorSites;
use crate::number::Named;

/// The draws of verdicts and budgets are always the same: they are to be as good as integrals.
pub(in crate::analyze) const SEED: u64 = 0;

/// Verdicts on the tolerances of a study.
#[derive(Clone, Debug, Serialize)]
pub struct Verdicts {
    /// The worst of them.
    pub verdict: Verdict,
    /// Probability with which a tolerance must be met.
    pub probability_asked: f64,
    /// On the position error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<ToleranceVerdict>,
    /// On the orientation error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation: Option<ToleranceVerdict>,
}

impl Verdicts {
    /// Returns none if there is no tolerance.
    pub(in crate::analyze) fn new(
        probability_asked: f64,
        [position, orientation]: [Option<ToleranceVerdict>; 2],
    ) -> Option<Self> {
        let verdict =
            position.iter().chain(&orientation).map(|one| one.verdict).max_by_key(|one| *one as u8)?;
        Some(Self { verdict, probability_asked, position, orientation })
    }

    /// Returns the verdicts that there are, that on position first.
    pub fn all(&self) -> impl Iterator<Item = &ToleranceVerdict> {
        self.position.iter().chain(&self.orientation)
    }
}

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
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ToleranceVerdict {
    /// What it is about.
    #[serde(skip)]
    pub measurand: Measurand,
    /// Whether the tolerance is met.
    pub verdict: Verdict,
    /// How large the norm of the error may be.
    pub tolerance: f64,
    /// How likely the tolerance is met: 1 if for certain.
    #[serde(flatten)]
    pub compliance: Compliance,
    /// What no draw exceeds, all bounds added, each in the worst direction; none if a random source is not bounded.
    pub largest: Option<f64>,
    /// Configuration with that probability; with the largest radius, if the tolerance is met for certain.
    pub at: Named,
    /// At how many configurations the probability was evaluated.
    pub configurations: usize,
    /// Index of the configuration.
    #[serde(skip)]
    pub configuration: Option<usize>,
}

impl ToleranceVerdict {
    /// Judges the errors of a budget; `errors_at` are those at a configuration.
    pub(in crate::analyze) fn new<'a, E>(
        budget: &Budget,
        sites: &ErrorSites,
        measurand: Measurand,
        (tolerance, probability): (f64, f64),
        errors_at: impl Fn(Option<usize>) -> Result<ErrorsAt<'a>, E>,
    ) -> Result<Self, E> {
        let (sources, combined, _) = budget.errors(measurand);
        let bounded = sources.iter().all(|errors| errors.class.is_bounded() || errors.plain_max.norm == 0.0);
        let largest = bounded.then_some(combined.bounded_radius.value);
        let radius = combined.radius.configuration;
        let judged = |verdict, compliance, configuration, configurations| Self {
            measurand,
            verdict,
            tolerance,
            compliance,
            largest,
            at: sites.variables(configuration),
            configurations,
            configuration,
        };
        if largest.is_some_and(|largest| largest <= tolerance) {
            let certain = Compliance { probability: 1.0, error: 0.0, draws: None };
            return Ok(judged(Verdict::Met, certain, radius, 0));
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
        let met = compliance.probability >= probability;
        let verdict = if met { Verdict::MetWithProbability } else { Verdict::NotMet };
        Ok(judged(verdict, compliance, configuration, configurations))
    }
}
