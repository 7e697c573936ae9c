//! Variance component between stations: a machine that differs from one series of measurements to
//! another by more than its uncertainty.
//!
//! In series s the unknowns are `β + δ_s`, with `δ_s ~ N(0, τ² D)` for errors of the machine and D
//! the squares of their expected sizes. Linearized at the fit, with one triangle `R_s` and right
//! side `z_s` per station in units of the noise within it:
//!
//! - `z_s = R_s (β + δ_s) + e`, with the covariance `V_s = I + τ² R_s D R_sᵀ`.
//! - With the information P of the priors, `N = Σ R_sᵀ V_s⁻¹ R_s + P` and
//!   `g = Σ R_sᵀ V_s⁻¹ z_s − P x`, τ maximizes the restricted likelihood
//!   `−2 l = Σ ln|V_s| + ln|N| + Σ z_sᵀ V_s⁻¹ z_s − gᵀ N⁻¹ g`: Patterson and Thompson, *Recovery of
//!   inter-block information when block sizes are unequal*, 1971.
//! - With `B = (Σ R_sᵀ R_s + P)⁻¹`, the covariance of the fitted unknowns is
//!   `B (Σ R_sᵀ V_s R_s + P) B`; in another series, `τ² D` is added.

use nalgebra::{DMatrix, DVector};

use super::{Fit, Model, Observation, Result, Triangle};

/// Smallest and largest τ that are tried, and their number on a logarithmic scale.
const SMALLEST: f64 = 1e-6;
const LARGEST: f64 = 10.0;
const TRIED: usize = 141;

/// Variance component between the stations of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct BetweenStations {
    /// τ: standard deviation between stations, as a share of the expected size of each error.
    pub share: f64,
    /// Probability of a likelihood ratio at least as large without a difference between stations.
    pub p: f64,
    /// Number of stations with rows.
    pub stations: usize,
    /// Covariance of the kept unknowns, for the machine in another series.
    pub covariance: DMatrix<f64>,
}

/// Series of one station, in units of the noise.
struct Series {
    r: DMatrix<f64>,
    z: DVector<f64>,
}

/// Estimates the variance component between the stations of a fit to `data`.
///
/// `sizes` are the expected sizes of the unknowns; those of placements are ignored. Returns none
/// with a single station, or if the rows leave no degrees of freedom.
pub fn between_stations(
    model: &Model,
    data: &[Observation],
    fit: &Fit,
    sizes: &[Option<f64>],
) -> Result<Option<BetweenStations>> {
    let (kept, x) = fit.of_kept(model);
    let p = x.len();
    let (mut series, mut squares, mut freedom) = (Vec::new(), 0.0, 0.0);
    for station in 0..model.stations.len() {
        let own = || data.iter().zip(&fit.weights).filter(|(row, _)| row.station as usize == station);
        let own = || own().filter(|(_, weight)| **weight > 0.0);
        if own().next().is_none() {
            continue;
        }
        let (mut triangle, mut at, mut numbers) = (Triangle::new(p), kept.at(&x), 0);
        for (row, weight) in own() {
            at.push(row, *weight, &mut triangle)?;
            numbers += row.count();
        }
        let triangle = triangle.finish();
        let (r, z) = (triangle.view((0, 0), (p, p)).into_owned(), triangle.column(p).rows(0, p).into_owned());
        let columns = r.column_iter().filter(|column| column.norm() > 0.0).count();
        squares += triangle[(p, p)].powi(2);
        freedom += numbers as f64 - columns as f64;
        series.push(Series { r, z });
    }
    if series.len() < 2 || freedom < 1.0 || squares <= 0.0 {
        return Ok(None);
    }
    let noise = (squares / freedom).sqrt();
    let information = fit.prior.tr_mul(&fit.prior);
    let varies = fit.identifiable.kept.iter().map(|k| match model.unknowns[*k].is_placement() {
        true => 0.0,
        false => sizes.get(*k).copied().flatten().map_or(0.0, |size| size * size),
    });
    let varies = DVector::from_iterator(p, varies);
    for one in &mut series {
        one.r /= noise;
        one.z /= noise;
    }
    let x = DVector::from_vec(x);
    let likelihood = |share: f64| minus_twice_likelihood(&series, share, &varies, &information, &x);
    let Some(without) = likelihood(0.0) else { return Ok(None) };
    let step = (LARGEST / SMALLEST).ln() / (TRIED - 1) as f64;
    let tried = (0..TRIED).map(|i| SMALLEST * (step * i as f64).exp());
    let tried = tried.filter_map(|share| Some((share, likelihood(share)?)));
    let best = tried.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, least)| *least < without);
    let (share, ratio) = best.map_or((0.0, 0.0), |(share, least)| (share, without - least));
    // At the limit τ = 0, the ratio is 0 or χ² with one degree of freedom, each with probability ½.
    let p_value = if ratio > 0.0 { 0.5 * libm::erfc((ratio / 2.0).sqrt()) } else { 1.0 };
    let Some(covariance) = covariance(&series, noise, share, &varies, &information) else { return Ok(None) };
    Ok(Some(BetweenStations { share, p: p_value, stations: series.len(), covariance }))
}

/// Returns `V_s`.
fn variance(series: &Series, share: f64, varies: &DVector<f64>) -> DMatrix<f64> {
    let mut scaled = series.r.clone();
    for (mut column, varies) in scaled.column_iter_mut().zip(varies.iter()) {
        column *= share * varies.sqrt();
    }
    &scaled * scaled.transpose() + DMatrix::identity(scaled.nrows(), scaled.nrows())
}

/// Returns `−2 l` of the restricted likelihood; none if it is not finite.
fn minus_twice_likelihood(
    series: &[Series],
    share: f64,
    varies: &DVector<f64>,
    information: &DMatrix<f64>,
    x: &DVector<f64>,
) -> Option<f64> {
    let (mut normal, mut right) = (information.clone(), -(information * x));
    let mut sum = -x.dot(&right);
    for one in series {
        let root = variance(one, share, varies).cholesky()?;
        sum += 2.0 * root.l_dirty().diagonal().iter().map(|value| value.ln()).sum::<f64>();
        let (r, z) = (root.solve(&one.r), root.solve(&one.z));
        normal += one.r.tr_mul(&r);
        right += one.r.tr_mul(&z);
        sum += one.z.dot(&z);
    }
    // Unknowns have different units: the determinant is taken with columns of unit length, which
    // adds a constant.
    let scale = normal.diagonal().map(f64::sqrt);
    let unit =
        DMatrix::from_fn(normal.nrows(), normal.ncols(), |i, j| normal[(i, j)] / (scale[i] * scale[j]));
    let root = unit.cholesky()?;
    let scaled = right.component_div(&scale);
    sum += 2.0
        * root
            .l_dirty()
            .diagonal()
            .iter()
            .zip(&scale)
            .map(|(value, scale)| (value * scale).ln())
            .sum::<f64>();
    sum -= scaled.dot(&root.solve(&scaled));
    sum.is_finite().then_some(sum)
}

/// Returns the covariance of the fitted unknowns for the machine in another series.
fn covariance(
    series: &[Series],
    noise: f64,
    share: f64,
    varies: &DVector<f64>,
    prior: &DMatrix<f64>,
) -> Option<DMatrix<f64>> {
    // In units of the stated uncertainty, by which the fit weighted the rows.
    let (mut normal, mut spread) = (prior.clone(), prior.clone());
    for one in series {
        let r = &one.r * noise;
        normal += r.tr_mul(&r);
        spread += r.tr_mul(&(variance(one, share, varies) * (noise * noise))) * &r;
    }
    let scale = normal.diagonal().map(f64::sqrt);
    let unit =
        DMatrix::from_fn(normal.nrows(), normal.ncols(), |i, j| normal[(i, j)] / (scale[i] * scale[j]));
    let inverse = unit.cholesky()?.inverse();
    let inverse =
        DMatrix::from_fn(inverse.nrows(), inverse.ncols(), |i, j| inverse[(i, j)] / (scale[i] * scale[j]));
    Some(&inverse * spread * &inverse + DMatrix::from_diagonal(&(varies * (share * share))))
}
