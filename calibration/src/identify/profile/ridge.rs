//! Choice of the ridges, by adaptive shrinkage.
//!
//! Gears and encoders err by a few numbers of cycles per turn, or by many. The coefficients w of
//! one number of cycles of joint j therefore have a mixture of normal distributions as prior
//! (Stephens, *False discovery rates: a new deal*, 2017): a geometric series of variances `v_c σ²`
//! that begins with 0, and shares `π_jc` that the data choose,
//!
//! ```text
//! w ~ Σ_c π_jc N(0, v_c σ² I)
//! ```
//!
//! Let `w̄` be the solution for d coefficients with covariance `σ² C` and ridge λ. With the other
//! functions at their ridges, the data alone say `w ~ N(h/ℓ, σ²/ℓ)`, where `ℓ + λ = d/tr C` and
//! `h = (ℓ + λ) w̄`. With the mixture,
//!
//! ```text
//! s_c = v_c/(1 + ℓ v_c),        φ_c ∝ π_jc (1 + ℓ v_c)^(−d/2) exp(½ s_c ‖h‖²/σ²)
//! s = Σ φ_c s_c,                w̄ = s h,        var w = σ² s + (Σ φ_c s_c² − s²) ‖h‖²/d
//! ```
//!
//! The ridge with this mean is `λ = 1/s − ℓ`. It grows by steps: of numbers of cycles that the data
//! hardly distinguish, each seems superfluous beside the others. The second part of the variance,
//! the spread, is that of the choice among the mixture. The shares are the means of φ over the
//! numbers of cycles (expectation maximization), with some more for `v_c = 0`. The noise is
//! `σ² = ‖residual‖²/(n − p − Σ (1 − λ C_kk))` (MacKay, *Bayesian interpolation*, 1992).
//!
//! Cross-validation, for which each fold has the ridges of the other folds, then decides between a
//! profile and none, one joint at a time.

use core::ops::ControlFlow;

use super::normal::{Normal, Ridges};
use abbe_analysis::in_order_until;

/// Smallest relative decrease of the squared cross-validation error of n numbers by a profile; with
/// few, it is that of the Bayesian information criterion for a harmonic, `2 ln n/n`.
const GAIN: f64 = 0.005;

/// Largest number of iterations of the ridges.
const ITERATIONS: usize = 10;

/// Relative change of the number of determined coefficients at which the iterations end.
const CONVERGED: f64 = 0.01;

/// Largest growth of a ridge in an iteration.
const GROWTH: f64 = 4.0;

/// Iterations of the shares for each of the ridges.
const SHARES: usize = 100;

/// Numbers of cycles without an effect that are added to those of each joint.
const NULL: f64 = 3.0;

/// First and largest ridge, as multiples of the mean information about a function.
const RIDGES: [f64; 2] = [10.0, 1e4];

/// Variances of the mixture, as multiples of that of a coefficient that the data alone determine.
const VARIANCES: [f64; 9] = [0.0, 0.0625, 0.25, 1.0, 4.0, 16.0, 64.0, 256.0, 1024.0];

/// A value for each part of the mixture.
type Mixture = [f64; VARIANCES.len()];

/// Chosen ridges and their cross-validation.
pub(super) struct Chosen {
    pub(super) ridges: Ridges,
    /// Variance of the choice among the mixture, as a multiple of that of a residual.
    pub(super) spread: Vec<f64>,
    /// Ridges without the rows of each fold.
    pub(super) folds: Vec<Ridges>,
    /// Squared cross-validation error without profiles.
    pub(super) before: f64,
    /// Squared cross-validation error.
    pub(super) after: f64,
    /// Squared cross-validation error without the profile of each joint.
    pub(super) without: Vec<f64>,
}

/// Chooses the ridges; none if no profile reduces the cross-validation error, or if `proceed`
/// stops.
pub(super) fn choose(normal: &Normal, proceed: &mut dyn FnMut() -> bool) -> Option<Chosen> {
    let count = normal.folds.len();
    let mut folds = Vec::with_capacity(count + 1);
    let mut spread = Vec::new();
    let each = |fold: usize| shrunk(normal, Some(fold).filter(|fold| *fold < count)).ok_or(());
    let take = |(ridges, of_all)| {
        folds.push(ridges);
        spread = of_all;
        if proceed() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    in_order_until::<_, ()>(count + 1, each, take).ok()?;
    if !proceed() {
        return None;
    }
    let mut ridges = folds.pop()?;
    let none = vec![normal.without(0..normal.joints(), &ridges); count];
    let before = normal.cross_validated(&none)?;
    let mut after = normal.cross_validated(&folds)?;
    let gain = GAIN.max(2.0 * normal.numbers.ln() / normal.numbers);
    if after > before * (1.0 - gain) {
        return None;
    }
    let mut without = Vec::new();
    for j in 0..normal.joints() {
        if !proceed() {
            return None;
        }
        let trial: Vec<Ridges> = folds.iter().map(|ridges| normal.without(j..j + 1, ridges)).collect();
        let squares = normal.cross_validated(&trial)?;
        without.push(squares);
        if after > squares * (1.0 - gain) {
            (folds, after, ridges) = (trial, squares, normal.without(j..j + 1, &ridges));
        }
    }
    let is_any = ridges[normal.kept.len()..].iter().any(|ridge| ridge.is_finite());
    is_any.then_some(Chosen { ridges, spread, folds, before, after, without })
}

/// Returns the ridges and the spread without the rows of a fold; none if the equations are
/// singular.
fn shrunk(normal: &Normal, left_out: Option<usize>) -> Option<(Ridges, Vec<f64>)> {
    let mut ridges = vec![0.0; normal.size()];
    let mut spread = ridges.clone();
    // A joint that moves no measured point has no profile.
    let joints = || (0..normal.joints()).filter(|j| normal.mean_information[*j] > 0.0);
    ridges[normal.kept.len()..].fill(f64::INFINITY);
    joints().for_each(|j| ridges[normal.columns(j)].fill(RIDGES[0] * normal.mean_information[j]));
    let mut last = f64::INFINITY;
    for _ in 0..ITERATIONS {
        let solution = normal.solved(left_out, &ridges)?;
        let variances = solution.root().column_iter().map(|column| column.norm_squared()).collect::<Vec<_>>();
        let effective: f64 = joints().map(|j| normal.effective(j, &variances, &ridges)).sum();
        let used = normal.kept.len() as f64 + effective;
        if (used - last).abs() < CONVERGED * used {
            break;
        }
        last = used;
        let noise = solution.squares / (solution.rows - used).max(1.0);
        for j in joints() {
            let information = normal.mean_information[j];
            let cycles: Vec<_> = normal.cycles(j).collect();
            let told = cycles.iter().map(|columns| {
                let total = columns.len() as f64 / columns.clone().map(|k| variances[k]).sum::<f64>();
                let square: f64 = columns.clone().map(|k| solution.x[k].powi(2)).sum();
                [(total - ridges[columns.start]).max(0.0), square * total * total / noise]
            });
            let mixed = mixed(&told.collect::<Vec<_>>(), cycles[0].len() as f64, information);
            for (columns, [ridge, variance]) in cycles.into_iter().zip(mixed) {
                let ridge = ridge.min(GROWTH * ridges[columns.start]);
                ridges[columns.clone()].fill(ridge.clamp(1e-9 * information, RIDGES[1] * information));
                spread[columns].fill(variance);
            }
        }
    }
    Some((ridges, spread))
}

/// Returns the ridge and the spread of each number of cycles with `ℓ`, `‖h‖²/σ²` and d functions.
fn mixed(told: &[[f64; 2]], d: f64, information: f64) -> Vec<[f64; 2]> {
    let s = |l: f64| VARIANCES.map(|v| v / (information + l * v));
    let likelihood = |[l, square]: &[f64; 2]| -> Mixture {
        let s = s(*l);
        // 1/(1 + ℓ v) = 1 − ℓ s
        s.map(|one| (1.0 - l * one).powf(0.5 * d) * (0.5 * square * (one - s[s.len() - 1])).exp())
    };
    let weights = |shares: &Mixture, likelihood: &Mixture| -> Mixture {
        let products: Mixture = core::array::from_fn(|c| shares[c] * likelihood[c]);
        let sum: f64 = products.iter().sum();
        products.map(|product| product / sum)
    };
    let likelihoods: Vec<Mixture> = told.iter().map(likelihood).collect();
    // As numbers of cycles.
    let mut shares = [1.0; VARIANCES.len()];
    for _ in 0..SHARES {
        let mut sums = [0.0; VARIANCES.len()];
        sums[0] = NULL;
        for likelihood in &likelihoods {
            sums.iter_mut().zip(weights(&shares, likelihood)).for_each(|(sum, one)| *sum += one);
        }
        shares = sums;
    }
    let each = likelihoods.iter().zip(told).map(|(likelihood, [l, square])| {
        let (weights, s) = (weights(&shares, likelihood), s(*l));
        let moment = |power: i32| -> f64 { weights.iter().zip(s).map(|(w, s)| w * s.powi(power)).sum() };
        [1.0 / moment(1) - l, (moment(2) - moment(1).powi(2)).max(0.0) * square / d]
    });
    each.collect()
}
