//! Verdicts on the tolerances of a study.

use abbe::analysis::{Budget, Compliance, ErrorDistribution, Extreme, Measurand};
use abbe::analysis::{PROBABILITY_ERROR, Yield, comparable};
use serde::Serialize;

use super::source_report::ErrorSites;
use crate::number::Named;
use crate::study_file::{Criterion, JudgedMachine, Study};

/// Fixed seed of the draws for verdicts and uncertainty budgets, which stand in for integrals.
pub(in crate::analyze) const SEED: u64 = 0;

/// Verdicts on the tolerances of a study.
#[derive(Clone, Debug, Serialize)]
pub struct Verdicts {
    /// Worst of the verdicts on the machine that counts.
    pub verdict: Verdict,
    /// Machine whose verdict counts: `as-built` or `compensated`.
    pub machine: JudgedMachine,
    /// Criterion of the verdict: `worst-case`, `rss`, `probability` or `yield`.
    pub criterion: Criterion,
    /// Required probability of meeting each tolerance, if that is the criterion or part of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probability_required: Option<f64>,
    /// Required share of machines, if that is the criterion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yield_required: Option<f64>,
    /// Number of unreachable configurations, if they are more than the study permits: the tolerance
    /// is then not met.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unreachable: Option<usize>,
    /// Verdicts on the machine as built.
    #[serde(flatten)]
    pub as_built: MachineVerdicts,
    /// Verdicts on the compensated machine; `None` if nothing says what compensation leaves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compensated: Option<CompensatedVerdicts>,
}

/// Verdicts on one machine, as built or compensated.
#[derive(Clone, Debug, Serialize)]
pub struct MachineVerdicts {
    /// Verdict on the position error; `None` without a position tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<ToleranceVerdict>,
    /// Verdict on the orientation error; `None` without an orientation tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation: Option<ToleranceVerdict>,
    /// Share of machines that keep all tolerances at all configurations, if that is the criterion.
    #[serde(rename = "yield_estimate", skip_serializing_if = "Option::is_none")]
    pub yielded: Option<Yield>,
}

/// Verdicts on the compensated machine.
#[derive(Clone, Debug, Serialize)]
pub struct CompensatedVerdicts {
    /// Origin of what is known of the errors after compensation.
    pub basis: CompensationBasis,
    /// Number of configurations at which the compensated errors were evaluated.
    pub checked: usize,
    /// The verdicts.
    #[serde(flatten)]
    pub verdicts: MachineVerdicts,
}

/// Origin of what is known of the errors after compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CompensationBasis {
    /// Residuals of the study's `[compensation]`, and the covariance of the spec if it has one.
    Stated,
    /// Covariance of the identified errors in the spec: all repeatable errors are corrected.
    Identified,
    /// Published residual, `[compensated]` of the study.
    Published,
}

impl MachineVerdicts {
    /// Iterates over the verdicts, position first.
    pub fn all(&self) -> impl Iterator<Item = &ToleranceVerdict> {
        self.position.iter().chain(&self.orientation)
    }
}

impl Verdicts {
    /// Combines the verdicts; returns `None` if there is no tolerance.
    pub(in crate::analyze) fn new(
        study: &Study,
        [reached, unreachable]: [usize; 2],
        as_built: MachineVerdicts,
        compensated: Option<CompensatedVerdicts>,
    ) -> Option<Self> {
        let machine = if compensated.is_some() { study.judged } else { JudgedMachine::AsBuilt };
        let permitted = study.unreachable * (reached + unreachable) as f64;
        let criterion = study.criterion;
        let is_random = matches!(criterion, Criterion::Probability | Criterion::Yield);
        let mut verdicts = Self {
            verdict: Verdict::NotMet,
            machine,
            criterion,
            probability_required: is_random.then_some(study.probability),
            yield_required: (criterion == Criterion::Yield).then_some(study.required_yield),
            unreachable: Some(unreachable).filter(|count| *count as f64 > permitted),
            as_built,
            compensated,
        };
        let worst = verdicts.all().map(|one| one.verdict).max_by_key(|one| *one as u8)?;
        if verdicts.unreachable.is_none() {
            verdicts.verdict = worst;
        }
        Some(verdicts)
    }

    /// Returns the verdicts on the machine that counts.
    pub fn counting(&self) -> &MachineVerdicts {
        match (&self.compensated, self.machine) {
            (Some(compensated), JudgedMachine::Compensated) => &compensated.verdicts,
            _ => &self.as_built,
        }
    }

    /// Iterates over the verdicts on the machine that counts, position first.
    pub fn all(&self) -> impl Iterator<Item = &ToleranceVerdict> {
        self.counting().all()
    }
}

/// Result of comparing an error with its tolerance, by the criterion of the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Met at each evaluated configuration.
    Met,
    /// Not met at some configuration, or too many configurations are unreachable.
    NotMet,
}

/// Relative room for rounding when an error is compared with a tolerance.
const ROUNDING: f64 = 1e-9;

/// Largest number of configurations at which the probability is estimated by draws. If all sources
/// are normal it is an integral, which is evaluated at all configurations that the budget lists.
const DRAWN: usize = 4;

/// Verdict on the position or orientation error. Lengths are in the spec's unit, angles in rad.
///
/// One criterion decides: the largest error over all signs, the radius, the probability, or the
/// lower end of the confidence interval of the yield. The
/// probability is the smallest over the evaluated configurations: the one with the largest radius
/// (norm of the repeatable errors + norm of the random bounds), those that an approximation
/// ranks least likely to meet the tolerance, and the one where it has the largest error at 95 %. To
/// first order; random sources are distributed. Repeatable sources have their nominal values. On
/// the compensated machine they are replaced by residuals with their full norm, of unknown sign or
/// direction; the uncertainty of the calibration and of the inputs is a random error.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ToleranceVerdict {
    /// Position or orientation.
    #[serde(skip)]
    pub measurand: Measurand,
    /// Verdict on the tolerance.
    pub verdict: Verdict,
    /// Largest permitted norm of the error.
    pub tolerance: f64,
    /// Norm of the repeatable errors, or of what compensation leaves of them, + norm of the random
    /// bounds; the largest over the configurations.
    pub radius: f64,
    /// Probability of meeting the tolerance; 1 if certain.
    #[serde(flatten)]
    pub compliance: Compliance,
    /// Norm that contains the error with a probability of 95 %, the largest over the evaluated
    /// configurations.
    pub u95: f64,
    /// Largest error over all signs and the configurations: repeatable errors at their values, all
    /// others at their bounds, normal ones at 3σ.
    pub worst_case: f64,
    /// Indicates that no draw exceeds the worst case: no source is normal.
    pub is_bounded: bool,
    /// Configuration with the largest worst case or radius, or the smallest probability, whichever
    /// is the criterion.
    pub at: Named,
    /// Number of configurations at which the probability was evaluated.
    pub configurations: usize,
    /// Index of the configuration in the workspace.
    #[serde(skip)]
    pub configuration: Option<usize>,
}

/// Errors of a machine over the workspace that a tolerance is compared with.
pub(in crate::analyze) struct JudgedErrors {
    pub(in crate::analyze) measurand: Measurand,
    /// Largest radius.
    pub(in crate::analyze) radius: Extreme,
    /// Largest error over all signs.
    pub(in crate::analyze) worst_case: Extreme,
    /// Indicates that no draw exceeds it.
    pub(in crate::analyze) is_bounded: bool,
    /// Distributions at some configurations: first the one with the largest radius, then the most
    /// likely to be worst.
    pub(in crate::analyze) candidates: Vec<(Option<usize>, ErrorDistribution)>,
}

/// Configuration at which the distribution may be evaluated.
struct Candidate {
    /// Probability that the tolerance is met, of a normal error with the same mean and covariance,
    /// in multiples of its accuracy.
    within: f64,
    /// Approximate number of standard deviations by which the tolerance exceeds the median.
    deviations: f64,
    /// Approximate norm that contains the error with a probability of 95 %.
    u95: f64,
    index: Option<usize>,
    error: ErrorDistribution,
}

impl JudgedErrors {
    /// Returns the errors of the machine as built. `distribution` gives the error at a
    /// configuration.
    pub(in crate::analyze) fn as_built<E>(
        budget: &Budget,
        measurand: Measurand,
        tolerance: f64,
        distribution: impl Fn(Option<usize>) -> Result<ErrorDistribution, E>,
    ) -> Result<Self, E> {
        let (sources, combined) = budget.errors(measurand);
        let is_bounded =
            sources.iter().all(|errors| errors.class.is_bounded() || errors.plain_max.norm == 0.0);
        let radius = combined.radius;
        let listed = budget.least_likely[measurand as usize].iter().map(|index| Some(*index));
        let mut candidates = Vec::new();
        for index in
            [radius.configuration].into_iter().chain(listed.filter(|index| *index != radius.configuration))
        {
            let error = distribution(index)?;
            let [u95, deviations] = error.approximate(tolerance).map(comparable);
            // Where the integrals agree to their accuracy, the approximation decides.
            let within = (error.normal_within(tolerance) / PROBABILITY_ERROR).round();
            candidates.push(Candidate { within, deviations, u95, index, error });
        }
        // A stable sort: among equals the configuration with the largest radius stays first.
        candidates.sort_by(|a, b| a.within.total_cmp(&b.within).then(a.deviations.total_cmp(&b.deviations)));
        // The largest U95 need not be where the tolerance is least likely to be met.
        let farthest =
            (0..candidates.len()).rev().max_by(|i, j| candidates[*i].u95.total_cmp(&candidates[*j].u95));
        if let Some(farthest) = farthest.filter(|farthest| *farthest >= DRAWN) {
            let candidate = candidates.remove(farthest);
            candidates.insert(DRAWN - 1, candidate);
        }
        Ok(Self {
            measurand,
            radius,
            worst_case: combined.worst_case_radius,
            is_bounded,
            candidates: candidates.into_iter().map(|one| (one.index, one.error)).collect(),
        })
    }
}

impl ToleranceVerdict {
    /// Compares errors with a tolerance, by the criterion of a study.
    pub(in crate::analyze) fn new(
        errors: JudgedErrors,
        sites: &ErrorSites,
        tolerance: f64,
        (study, yielded): (&Study, Option<&Yield>),
    ) -> Self {
        let JudgedErrors { measurand, radius, worst_case, is_bounded, mut candidates } = errors;
        let limit = tolerance * (1.0 + ROUNDING);
        let is_always_met = worst_case.value <= limit;
        let certain = is_bounded && is_always_met;
        if candidates.iter().any(|(_, error)| !error.is_normal()) {
            candidates.truncate(DRAWN);
        }
        let configurations = if certain { 0 } else { candidates.len() };
        let mut compliance = Compliance { probability: 1.0, error: 0.0, draws: None };
        let (mut least_likely, mut u95) = (radius.configuration, 0.0_f64);
        for (n, (index, error)) in candidates.iter().enumerate() {
            let (here, quantile) = error.coverage(tolerance, SEED);
            u95 = u95.max(quantile);
            if !certain && (n == 0 || here.probability < compliance.probability) {
                (compliance, least_likely) = (here, *index);
            }
        }
        let (is_met, configuration) = match study.criterion {
            Criterion::WorstCase => (is_always_met, worst_case.configuration),
            Criterion::RootSumOfSquares => (radius.value <= limit, radius.configuration),
            Criterion::Probability => (compliance.probability >= study.probability, least_likely),
            Criterion::Yield => {
                (yielded.is_some_and(|share| share.interval[0] >= study.required_yield), least_likely)
            }
        };
        Self {
            measurand,
            verdict: if is_met { Verdict::Met } else { Verdict::NotMet },
            tolerance,
            radius: radius.value,
            compliance,
            u95,
            worst_case: worst_case.value,
            is_bounded,
            at: sites.variables(configuration),
            configurations,
            configuration,
        }
    }

    /// Returns the error that the criterion compares with the tolerance; the worst case if it is a
    /// probability.
    pub fn judged_error(&self, criterion: Criterion) -> f64 {
        match criterion {
            Criterion::RootSumOfSquares => self.radius,
            _ => self.worst_case,
        }
    }
}
