//! Covariance of the unknowns from clustered measurements: repeated visits and several targets of a
//! configuration are not independent.
//!
//! With `J` and `r` in units of the uncertainty, `N = JᵀJ`, priors of information `P`, and
//! `B = (N + P)⁻¹`:
//!
//! - One point per configuration, without repeated visits: all numbers are independent,
//!   `σ² = rᵀr/(n − p)`, `p = tr B N`, and `C = B (σ² N + P) B`.
//! - Views of a camera: the same, if the noise of single pixels explains the
//!   residuals; otherwise as poses.
//! - Points visited repeatedly: visits share the error of the model at the configuration,
//!   `V_c = τ² 1 1ᵀ + σ_w² I` along each axis. With `S_c` the sum of the rows of `J` of a
//!   configuration, and means `r̄_c`: `σ_w² = Σ (r − r̄_c)²/(n − m)` for `m` means;
//!   `τ² = (Σ n_c r̄_c² − σ_w² (m − p))/(n − tr(B Σ S_cᵀ S_c))`, from the expected value of that
//!   sum. `M = τ² Σ S_cᵀ S_c + σ_w² N`, and `C = B (M + P) B`.
//! - Several targets, or poses: the sandwich estimator `C = B (Σ g_c g_cᵀ + P) B`,
//!   with `g_c = J_cᵀ (I − H_c)^(−1/2) r_c`, `H_c = J_c B J_cᵀ`: Bell and McCaffrey, *Bias
//!   reduction in standard errors for linear regression with multi-stage samples*, 2002 (CR2). With
//!   few configurations per unknown, CR1 is too small and CR3 too large.
//!
//! Few degrees of freedom `ν` of the residuals determine σ poorly. The stated uncertainties are
//! prior information worth `ν_0` degrees of freedom, and the covariance is the mean of that with
//! σ = 1 and `C`, weighted by `ν_0` and `ν`.
//!
//! All pixels of a view share the error that the model has there: a displacement of the board, and
//! errors of unknown intrinsic parameters. With `Q_c` an orthonormal basis of the columns of `J_c`,
//! which such an error changes, `between = Σ |Q_cᵀ r_c|²` contains it, and `within = Σ |r_c|² −
//! between` is noise alone. With n numbers, m columns of all `Q_c` and p unknowns,
//! `F = (between/(m − p)) / (within/(n − m))` has an F-distribution if the noise of single pixels
//! explains the residuals.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DMatrixView, DVector, DVectorView};

use super::{Configurations, Measurement, Result, Solver, Triangle, by_blocks, f_test};
use abbe_analysis::decompose::symmetric_eigen;

/// Independence assumption of a covariance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Independent {
    /// Independent numbers: one point at each configuration.
    Numbers,
    /// Independent points of a configuration; repeated visits share its errors.
    Points,
    /// Independent configurations; all numbers of a configuration share its errors.
    Configurations,
}

/// Covariance of the unknowns.
pub(super) struct Known {
    pub(super) covariance: DMatrix<f64>,
    /// Standard deviation of a residual, in units of the uncertainty; 1 without degrees of freedom.
    pub(super) sigma: f64,
    /// Degrees of freedom of the residuals.
    pub(super) freedom: f64,
    pub(super) independent: Independent,
    /// Number of configurations.
    pub(super) configurations: usize,
}

/// Degrees of freedom below which there are none: what priors say of unknowns that the data
/// determine.
const NO_FREEDOM: f64 = 0.1;

/// Degrees of freedom of a rigid body: the largest number of independent numbers per configuration.
pub(super) const POSE: usize = 6;

impl Solver<'_> {
    /// Computes the covariance at the solution, without rows of weight zero.
    pub(super) fn known(&self) -> Result<Known> {
        let used = || (0..self.data.len()).filter(|i| self.weights[*i] > 0.0);
        let data = || used().map(|i| &self.data[i]);
        let configurations = Configurations::new(data());
        let numbers = configurations.numbers(data());
        let at_most = |most: usize| numbers.iter().map(|count| (*count as usize).min(most)).sum::<usize>();
        let n = self.model.count(data());
        let p = self.effective();
        let (means, bounded) = (at_most(usize::MAX), at_most(POSE));
        let several = at_most(3) < means;
        let count = configurations.count;
        let stated = self.model.stated_freedom;
        let known = |covariance: DMatrix<f64>, prior: DMatrix<f64>, sigma, freedom: f64, independent| {
            let freedom = if freedom < NO_FREEDOM { 0.0 } else { freedom };
            let freedom = freedom.max(if stated > 0.0 { 0.0 } else { 1.0 });
            let (covariance, sigma) = match freedom {
                0.0 => (prior, 1.0),
                _ if stated == 0.0 => (covariance, sigma),
                _ => ((prior * stated + covariance * freedom) / (stated + freedom), sigma),
            };
            Known { covariance, sigma, freedom, independent, configurations: count }
        };
        let distances = self.model.known_distances.len();
        let used: Vec<usize> = used().collect();
        if !several && n == means + distances || self.has_independent_pixels(&used)? {
            let freedom = n as f64 - p;
            let sigma = (self.cost_of_data() / freedom.max(1.0)).sqrt();
            return Ok(known(
                self.covariance(sigma),
                self.covariance(1.0),
                sigma,
                freedom,
                Independent::Numbers,
            ));
        }
        let groups = configurations.rows().with_indices(&used);
        let groups = groups.slices();
        if several {
            let (covariance, sigma) = self.sandwich(&groups, n - distances)?;
            let freedom = (count as f64 - 1.0).min(bounded as f64 - p);
            let prior = self.covariance((n as f64 / bounded as f64).sqrt());
            return Ok(known(covariance, prior, sigma, freedom, Independent::Configurations));
        }
        let (covariance, sigma, freedom) = self.visits(&groups, [n - distances, means])?;
        // Visits share an error of the model as far as the residuals do.
        let is_tested = freedom > 0.0 && sigma > 1e-9;
        let prior = if is_tested { &covariance / (sigma * sigma) } else { self.covariance(1.0) };
        Ok(known(covariance, prior, sigma, freedom, Independent::Points))
    }

    /// Computes covariance, σ and degrees of freedom for points visited repeatedly.
    fn visits(&self, groups: &[&[usize]], [n, means]: [usize; 2]) -> Result<(DMatrix<f64>, f64, f64)> {
        let p = self.x.len();
        let block = |_: usize, groups: &[&[usize]]| {
            let mut at = self.at();
            let mut sums = Triangle::new(p);
            let (mut between, mut within) = (0.0, 0.0);
            for rows in groups {
                // For each measured number of a configuration: the sum of its rows of J, the sum of
                // its residuals, and their count.
                let mut numbers: BTreeMap<usize, (DVector<f64>, f64, f64)> = BTreeMap::new();
                for i in rows.iter().copied() {
                    let mut places = self.data[i].places().into_iter();
                    let weight = self.weights[i].sqrt();
                    at.linear(&self.data[i], |residual, row| {
                        let place = places.next().unwrap_or_default();
                        let (s, sum, count) =
                            numbers.entry(place).or_insert_with(|| (DVector::zeros(p), 0.0, 0.0));
                        s.iter_mut().zip(row).for_each(|(s, value)| *s += weight * value);
                        (*sum, *count) = (*sum + weight * residual, *count + 1.0);
                        within += (weight * residual).powi(2);
                    })?;
                }
                for (s, sum, count) in numbers.values() {
                    between += sum * sum / count;
                    within -= sum * sum / count;
                    sums.push(s.as_slice(), 0.0, 1.0);
                }
            }
            Ok((sums, between, within))
        };
        let (mut sums, mut between, mut within) = (Triangle::new(p), 0.0, 0.0);
        by_blocks(groups, block, |part| {
            sums.merge(part.0);
            between += part.1;
            within += part.2;
        })?;
        let (n, m, p) = (n as f64, means as f64, self.effective());
        let alone = within.max(0.0) / (n - m);
        let plain = || {
            let sigma = (self.cost_of_data() / (n - p).max(1.0)).sqrt();
            Ok((self.covariance(sigma), sigma, n - p))
        };
        let Some(l) = self.problem.half() else { return plain() };
        // Wᵀ W = Lᵀ Σ S_cᵀ S_c L.
        let w = sums.finish().columns(0, self.x.len()) * &l;
        let shared = (between - alone * (m - p)) / (n - w.norm_squared()).max(1.0);
        if shared <= 0.0 {
            return plain();
        }
        // With Lᵀ N L = 1 − Lᵀ P L.
        let prior = &self.prior * &l;
        let prior = prior.tr_mul(&prior);
        let meat =
            w.tr_mul(&w) * shared + DMatrix::identity(l.ncols(), l.ncols()) * alone + prior * (1.0 - alone);
        Ok((&l * meat * l.transpose(), (shared + alone).sqrt(), m - p))
    }

    /// Computes covariance and σ where the numbers of a configuration have errors of any
    /// correlation.
    fn sandwich(&self, groups: &[&[usize]], n: usize) -> Result<(DMatrix<f64>, f64)> {
        let p = self.x.len();
        let Some(l) = self.problem.half() else {
            return Ok((DMatrix::from_element(p, p, f64::INFINITY), f64::INFINITY));
        };
        let block = |_: usize, groups: &[&[usize]]| {
            let mut at = self.at();
            let (mut rows, mut residuals, mut ends) = (Vec::new(), Vec::new(), Vec::new());
            for group in groups {
                for i in group.iter().copied() {
                    let weight = self.weights[i].sqrt();
                    at.linear(&self.data[i], |residual, row| {
                        rows.extend(row.iter().map(|value| weight * value));
                        residuals.push(weight * residual);
                    })?;
                }
                ends.push(residuals.len());
            }
            // In coordinates of B^(1/2), one column for each number: J̃ᵀ = Lᵀ Jᵀ.
            let all = l.tr_mul(&DMatrix::from_vec(p, residuals.len(), rows));
            let residuals = DVector::from_vec(residuals);
            let mut parts = DMatrix::zeros(p, groups.len());
            let (mut squares, mut spent, mut start) = (0.0, 0.0, 0);
            for (mut part, end) in parts.column_iter_mut().zip(ends) {
                let (j, r) = (all.columns(start, end - start), residuals.rows(start, end - start));
                let raised = raised(&j, &r);
                part.copy_from(&raised.0);
                (squares, spent, start) = (squares + raised.1, spent + raised.2, end);
            }
            Ok((&parts * parts.transpose(), squares, spent))
        };
        let (mut meat, mut squares, mut n) = (DMatrix::zeros(p, p), 0.0, n as f64);
        by_blocks(groups, block, |part| {
            meat += part.0;
            squares += part.1;
            n -= part.2;
        })?;
        self.model.distance_rows(self.x.as_slice(), |_, row| {
            let row = l.tr_mul(&DVector::from_column_slice(row));
            meat.ger(1.0, &row, &row, 1.0);
        });
        let prior = &self.prior * &l;
        meat += prior.tr_mul(&prior);
        Ok((&l * meat * l.transpose(), (squares / n.max(1.0)).sqrt()))
    }

    /// Returns the number of unknowns that the data determine: `tr B N`.
    pub(super) fn effective(&self) -> f64 {
        let by_prior = self.problem.half().map_or(0.0, |l| (&self.prior * l).norm_squared());
        self.x.len() as f64 - by_prior
    }

    /// Returns `B (σ² N + P) B`.
    pub(super) fn covariance(&self, sigma: f64) -> DMatrix<f64> {
        let p = self.x.len();
        let Some(l) = self.problem.half() else { return DMatrix::from_element(p, p, f64::INFINITY) };
        let prior = &self.prior * &l;
        let meat = prior.tr_mul(&prior) * (1.0 - sigma * sigma);
        &l * (meat + DMatrix::identity(l.ncols(), l.ncols()) * (sigma * sigma)) * l.transpose()
    }

    /// Returns whether these rows are views of a camera whose pixels have independent errors.
    fn has_independent_pixels(&self, rows: &[usize]) -> Result<bool> {
        let Some(camera) = &self.model.camera else { return Ok(false) };
        let is_view = |i: &usize| matches!(self.data[*i].measured, Measurement::Readings(_));
        if !rows.iter().all(is_view) {
            return Ok(false);
        }
        let p = self.x.len();
        let block = |_: usize, rows: &[usize]| {
            let mut at = self.at();
            let (mut between, mut all, mut m, mut n) = (0.0, 0.0, 0, 0);
            for i in rows {
                let (mut columns, mut residuals) = (Vec::new(), Vec::new());
                let weight = self.weights[*i].sqrt();
                at.linear(&self.data[*i], |residual, row| {
                    columns.extend(row.iter().map(|value| weight * value));
                    residuals.push(weight * residual);
                })?;
                let r = DVector::from_vec(residuals);
                let j = DMatrix::from_row_slice(r.len(), p, &columns);
                let rank = camera.rank().min(r.len()).min(p);
                let q = j.col_piv_qr().q();
                between += q.columns(0, rank).tr_mul(&r).norm_squared();
                (all, m, n) = (all + r.norm_squared(), m + rank, n + r.len());
            }
            Ok((between, all, m, n))
        };
        let (mut between, mut all, mut m, mut n) = (0.0, 0.0, 0, 0);
        by_blocks(rows, block, |part| {
            (between, all, m, n) = (between + part.0, all + part.1, m + part.2, n + part.3);
        })?;
        Ok(m > p && n > m && f_test(all, all - between, m - p, n - m).p > LEVEL)
    }
}

/// Returns `J̃ᵀ (I − H)^(−1/2) r` and `rᵀ (I − H)⁻¹ r` for `H = J̃ J̃ᵀ`, and the number of
/// directions that the configuration alone determines, along which the residuals vanish.
///
/// With `G = J̃ᵀ J̃`, which is smaller for many numbers,
/// `J̃ᵀ (I − H)^(−1/2) r = (I − G)^(−1/2) J̃ᵀ r` and
/// `rᵀ (I − H)⁻¹ r = rᵀr + (J̃ᵀ r)ᵀ (I − G)⁻¹ (J̃ᵀ r)`.
fn raised(j: &DMatrixView<'_, f64>, r: &DVectorView<'_, f64>) -> (DVector<f64>, f64, f64) {
    if j.ncols() <= j.nrows() {
        let (root, squares, spent) = root(j.tr_mul(j), &r.into_owned());
        return (j * root, squares, spent);
    }
    let (root, squares, spent) = root(j * j.transpose(), &(j * r));
    (root, r.norm_squared() + squares, spent)
}

/// Returns `(I − G)^(−1/2) v`, `vᵀ (I − G)⁻¹ v`, and the number of eigenvalues of G that are 1.
fn root(g: DMatrix<f64>, v: &DVector<f64>) -> (DVector<f64>, f64, f64) {
    if g.trace() < 0.05 {
        // Power series; the truncation error is below 3e-5.
        let once = &g * v;
        let twice = &g * &once;
        let squares = v.norm_squared() + v.dot(&once) + once.norm_squared();
        return (v + once * 0.5 + twice * 0.375, squares, 0.0);
    }
    let Some(eigen) = symmetric_eigen(g) else {
        return (v * f64::NAN, f64::NAN, 0.0);
    };
    let along = eigen.eigenvectors.tr_mul(v);
    let rest = eigen.eigenvalues.map(|value| 1.0 - value);
    let spent = rest.iter().filter(|rest| **rest < 1e-9).count() as f64;
    let raised = along.zip_map(&rest, |along, rest| if rest < 1e-9 { 0.0 } else { along / rest.sqrt() });
    (&eigen.eigenvectors * &raised, raised.norm_squared(), spent)
}

/// Significance level at which views have errors in common beyond the noise of their pixels.
const LEVEL: f64 = 0.01;

#[cfg(test)]
mod tests;
