//! Profiles of joints: errors of joints as functions of their own values, such as the transmission
//! errors of gears and encoders.
//!
//! The error of joint j is `δq_j(q_j) = φ_j(q_j)ᵀ w_j`, with the functions φ of a [`ProfileBasis`].
//! About a fit with the kept unknowns x, Jacobian `J` and residual r (measurement less model, in
//! units of the uncertainty),
//!
//! ```text
//! r = J δx + Σ_j C_j w_j + noise,    row of C_j = ∂(model)/∂q_j · φ_j(q_j)ᵀ
//! minimize  ‖r − J δx − Σ_j C_j w_j‖² + Σ_j w_jᵀ Λ_j w_j + priors of x
//! ```
//!
//! The functions have zero mean over the rows, so that no profile takes the place of the zero of
//! its joint, not even where rows leave it free in a gap. The covariance is that of x and all w
//! together: what the data can show as one or the other makes both uncertain.
//!
//! `basis` has the functions, `normal` the normal equations of each fold of the cross-validation,
//! and `ridge` the choice of the ridges `Λ_j`, which are diagonal.

mod basis;
mod normal;
mod ridge;
#[cfg(test)]
mod tests;

use core::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::{Distances, Failure, Fit, Folds, Model, Observation, REJECTED, Result};
use abbe_analysis::in_order;

use basis::Centered;
pub use basis::{ProfileBasis, ProfileJoint};
use normal::{Normal, Ridges};

/// Profile of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The joint.
    pub joint: ProfileJoint,
    functions: Centered,
    /// Coefficients of the functions, in rad or the length unit.
    pub coefficients: Vec<f64>,
    /// Covariance of the coefficients together with the unknowns of the fit, if the standard
    /// deviation of a residual is its stated uncertainty.
    covariance: DMatrix<f64>,
    /// Number of coefficients that the data determine: `Σ (1 − λ C_kk)`.
    pub effective: f64,
    /// Root mean square of the cross-validation residuals without this profile, in units of the
    /// uncertainty.
    pub without: f64,
}

impl Profile {
    /// Returns the error of the joint at a value of it, in rad or the length unit.
    pub fn value(&self, q: f64) -> f64 {
        self.functions.values(q).zip(&self.coefficients).map(|(f, w)| f * w).sum()
    }

    /// Returns the standard deviation of [`value`](Self::value), if that of a residual is its
    /// stated uncertainty.
    pub fn deviation(&self, q: f64) -> f64 {
        let values = DVector::from_iterator(self.coefficients.len(), self.functions.values(q));
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

/// Fits profiles of joints beside the unknowns of a fit, whose priors they share.
///
/// Keeps those that reduce the squared cross-validation error by half a percent each, or more with
/// few rows; none if there are none, or if a row refers to the one before it, such as a
/// displacement. `model` and `data` are those of the fit. Each trial calls `proceed`, which returns
/// false to stop.
pub fn fit_profiles(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
    joints: &[ProfileJoint],
    folds: &Folds,
    proceed: &mut dyn FnMut() -> bool,
) -> Result<Option<Profiles>> {
    if joints.is_empty() || data.iter().any(|row| row.from().is_some()) {
        return Ok(None);
    }
    let functions: Vec<Centered> = joints.iter().map(|joint| Centered::new(*joint, data)).collect();
    let normal = Normal::new(model, data, fit, &functions, folds)?;
    let Some(chosen) = ridge::choose(&normal, proceed) else { return Ok(None) };
    let ridges = &chosen.ridges;
    let Some(solved) = normal.solved(None, ridges) else { return Ok(None) };
    let root = solved.root();
    let covariance = root.tr_mul(&root);
    let variances = covariance.diagonal();
    let block = |columns: Range<usize>| {
        covariance.view((columns.start, columns.start), (columns.len(), columns.len())).into_owned()
    };
    let rms = |squares: f64| (squares / normal.numbers).sqrt();
    let profile = |(j, functions): (usize, &Centered)| {
        let columns = normal.columns(j);
        let spread = DVector::from_column_slice(&chosen.spread[columns.clone()]);
        ridges[columns.start].is_finite().then(|| Profile {
            joint: functions.joint,
            functions: functions.clone(),
            coefficients: solved.x.as_slice()[columns.clone()].to_vec(),
            covariance: block(columns.clone()) + DMatrix::from_diagonal(&spread),
            effective: normal.effective(j, variances.as_slice(), ridges),
            without: rms(chosen.without[j]),
        })
    };
    let profiles: Vec<Profile> = functions.iter().enumerate().filter_map(profile).collect();
    let information = normal.information();
    let before = information.clone().try_inverse();
    let increase = before.map(|before| block(0..normal.kept.len()) - before);
    Ok(Some(Profiles {
        cross_validated: cross_validated(model, data, fit, &functions, folds, &normal, &chosen.folds)?,
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
    joints: &[Centered],
    folds: &Folds,
    normal: &Normal,
    ridges: &[Ridges],
) -> Result<Distances> {
    let extended = normal::extended(model, fit, joints);
    let solution = |fold: usize| {
        let solved = normal.solved(Some(fold), &ridges[fold]);
        Ok(solved.map_or_else(|| vec![0.0; normal.size()], |solved| solved.x.data.into()))
    };
    let mut solutions = Vec::with_capacity(folds.count);
    in_order::<_, Failure>(folds.count, solution, |solution| solutions.push(solution))?;
    // The error of each joint is a constant of its row.
    let at = |(i, row): (usize, &Observation)| {
        let solution = &solutions[folds.fold[i] as usize];
        let kept = normal.kept.iter().zip(solution).map(|(k, step)| fit.x[*k] + step);
        let errors = joints.iter().enumerate().map(|(j, joint)| {
            let values = joint.values(row.q[joint.joint.variable]);
            values.zip(&solution[normal.columns(j)]).map(|(f, w)| f * w).sum()
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
