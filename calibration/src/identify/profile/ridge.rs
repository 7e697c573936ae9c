//! Choice of the ridge of each joint.
//!
//! The marginal likelihood gives the start (MacKay, *Bayesian interpolation*, 1992): with
//! `γ_j = n_j − λ_j tr C_jj`, the number of coefficients that the data determine,
//!
//! ```text
//! σ² = ‖residual‖² / (n − p − Σ γ_j),    λ_j = γ_j σ² / ‖w_j‖²
//! ```
//!
//! Cross-validation then decides, one joint at a time: no profile, the ridge of the start, or a
//! fifth or five times of it.

use super::normal::Normal;

/// Smallest relative decrease of the squared cross-validation error by a profile.
const GAIN: f64 = 0.005;

/// Iterations of the marginal likelihood.
const ITERATIONS: usize = 8;

/// Information of the first ridge, as a share of the mean information about a function.
const START: f64 = 0.02;

/// Factors of a ridge that cross-validation tries.
const FACTORS: [f64; 2] = [0.2, 5.0];

/// Chosen ridges and their cross-validation.
pub(super) struct Chosen {
    /// Ridge of each joint; none without a profile.
    pub(super) ridges: Vec<Option<f64>>,
    /// Variance of a residual, in units of the uncertainty.
    pub(super) noise: f64,
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
    let (mut ridges, noise) = most_likely(normal, proceed)?;
    let before = normal.cross_validated(&vec![None; normal.joints()])?;
    let mut after = normal.cross_validated(&ridges)?;
    if after > before * (1.0 - GAIN) {
        return None;
    }
    for j in 0..ridges.len() {
        if !proceed() {
            return None;
        }
        let start = ridges[j];
        let trials = FACTORS.map(|factor| start.map(|ridge| factor * ridge));
        for ridge in trials {
            let trial = ridges.iter().enumerate().map(|(k, old)| if k == j { ridge } else { *old });
            let trial: Vec<Option<f64>> = trial.collect();
            let squares = normal.cross_validated(&trial)?;
            if squares < after {
                (ridges, after) = (trial, squares);
            }
        }
    }
    let mut without = vec![before; ridges.len()];
    for j in 0..ridges.len() {
        if !proceed() {
            return None;
        }
        let mut trial = ridges.clone();
        trial[j] = None;
        without[j] = normal.cross_validated(&trial)?;
        if after > without[j] * (1.0 - GAIN) {
            (ridges, after) = (trial, without[j]);
        }
    }
    let any = ridges.iter().any(Option::is_some);
    any.then_some(Chosen { ridges, noise, before, after, without })
}

/// Returns the ridges of the largest marginal likelihood, and the variance of a residual.
fn most_likely(normal: &Normal, proceed: &mut dyn FnMut() -> bool) -> Option<(Vec<Option<f64>>, f64)> {
    let mut ridges: Vec<Option<f64>> = (0..normal.joints())
        .map(|j| Some(START * normal.mean_information(j)).filter(|ridge| *ridge > 0.0))
        .collect();
    let mut noise = 1.0;
    for _ in 0..ITERATIONS {
        if !proceed() {
            return None;
        }
        let solution = normal.solved(&ridges)?;
        let used = normal.kept.len() as f64 + solution.effective.iter().sum::<f64>();
        noise = normal.squares_at(&solution.x).max(0.0) / (normal.numbers as f64 - used).max(1.0);
        for (j, ridge) in ridges.iter_mut().enumerate() {
            let Some(ridge) = ridge else { continue };
            let size: f64 = solution.x[normal.columns(j)].iter().map(|w| w * w).sum();
            let new = solution.effective[j] * noise / size.max(f64::MIN_POSITIVE);
            // Without a profile the ridge grows beyond all bounds.
            let information = normal.mean_information(j);
            *ridge = if new.is_finite() {
                new.clamp(1e-9 * information, 1e3 * information)
            } else {
                1e3 * information
            };
        }
    }
    Some((ridges, noise))
}
