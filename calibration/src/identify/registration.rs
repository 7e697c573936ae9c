//! Registration: the rigid motion that maps one set of points onto another best.

use nalgebra::{Matrix3, Vector3};

use abbe_analysis::decompose::{svd3, symmetric_eigen};
use abbe_core::Pose;

/// A rigid motion and the quality of its fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Registration {
    /// The motion: `to ≈ pose · from`.
    pub pose: Pose,
    /// Root mean square of the remaining distances, per point.
    pub rms: f64,
    /// Extent of the points perpendicular to their principal line, as a share of their total
    /// extent; 0 for collinear points.
    pub breadth: f64,
}

/// Fits a rigid motion to pairs of points by least squares.
///
/// With `H = Σ (from − mean)(to − mean)ᵀ = U Σ Vᵀ`, the rotation is `R = V diag(1, 1, det) Uᵀ`.
///
/// Returns none for fewer than three pairs, and for coordinates whose squares overflow. For
/// collinear points ([`Registration::breadth`] 0), the rotation about their line is arbitrary.
pub fn register(from: &[[f64; 3]], to: &[[f64; 3]]) -> Option<Registration> {
    register_pairs(from.iter().copied().zip(to.iter().copied()))
}

/// Fits a rigid motion to an iterator of pairs `(from, to)`, which is traversed three times.
pub fn register_pairs(pairs: impl Iterator<Item = ([f64; 3], [f64; 3])> + Clone) -> Option<Registration> {
    let (mut n, mut a, mut b) = (0, Vector3::zeros(), Vector3::zeros());
    for (p, q) in pairs.clone() {
        (n, a, b) = (n + 1, a + Vector3::from(p), b + Vector3::from(q));
    }
    if n < 3 {
        return None;
    }
    let (a, b) = (a / f64::from(n), b / f64::from(n));
    let (mut h, mut spread) = (Matrix3::zeros(), Matrix3::zeros());
    for (p, q) in pairs.clone() {
        let p = Vector3::from(p) - a;
        h += p * (Vector3::from(q) - b).transpose();
        spread += p * p.transpose();
    }
    let spread = symmetric_eigen(spread)?.eigenvalues;
    let mut sizes: Vec<f64> = spread.iter().map(|v| v.max(0.0).sqrt()).collect();
    sizes.sort_by(|a, b| b.total_cmp(a));
    let breadth = if sizes[0] > 0.0 { sizes[1] / sizes[0] } else { 0.0 };
    let svd = svd3(h)?;
    let (u, v) = (svd.u?, svd.v_t?.transpose());
    // nalgebra's `svd` sorts the singular values, so the last one is the smallest.
    let sign = (v * u.transpose()).determinant().signum();
    let r = v * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * u.transpose();
    let t = b - r * a;
    let pose = Pose([r.column(0).into(), r.column(1).into(), r.column(2).into(), t.into()]);
    let square = |(p, q): ([f64; 3], [f64; 3])| {
        let p = pose.apply(p);
        (0..3).map(|i| (p[i] - q[i]).powi(2)).sum::<f64>()
    };
    let rms = (pairs.map(square).sum::<f64>() / f64::from(n)).sqrt();
    Some(Registration { pose, rms, breadth })
}

#[cfg(test)]
mod tests;
