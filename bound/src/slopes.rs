//! Bound of the excess of the value within a box over that at its centre.

use crate::affine::{Affine, UNIT};

/// Bound of the relative error of any sum here: at most 4096 roundings, for 32 names in pairs,
/// twice.
const SUMS: f64 = 4096.0 * UNIT;

/// Bound from the slopes. With slopes `c_i + Σ_j a_ij t_j ± r_i` and half widths w:
///
/// ```text
/// f(m + w t) − f(m) = ∫₀¹ Σ w_i t_i f_i(m + s w t) ds  ≤  Σ b_i t_i + ½ Σ B_ij t_i t_j + Σ ρ_i |t_i|
/// b_i = w_i c_i        B_ij = ½ (w_i a_ij + w_j a_ji)        ρ_i = w_i r_i
/// ```
pub(crate) struct SlopeBound<const N: usize> {
    names: usize,
    rest: [f64; N],
    quadratic: Quadratic<N>,
}

/// `more + Σ b_i t_i + ½ Σ B_ij t_i t_j`, where each `t_i` lies in [−1, 1].
#[derive(Clone, Copy)]
struct Quadratic<const N: usize> {
    more: f64,
    first: [f64; N],
    second: [[f64; N]; N],
}

impl<const N: usize> SlopeBound<N> {
    pub(crate) fn new(slopes: &[Affine<N>], halves: &[f64]) -> Self {
        let names = slopes.len().min(N);
        let (mut first, mut rest, mut second) = ([0.0; N], [0.0; N], [[0.0; N]; N]);
        let mut rounding = 0.0;
        for (i, (slope, half)) in slopes.iter().zip(halves).enumerate().take(N) {
            first[i] = half * slope.centre;
            rest[i] = half * slope.rest;
            rounding += first[i].abs() + half * slope.spread;
        }
        for i in 0..names {
            for j in 0..names {
                second[i][j] = 0.5 * (halves[i] * slopes[i].slopes[j] + halves[j] * slopes[j].slopes[i]);
            }
        }
        Self { names, rest, quadratic: Quadratic { more: 4.0 * UNIT * rounding, first, second } }
    }

    /// Returns the upper bound; NaN if any part of it is.
    ///
    /// It is the smallest of the direct bound of the quadratic and of the bounds after eliminating
    /// the variables one by one, the one with the most negative curvature first.
    pub(crate) fn most(&self) -> f64 {
        let mut least = self.quadratic.by_names(&self.rest, self.names);
        let rest: f64 = self.rest.iter().sum();
        let mut left = Quadratic { more: self.quadratic.more + rest, ..self.quadratic };
        for _ in 0..self.names {
            let curve = |i: &usize| left.second[*i][*i];
            let strongest =
                (0..self.names).filter(|i| curve(i) < 0.0).min_by(|i, j| curve(i).total_cmp(&curve(j)));
            let Some(name) = strongest else { break };
            left = left.without(name, self.names);
            let most = left.by_names(&[0.0; N], self.names);
            // NaN is never less.
            if most < least {
                least = most;
            }
        }
        least * (1.0 + SUMS)
    }

    /// Returns the influence of one name on the bound.
    pub(crate) fn share(&self, name: usize) -> f64 {
        let second: f64 = self.quadratic.second[name].iter().take(self.names).map(|entry| entry.abs()).sum();
        self.quadratic.first[name].abs() + self.rest[name] + 0.5 * second
    }
}

impl<const N: usize> Quadratic<N> {
    /// Bounds the quadratic plus `ρ_i |t_i|` for each name. A single name contributes most at `|t|
    /// = 1`, or at `|t| = (|b| + ρ)/−B` if that is smaller, and a pair contributes at most
    /// `|B_ij|`.
    fn by_names(&self, rest: &[f64; N], names: usize) -> f64 {
        let mut sum = self.more;
        for (i, rest) in rest.iter().enumerate().take(names) {
            let (slope, curve) = (self.first[i].abs() + rest, self.second[i][i]);
            let end = slope + 0.5 * curve + 4.0 * UNIT * curve.abs();
            sum += if curve < 0.0 && slope < -curve { 0.5 * slope * (slope / -curve) } else { end };
            for j in 0..i {
                sum += self.second[i][j].abs();
            }
        }
        sum
    }

    /// Eliminates a name whose curvature B is negative: with `s = t_i + Σ v_j t_j` and `v_j = B_ij
    /// / B`
    ///
    /// ```text
    /// b_i t_i + ½ B t_i² + Σ B_ij t_i t_j = b_i s + ½ B s² − b_i Σ v_j t_j − ½ B Σ v_j v_k t_j t_k
    /// ```
    ///
    /// and `b_i s + ½ B s²` is at most `b_i² / −2B`.
    fn without(&self, name: usize, names: usize) -> Self {
        let mut left = *self;
        let (slope, curve) = (self.first[name], self.second[name][name]);
        let shares = self.second[name].map(|entry| entry / curve);
        let mut rounding = 0.0;
        for j in (0..names).filter(|j| *j != name) {
            let change = slope * shares[j];
            left.first[j] -= change;
            rounding += change.abs() + left.first[j].abs();
            for (k, share) in shares.iter().enumerate().take(names).filter(|(k, _)| *k != name) {
                let change = self.second[name][j] * share;
                left.second[j][k] -= change;
                rounding += change.abs() + left.second[j][k].abs();
            }
        }
        left.first[name] = 0.0;
        for k in 0..names {
            (left.second[name][k], left.second[k][name]) = (0.0, 0.0);
        }
        left.more += 0.5 * slope * (slope / -curve) + 4.0 * UNIT * rounding;
        left
    }
}
