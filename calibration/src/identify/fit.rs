//! Nonlinear least squares on the exact model, and its options.

use nalgebra::DMatrix;

use super::clustered::{Independent, Known};
use super::identifiable::Columns;
use super::prior::Basis;
use super::{
    Configurations, Failure, Identifiable, Loss, Model, Observation, Result, Solver, Unknown, identifiable,
};

/// Observations with a smaller weight count as rejected.
pub(super) const REJECTED: f64 = 0.05;

/// Scale of priors that are scaled, up to which an unknown counts as one that the data can show.
const LARGE: f64 = 10.0;

/// Options of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Point at which the information matrix is evaluated; the nominal machine, zero, if empty.
    ///
    /// A target exactly on the last axis hides more unknowns than a real one beside it, so the
    /// solution for base and tool alone is a good choice.
    pub at: Vec<f64>,
    /// Loss function of the residuals.
    pub loss: Loss,
    /// Prior standard deviations about zero, by index of the unknown; flat where there is none, see
    /// [`Model::priors`](super::Model::priors).
    ///
    /// With priors, all unknowns are fitted. If empty, those that the data cannot distinguish from
    /// others are fixed at zero.
    pub priors: Vec<Option<f64>>,
    /// Indices of unknowns whose priors are known up to a common factor, which the data choose.
    pub scaled: Vec<usize>,
    /// Largest number of iterations.
    pub steps: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { at: Vec::new(), loss: Loss::Squares, priors: Vec::new(), scaled: Vec::new(), steps: 100 }
    }
}

/// Result of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Identifiable unknowns.
    pub identifiable: Identifiable,
    /// Values of all unknowns; zero where they are fixed.
    pub x: Vec<f64>,
    /// Covariance of the kept unknowns, in the order of `identifiable.kept`.
    pub covariance: DMatrix<f64>,
    /// Prior standard deviations of all unknowns.
    pub priors: Vec<Option<f64>>,
    /// Rows W of the prior of the kept unknowns x, in the order of `identifiable.kept`: the
    /// components of `W x` are independent with variance 1. A square matrix; no rows without a
    /// prior.
    pub prior: DMatrix<f64>,
    /// Scale that the data chose for the priors of [some unknowns](Options::scaled), which have it;
    /// 1 if there are none.
    pub scale: f64,
    /// Ratio of the residuals to the stated uncertainty of the instrument; 1 without degrees of
    /// freedom.
    pub sigma: f64,
    /// Degrees of freedom of `sigma`.
    pub freedom: f64,
    /// Degrees of freedom of the covariance, for coverage factors of Student's t: those of `sigma`
    /// and of the [stated uncertainties](Model::stated_freedom).
    pub coverage_freedom: f64,
    /// Independence assumed for the covariance.
    pub independent: Independent,
    /// Number of configurations, without rejected ones.
    pub configurations: usize,
    /// Weighted sum of squared residuals, in units of the uncertainty.
    pub cost: f64,
    /// Number of measured numbers.
    pub numbers: usize,
    /// Weight of each observation: 0 if the robust loss rejected it, 1 otherwise; multiplies its
    /// own weight.
    pub weights: Vec<f64>,
    /// Number of iterations.
    pub steps: usize,
}

impl Fit {
    /// Returns the standard deviation of each unknown; none where it is fixed at zero.
    pub fn standard_deviations(&self) -> Vec<Option<f64>> {
        let mut all = vec![None; self.x.len()];
        for (i, k) in self.identifiable.kept.iter().enumerate() {
            all[*k] = Some(self.covariance[(i, i)].max(0.0).sqrt());
        }
        all
    }

    /// Returns the indices of kept unknowns whose prior carries more information than the data.
    pub fn weakly_determined(&self) -> Vec<usize> {
        let count = self.identifiable.kept.len();
        let root = self.prior.solve_lower_triangular(&DMatrix::identity(self.prior.nrows(), count));
        let hardly = |i: &usize| {
            root.as_ref().is_some_and(|root| 4.0 * self.covariance[(*i, *i)] > root.row(*i).norm_squared())
        };
        (0..count).filter(hardly).map(|i| self.identifiable.kept[i]).collect()
    }

    /// Returns the model with the kept unknowns alone, and their values.
    pub fn of_kept<'m>(&self, model: &Model<'m>) -> (Model<'m>, Vec<f64>) {
        let kept = || self.identifiable.kept.iter();
        (model.with(kept().map(|k| model.unknowns[*k]).collect()), kept().map(|k| self.x[*k]).collect())
    }

    /// Returns the pairs of kept unknowns with an absolute correlation above `least`, strongest
    /// first.
    pub fn correlations(&self, least: f64) -> Vec<(usize, usize, f64)> {
        let mut pairs = Vec::new();
        for i in 0..self.identifiable.kept.len() {
            for j in 0..i {
                let c = self.covariance[(i, j)] / (self.covariance[(i, i)] * self.covariance[(j, j)]).sqrt();
                if c.abs() > least {
                    pairs.push((self.identifiable.kept[j], self.identifiable.kept[i], c));
                }
            }
        }
        pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
        pairs
    }

    /// Returns the observations that the robust loss rejected; `data` are those of the fit.
    pub fn rejected<'o>(&self, data: &'o [Observation]) -> impl Iterator<Item = &'o Observation> {
        self.weighed(data).filter(|(weight, _)| *weight < REJECTED).map(|(_, observation)| observation)
    }

    /// Returns the observations that were not rejected.
    pub fn kept<'o>(&self, data: &'o [Observation]) -> impl Iterator<Item = &'o Observation> {
        self.weighed(data).filter(|(weight, _)| *weight >= REJECTED).map(|(_, observation)| observation)
    }

    /// Returns whether the observation with index `i` was not rejected.
    pub fn is_kept(&self, i: usize) -> bool {
        self.weights[i] >= REJECTED
    }

    /// Returns each observation with its weight from the robust loss.
    pub(super) fn weighed<'o>(
        &self,
        data: &'o [Observation],
    ) -> impl Iterator<Item = (f64, &'o Observation)> {
        self.weights.iter().copied().zip(data)
    }
}

/// Returns rows that have the joints of different rows of the data.
fn mixed(data: &[Observation]) -> Vec<Observation> {
    let pairs = (0..4).flat_map(|by| (0..data.len()).map(move |i| (by, i)));
    let joint = |j: usize, row: usize| data[row % data.len()].q[j];
    let row = |(by, i): (usize, usize)| {
        let q = (0..data[i].q.len()).map(|j| joint(j, i + by * j));
        Observation { q: q.collect(), ..data[i].clone() }
    };
    pairs.map(row).collect()
}

/// Fits the unknowns of a model to measurements.
///
/// With priors it is the maximum a posteriori estimate of all unknowns; errors that act as others
/// in every configuration are part of these. Without, unknowns that are not identifiable are fixed
/// at zero; see [`identifiable()`]. Known sources do not take part in that decision: an error that
/// varies over the workspace makes equivalent unknowns differ by a second-order amount that real
/// data do not resolve.
pub fn fit(model: &Model, data: &[Observation], options: &Options) -> Result<Fit> {
    let mut at = options.at.clone();
    at.resize(model.unknowns.len(), 0.0);
    let plain = model.without_known_sources();
    let more = |rows: &[Observation]| identifiable(&plain, rows, &at).map_or(0, |found| found.rank);
    let mut expected = options.priors.clone();
    options.scaled.iter().for_each(|k| expected[*k] = expected[*k].map(|sigma| LARGE * sigma));
    let seen = Columns::of_rows(&plain, data, &at)?.with_expected(&expected);
    let found = seen.knowable(&plain);
    let rank = found.rank + found.weak.len();
    let basis = match options.priors.is_empty() {
        true => None,
        false => Some(Basis::new(&plain, data, &at, &seen, &options.priors)?),
    };
    let (identifiable, prior) = match &basis {
        None => (found, DMatrix::zeros(0, rank)),
        Some(basis) => {
            let (kept, redundant) = (basis.kept.clone(), basis.redundant.clone());
            (Identifiable { kept, redundant, ..found }, basis.rows(&[], 1.0))
        }
    };
    let numbers = model.count(data.iter());
    // Repeated visits add no information about the machine; weakly determined unknowns count as
    // fitted parameters.
    let (independent, configurations) = Configurations::independent(data);
    // As many numbers as unknowns are enough if other rows of these joints have no more unknowns.
    let is_of_machine = |unknown: &Unknown| matches!(unknown, Unknown::Error(..));
    let is_exact = model.stated_freedom > 0.0
        && rank > 0
        && (configurations > 1 || !model.unknowns.iter().any(is_of_machine));
    if independent < rank || independent == rank && !(is_exact && more(&mixed(data)) <= rank) {
        return Err(Failure::TooFew { numbers: independent, configurations, rank });
    }
    let kept = model.with(identifiable.kept.iter().map(|k| model.unknowns[*k]).collect());
    // To first order, the same start with the unidentifiable unknowns at zero.
    let mut start = at.clone();
    for (k, act_as) in &identifiable.redundant {
        act_as.iter().for_each(|(j, factor)| start[*j] += factor * at[*k]);
    }
    let start = identifiable.kept.iter().map(|k| start[*k]).collect();
    let mut solver = Solver::new(&kept, data, start, prior);
    let mut known = solver.solve(options)?;
    let mut scale = 1.0;
    if let Some(basis) = basis.filter(|_| !options.scaled.is_empty()) {
        scale = solver.scale_of_prior(&basis, &options.scaled);
        solver.set_prior(basis.rows(&options.scaled, scale));
        known = solver.solve(options)?;
    }
    let cost = solver.cost_of_data();
    let known = known.map_or_else(|| solver.known(), Ok)?;
    let Known { covariance, sigma, freedom, independent, configurations } = known;
    let mut x = vec![0.0; model.unknowns.len()];
    identifiable.kept.iter().zip(solver.x.iter()).for_each(|(k, value)| x[*k] = *value);
    let mut priors = options.priors.clone();
    options.scaled.iter().for_each(|k| priors[*k] = priors[*k].map(|sigma| sigma * scale));
    let (weights, steps, prior) = (solver.weights, solver.steps, solver.prior);
    Ok(Fit {
        identifiable,
        x,
        covariance,
        priors,
        prior,
        scale,
        sigma,
        freedom,
        coverage_freedom: freedom + model.stated_freedom,
        independent,
        configurations,
        cost,
        numbers,
        weights,
        steps,
    })
}
