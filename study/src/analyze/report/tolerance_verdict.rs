//! Verdicts on the tolerances of a study.

use abbe::analysis::{Budget, Compliance, ErrorsAt, Measurand, compliance, normal_compliance};
use serde::Serialize;

use super::error_sites::ErrorSites;
use crate::number::Named;

/// Fixed seed of the draws for verdicts and uncertainty budgets, which stand in for integrals.
pub(in crate::analyze) const SEED: u64 = 0;

/// Verdicts on the tolerances of a study.
#[derive(Clone, Debug, Serialize)]
pub struct Verdicts {
    /// Worst of the verdicts.
    pub verdict: Verdict,
    /// Required probability of meeting each tolerance.
    pub probability_required: f64,
    /// Verdict on the position error; `None` without a position tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<ToleranceVerdict>,
    /// Verdict on the orientation error; `None` without an orientation tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation: Option<ToleranceVerdict>,
}

impl Verdicts {
    /// Combines the verdicts; returns `None` if there is no tolerance.
    pub(in crate::analyze) fn new(
        probability_required: f64,
        [position, orientation]: [Option<ToleranceVerdict>; 2],
    ) -> Option<Self> {
        let verdict =
            position.iter().chain(&orientation).map(|one| one.verdict).max_by_key(|one| *one as u8)?;
        Some(Self { verdict, probability_required, position, orientation })
    }

    /// Iterates over the verdicts, position first.
    pub fn all(&self) -> impl Iterator<Item = &ToleranceVerdict> {
        self.position.iter().chain(&self.orientation)
    }
}

/// Result of comparing an error with its tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Certainly met: all random sources are bounded, and to first order no draw exceeds the
    /// tolerance at any configuration of the workspace.
    Met,
    /// Met with at least the required probability at each evaluated configuration.
    MetWithProbability,
    /// Met with less than the required probability at some configuration.
    NotMet,
}

/// Largest number of configurations at which the probability is estimated by draws. If all sources
/// are normal it is an integral, which is evaluated at all configurations that the budget lists.
const DRAWN: usize = 4;

/// Verdict on the position or orientation error. Lengths are in the spec's unit, angles in rad.
///
/// The probability is the smallest over the evaluated configurations: the one with the largest
/// radius (norm of the repeatable errors + norm of the random bounds), and those that an
/// approximation ranks least likely to meet the tolerance. To first order; repeatable sources have
/// their nominal values, random sources are distributed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ToleranceVerdict {
    /// Position or orientation.
    #[serde(skip)]
    pub measurand: Measurand,
    /// Verdict on the tolerance.
    pub verdict: Verdict,
    /// Largest permitted norm of the error.
    pub tolerance: f64,
    /// Probability of meeting the tolerance; 1 if certain.
    #[serde(flatten)]
    pub compliance: Compliance,
    /// Largest possible error over the workspace: the norm of the repeatable errors + the norms of
    /// all random bounds. `None` if a random source is unbounded.
    pub largest: Option<f64>,
    /// Configuration with that probability. If the tolerance is certainly met, the configuration
    /// with the largest radius.
    pub at: Named,
    /// Number of configurations at which the probability was evaluated.
    pub configurations: usize,
    /// Index of the configuration in the workspace.
    #[serde(skip)]
    pub configuration: Option<usize>,
}

impl ToleranceVerdict {
    /// Compares the errors of a budget with a tolerance and a required probability. `errors_at`
    /// evaluates the errors at a configuration.
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
        let new_verdict = |verdict, compliance, configuration, configurations| Self {
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
            return Ok(new_verdict(Verdict::Met, certain, radius, 0));
        }
        let listed = budget.least_likely_for(measurand).iter().map(|index| Some(*index));
        let mut candidates = Vec::new();
        for index in [radius].into_iter().chain(listed.filter(|index| *index != radius)) {
            let errors = errors_at(index)?;
            let likely = normal_compliance(&errors, measurand, tolerance).probability;
            candidates.push((likely, index, errors));
        }
        // A stable sort: among equals the configuration with the largest radius stays first.
        candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
        if candidates.iter().any(|(.., errors)| !errors.is_normal(measurand)) {
            candidates.truncate(DRAWN);
        }
        let configurations = candidates.len();
        let evaluate = |errors: &ErrorsAt| compliance(errors, measurand, tolerance, SEED);
        let (mut compliance, mut configuration) = (evaluate(&candidates[0].2), candidates[0].1);
        for (_, index, errors) in &candidates[1..] {
            let here = evaluate(errors);
            if here.probability < compliance.probability {
                (compliance, configuration) = (here, *index);
            }
        }
        let met = compliance.probability >= probability;
        let verdict = if met { Verdict::MetWithProbability } else { Verdict::NotMet };
        Ok(new_verdict(verdict, compliance, configuration, configurations))
    }
}
