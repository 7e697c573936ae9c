//! Profiles of joints: errors of joints as functions of their own values, such as the transmission
//! errors of gears and encoders.
//!
//! The error of joint j is `δq_j(q_j) = φ_j(q_j)ᵀ w_j`, with the functions φ of a [`ProfileBasis`].
//! About a fit with the kept unknowns x, Jacobian `J` and residual r (measurement less model, in
//! units of the uncertainty),
//!
//! ```text
//! r = J δx + Σ_j C_j w_j + noise,    row of C_j = ∂(model)/∂q_j · φ_j(q_j)ᵀ
//! minimize  ‖r − J δx − Σ_j C_j w_j‖² + Σ_j λ_j ‖w_j‖² + priors of x
//! ```
//!
//! The unknowns x have no ridge. A profile that acts as x does would take its place at the size of
//! the ridge, and x would be as uncertain as profiles are large. With `A = JᵀJ`, `M = C_jᵀC_j` and
//! `S = M − C_jᵀJ A⁻¹ JᵀC_j`, directions d with `dᵀS d < 0.001 dᵀM d` are therefore excluded: the
//! profile is orthogonal to them, `dᵀM w_j = 0`.
//!
//! `basis` has the functions, `normal` the normal equations of each fold of the cross-validation,
//! and `ridge` the choice of `λ_j`.

mod basis;
mod normal;
mod ridge;
#[cfg(test)]
mod tests;

use nalgebra::DMatrix;

use super::fit::REJECTED;
use super::{Configurations, Distances, Failure, Fit, Folds, Model, Observation};
use abbe_analysis::in_order;

pub use basis::{ProfileBasis, ProfileJoint};
use normal::Normal;

/// Profile of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The joint.
    pub joint: ProfileJoint,
    /// Coefficients of the functions, in rad or the length unit.
    pub coefficients: Vec<f64>,
    /// Covariance of the coefficients together with the unknowns of the fit, if the standard
    /// deviation of a residual is its stated uncertainty.
    covariance: DMatrix<f64>,
    /// Expected size of a coefficient: σ/√λ.
    pub expected: f64,
    /// Number of coefficients that the data determine: `Σ (1 − λ C_kk/σ²)`.
    pub effective: f64,
    /// Root mean square of the cross-validation residuals without this profile, in units of the
    /// uncertainty.
    pub without: f64,
}

impl Profile {
    /// Returns the error of the joint at a value of it, in rad or the length unit.
    pub fn value(&self, q: f64) -> f64 {
        self.joint.values(q).iter().zip(&self.coefficients).map(|(f, w)| f * w).sum()
    }

    /// Returns the standard deviation of [`value`](Self::value), if that of a residual is its
    /// stated uncertainty.
    pub fn deviation(&self, q: f64) -> f64 {
        let values = nalgebra::DVector::from_vec(self.joint.values(q));
        values.dot(&(&self.covariance * &values)).max(0.0).sqrt()
    }
}

/// Profiles of joints that reduce the cross-validation error.
#[derive(Clone, Debug)]
pub struct Profiles {
    /// The profiles.
    pub profiles: Vec<Profile>,
    /// Root mean square of the cross-validation residuals without profiles, in units of the
    /// uncertainty.
    pub before: f64,
    /// Root mean square of the cross-validation residuals.
    pub after: f64,
    /// Position errors of the cross-validation.
    pub cross_validated: Distances,
    /// Information about the kept unknowns of the fit, without profiles.
    information: DMatrix<f64>,
    /// Increase of the covariance of the kept unknowns by the profiles, if the standard deviation
    /// of a residual is its stated uncertainty.
    increase: DMatrix<f64>,
    /// Unknowns of the fit, by their indices.
    kept: Vec<usize>,
}

/// Independent numbers per function of the profiles, below which no profile is tried.
const NUMBERS: usize = 3;

/// Configurations per function of one profile, below which no profile is tried.
const CONFIGURATIONS: usize = 4;

/// Size of a set of measurements: that of some rows, or the least for profiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProfileData {
    /// Number of independent numbers.
    pub numbers: usize,
    /// Number of configurations.
    pub configurations: usize,
}

impl ProfileData {
    /// Returns the size of some rows.
    pub fn of_rows(data: &[Observation]) -> Self {
        let (numbers, configurations) = Configurations::independent(data);
        Self { numbers, configurations }
    }

    /// Returns the least size for profiles of these joints: three independent numbers for each
    /// function, and four configurations for each function of one joint.
    pub fn needed(joints: &[ProfileJoint]) -> Self {
        let each = || joints.iter().map(|joint| joint.basis.count());
        Self {
            numbers: NUMBERS * each().sum::<usize>(),
            configurations: CONFIGURATIONS * each().max().unwrap_or_default(),
        }
    }

    /// Returns whether this size is at least another one.
    pub fn suffices(self, needed: Self) -> bool {
        self.numbers >= needed.numbers && self.configurations >= needed.configurations
    }
}

/// Fits profiles of joints beside the unknowns of a fit, whose priors they share.
///
/// Keeps those that reduce the squared cross-validation error by half a percent each; none if there
/// are none, if the data are not [enough](ProfileData), or if a row refers to the one before it,
/// such as a displacement. `model` and `data` are those of the fit. Each trial calls `proceed`,
/// which returns false to stop.
pub fn fit_profiles(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
    joints: &[ProfileJoint],
    folds: &Folds,
    proceed: &mut dyn FnMut() -> bool,
) -> Result<Option<Profiles>, Failure> {
    let is_enough = ProfileData::of_rows(data).suffices(ProfileData::needed(joints));
    if joints.is_empty() || !is_enough || data.iter().any(|row| row.from().is_some()) {
        return Ok(None);
    }
    let normal = Normal::new(model, data, fit, joints, folds)?;
    let Some(chosen) = ridge::choose(&normal, proceed) else { return Ok(None) };
    let Some(solved) = normal.solved(&chosen.ridges) else { return Ok(None) };
    let rms = |squares: f64| (squares / normal.numbers as f64).sqrt();
    let noise = chosen.noise;
    let profile = |(j, joint): (usize, &ProfileJoint)| {
        let ridge = chosen.ridges[j]?;
        Some(Profile {
            joint: *joint,
            coefficients: solved.x[normal.columns(j)].to_vec(),
            covariance: solved.covariance(normal.columns(j)),
            expected: (noise / ridge).sqrt(),
            effective: solved.effective[j],
            without: rms(chosen.without[j]),
        })
    };
    let profiles: Vec<Profile> = joints.iter().enumerate().filter_map(profile).collect();
    let information = normal.information();
    let before = information.clone().try_inverse();
    let increase = before.map(|before| solved.covariance(0..normal.kept.len()) - before);
    Ok(Some(Profiles {
        cross_validated: cross_validated(model, data, fit, joints, folds, &normal, &chosen.ridges)?,
        profiles,
        before: rms(chosen.before),
        after: rms(chosen.after),
        increase: increase.unwrap_or_else(|| information.clone() * 0.0),
        information,
        kept: normal.kept.clone(),
    }))
}

/// Returns the position errors of each fold under the profiles and unknowns fitted to the others,
/// on the exact model.
fn cross_validated(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
    joints: &[ProfileJoint],
    folds: &Folds,
    normal: &Normal,
    ridges: &[Option<f64>],
) -> Result<Distances, Failure> {
    let extended = normal::extended(model, fit, joints);
    let nothing = vec![0.0; normal.size()];
    let solution = |fold| Ok(normal.without(fold, ridges).unwrap_or_else(|| nothing.clone()));
    let mut solutions = Vec::with_capacity(folds.count);
    in_order::<_, Failure>(folds.count, solution, |solution| solutions.push(solution))?;
    // The error of each joint is a constant of its row.
    let at = |(i, row): (usize, &Observation)| {
        let solution = &solutions[folds.fold[i] as usize];
        let kept = normal.kept.iter().zip(solution).map(|(k, step)| fit.x[*k] + step);
        let errors = joints.iter().enumerate().map(|(j, joint)| {
            let values = joint.values(row.q[joint.variable]);
            values.iter().zip(&solution[normal.columns(j)]).map(|(f, w)| f * w).sum()
        });
        kept.chain(errors).collect::<Vec<f64>>()
    };
    let rows: Vec<Vec<f64>> = data.iter().enumerate().map(at).collect();
    extended.distances_where(data, |i| (fit.weights[i] >= REJECTED).then(|| &rows[i][..]))
}

impl Profiles {
    /// Returns the number of coefficients that the data determine.
    pub fn effective(&self) -> f64 {
        self.profiles.iter().map(|profile| profile.effective).sum()
    }

    /// Adds the uncertainty of the profiles to a fit with these profiles as known errors: its
    /// covariance, the standard deviation of a residual, and the degrees of freedom. Returns the
    /// standard deviation of a residual for [`Profile::deviation`], in units of the uncertainty.
    ///
    /// The covariance `C` of the fit can exceed `σ² A⁻¹` because residuals of a configuration are
    /// correlated. The mean ratio `tr(C A)/p` holds for the profiles, too.
    pub fn add_uncertainty(&self, fit: &mut Fit) -> f64 {
        let numbers = fit.numbers as f64 - fit.identifiable.kept.len() as f64;
        let left = (1.0 - self.effective() / numbers.max(1.0)).max(0.1);
        let spent = fit.freedom - (fit.freedom * left).max(1.0);
        (fit.freedom, fit.coverage_freedom) = (fit.freedom - spent, fit.coverage_freedom - spent);
        fit.sigma /= left.sqrt();
        fit.covariance /= left;
        let places: Vec<Option<usize>> =
            self.kept.iter().map(|k| fit.identifiable.kept.iter().position(|other| other == k)).collect();
        let pairs = || (0..places.len()).filter_map(|i| Some((i, places[i]?)));
        let mut ratio = 0.0;
        for (i, a) in pairs() {
            for (j, b) in pairs() {
                ratio += fit.covariance[(a, b)] * self.information[(i, j)];
            }
        }
        let variance = ratio / pairs().count().max(1) as f64;
        for (i, a) in pairs() {
            for (j, b) in pairs() {
                fit.covariance[(a, b)] += variance * self.increase[(i, j)];
            }
        }
        variance.max(0.0).sqrt()
    }
}
