//! Tests against closed forms, a series with its own error bound, and draws.

use core::f64::consts::{PI, SQRT_2};

use rand::RngExt;
use rand_distr::StandardNormal;

use super::{NormalVector, PROBABILITY_ERROR, StudentVector};
use crate::thorough::{sample_size, thorough};
use abbe_kinematics::sampling::stream;

fn vector(mean: [f64; 3], [x, y, z]: [f64; 3]) -> NormalVector {
    NormalVector::new(mean, [[x * x, 0.0, 0.0], [0.0, y * y, 0.0], [0.0, 0.0, z * z]])
}

/// Returns Φ(b) − Φ(a).
fn between(a: f64, b: f64) -> f64 {
    (libm::erf(b / SQRT_2) - libm::erf(a / SQRT_2)) / 2.0
}

#[test]
fn spheres_in_one_two_and_three_dimensions() {
    for sigma in [1e-9, 0.3, 1.0, 7e5] {
        for z in [1e-3, 0.1, 0.7, 1.0, 1.96, 2.5, 4.0, 6.0, 30.0] {
            let r = z * sigma;
            let density = (-z * z / 2.0_f64).exp();
            for (deviations, exact) in [
                ([sigma, 0.0, 0.0], between(-z, z)),
                ([0.0, sigma, sigma], 1.0 - density),
                ([sigma; 3], between(-z, z) - (2.0 / PI).sqrt() * z * density),
            ] {
                let p = vector([0.0; 3], deviations).within(r);
                assert!((p - exact).abs() < 1e-10, "{deviations:?} {z}: {p} instead of {exact}");
            }
        }
    }
}

/// Checks the noncentral χ with three degrees of freedom in closed form:
/// `Φ(r − m) − Φ(−r − m) − (φ(r − m) − φ(r + m)) / m`.
#[test]
fn a_sphere_beside_the_centre() {
    let phi = |z: f64| (-z * z / 2.0).exp() / (2.0 * PI).sqrt();
    for m in [1e-2, 0.5, 1.0, 3.0, 10.0, 100.0, 1e4] {
        for r in [0.2, 0.9, 1.0, 2.5, 5.0, m - 3.0, m - 0.1, m, m + 0.5, m + 2.0, m + 5.0] {
            if r <= 0.0 {
                continue;
            }
            let exact = between(-r - m, r - m) - (phi(r - m) - phi(r + m)) / m;
            for direction in [[1.0, 0.0, 0.0], [0.6, 0.0, -0.8], [0.48, 0.6, 0.64]] {
                let p = vector(direction.map(|d: f64| d * m), [1.0; 3]).within(r);
                assert!((p - exact).abs() < PROBABILITY_ERROR, "m {m}, r {r}: {p} instead of {exact}");
            }
        }
    }
}

/// Returns Ruben's series (Kotz, Johnson and Boyd 1967) of `P(Σ (m_i + σ_i Z_i)² ≤ x)` in χ² with
/// `n + 2k` degrees of freedom, and a bound of its truncation error. β is the smallest variance, so
/// that all terms are positive and the truncated ones sum to at most one minus the sum of the
/// weights. The method is independent of integration.
fn ruben(mean: [f64; 3], deviations: [f64; 3], radius: f64) -> (f64, f64) {
    let n = deviations.iter().filter(|d| **d > 0.0).count();
    let variances = deviations.iter().filter(|d| **d > 0.0).map(|d| d * d).collect::<Vec<_>>();
    let shifts = mean.iter().zip(deviations).filter(|(_, d)| *d > 0.0).map(|(m, d)| (m / d).powi(2));
    let shifts = shifts.collect::<Vec<_>>();
    let beta = variances.iter().copied().fold(f64::INFINITY, f64::min);
    let x = radius * radius / beta;
    let mut c = vec![
        variances.iter().map(|v| (beta / v).sqrt()).product::<f64>()
            * (-shifts.iter().sum::<f64>() / 2.0).exp(),
    ];
    let mut g = vec![0.0];
    // F and f of χ² with ν = n + 2k: F_{ν+2} = F_ν − 2 f_{ν+2}, f_{ν+2} = f_ν x/ν.
    let (mut f, mut cumulative) = match n {
        1 => ((-x / 2.0).exp() / (2.0 * PI * x).sqrt(), libm::erf((x / 2.0).sqrt())),
        2 => ((-x / 2.0).exp() / 2.0, -(-x / 2.0).exp_m1()),
        _ => {
            let density = (x / (2.0 * PI)).sqrt() * (-x / 2.0).exp();
            (density, libm::erf((x / 2.0).sqrt()) - 2.0 * density)
        }
    };
    let (mut sum, mut weights) = (c[0] * cumulative, c[0]);
    for k in 1..4000 {
        let power = |v: f64, k: usize| (1.0 - beta / v).powi(k as i32);
        let kf = k as f64;
        let terms = variances.iter().zip(&shifts);
        g.push(terms.map(|(v, s)| (power(*v, k) + kf * s * beta / v * power(*v, k - 1)) / 2.0).sum());
        c.push((0..k).map(|r| g[k - r] * c[r]).sum::<f64>() / kf);
        f *= x / (n as f64 + 2.0 * (kf - 1.0));
        cumulative -= 2.0 * f;
        sum += c[k] * cumulative;
        weights += c[k];
        if 1.0 - weights < 1e-14 {
            break;
        }
    }
    (sum, (1.0 - weights).max(0.0))
}

#[test]
fn the_series_of_ruben() {
    let mut random = stream(8, 0);
    for case in 0..300 {
        let flat = case % 3;
        let mut deviations = [0; 3].map(|_| 0.3 + 1.2 * random.random::<f64>());
        deviations[..flat].fill(0.0);
        let mean = match case % 2 {
            0 => [0.0; 3],
            _ => deviations.map(|d| if d > 0.0 { 2.0 * random.random::<f64>() - 1.0 } else { 0.0 }),
        };
        let r = 0.2 + 3.5 * random.random::<f64>();
        let (sum, bound) = ruben(mean, deviations, r);
        let p = vector(mean, deviations).within(r);
        assert!(bound < 1e-10, "{deviations:?}: {bound}");
        assert!((p - sum).abs() < PROBABILITY_ERROR + bound, "{mean:?} {deviations:?} {r}: {p}, {sum}");
    }
}

#[test]
fn quantiles_come_back_as_probabilities() {
    let mut random = stream(9, 0);
    for case in 0..if thorough() { 40 } else { 10 } {
        // Any shape, including needles and plates.
        let deviations = [0; 3].map(|_| 10_f64.powf(-6.0 * random.random::<f64>()));
        let mean = [0; 3].map(|_| if case % 2 == 0 { 0.0 } else { 2.0 * random.random::<f64>() - 1.0 });
        let vector = vector(mean, deviations);
        for p in [0.05, 0.95, 0.9973] {
            let q = vector.quantile(p);
            assert!(
                (vector.within(q) - p).abs() < 2.0 * PROBABILITY_ERROR,
                "{mean:?} {deviations:?} {p}: {q}"
            );
        }
        // Between that of a line and that of a ball with the same trace.
        if case % 2 == 0 {
            let trace = deviations.iter().map(|d| d * d).sum::<f64>().sqrt();
            let k = vector.quantile(0.95) / trace;
            assert!((2.795_483_482 / 3_f64.sqrt() - 1e-6..=1.959_963_985 + 1e-6).contains(&k), "{k}");
        }
    }
}

#[test]
fn nothing_varies() {
    let still = vector([3.0, 0.0, 4.0], [0.0; 3]);
    assert_eq!((still.within(4.999), still.within(5.001), still.quantile(0.95)), (0.0, 1.0, 5.0));
    // Off the line of variation: the norm is at least the distance.
    let line = vector([0.0, 0.0, 2.0], [1.0, 0.0, 0.0]);
    assert_eq!(line.within(1.9), 0.0);
    assert!((line.within(5_f64.sqrt()) - between(-1.0, 1.0)).abs() < 1e-12);
    assert_eq!(vector([0.0; 3], [1.0; 3]).within(-1.0), 0.0);
}

/// Compares with millions of draws of each rank, within four standard errors.
#[test]
fn draws_of_each_rank() {
    let count = sample_size(10_000_000);
    let covariances = [
        [[0.04, 0.02, -0.06], [0.02, 0.01, -0.03], [-0.06, -0.03, 0.09]],
        [[0.5, 0.1, 0.0], [0.1, 0.2, 0.0], [0.0, 0.0, 0.0]],
        [[0.9, 0.3, 0.1], [0.3, 0.5, -0.2], [0.1, -0.2, 0.4]],
    ];
    for (rank, covariance) in (1..).zip(covariances) {
        let matrix = nalgebra::Matrix3::from(covariance);
        // Any root of the covariance works: here from its eigenvectors.
        let eigen = matrix.symmetric_eigen();
        let root = eigen.eigenvectors
            * nalgebra::Matrix3::from_diagonal(
                &eigen.eigenvalues.map(|v: f64| if v > 1e-12 { v.sqrt() } else { 0.0 }),
            );
        let vector = NormalVector::new([0.0; 3], covariance);
        assert_eq!(vector.deviations.iter().filter(|d| **d > 0.0).count(), rank);
        let q = vector.quantile(0.95);
        let mut random = stream(rank as u64, 0);
        let inside = (0..count).filter(|_| {
            let z = nalgebra::Vector3::from_fn(|_, _| random.sample::<f64, _>(StandardNormal));
            (root * z).norm_squared() <= q * q
        });
        let share = inside.count() as f64 / count as f64;
        assert!((share - 0.95).abs() < 4.0 * (0.95 * 0.05 / count as f64).sqrt(), "rank {rank}: {share}");
    }
}

/// Checks Student's t-distribution in closed form: a line with one and two degrees of freedom, an
/// isotropic plane with any (`P(‖T‖ ≤ r) = 1 − (1 + r²/ν)^(−ν/2)`), and known quantiles. For many
/// degrees of freedom it is normal to first order in 1/ν.
#[test]
fn student_in_closed_form() {
    let student = |variances: [f64; 3], nu: f64| {
        let [x, y, z] = variances;
        StudentVector::new([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], nu)
    };
    for r in [1e-3, 0.2, 1.0, 3.0, 12.0, 400.0] {
        let line = [student([1.0, 0.0, 0.0], 1.0), student([1.0, 0.0, 0.0], 2.0)].map(|line| line.within(r));
        let exact = [2.0 / PI * r.atan(), r / (2.0 + r * r).sqrt()];
        for (found, exact) in line.into_iter().zip(exact) {
            assert!((found - exact).abs() < 1e-9, "{r}: {found} {exact}");
        }
        for nu in [0.7, 1.0, 2.5, 9.0, 40.0, 1000.0, 9e4] {
            let found = student([0.0, 4.0, 4.0], nu).within(2.0 * r);
            let exact = -(-0.5 * nu * (r * r / nu).ln_1p()).exp_m1();
            assert!((found - exact).abs() < 1e-9, "{nu} {r}: {found} {exact}");
        }
    }
    for (nu, t) in [(1.0, 12.706_204_736), (3.0, 3.182_446_305), (9.0, 2.262_157_163), (30.0, 2.042_272_456)]
    {
        let found = student([0.0, 0.25, 0.0], nu).quantile(0.95);
        assert!((2.0 * found / t - 1.0).abs() < 1e-9, "{nu}: {found}");
    }
    // 3 F(3, ν).
    for (nu, f) in [(5.0, 5.409_451_318), (20.0, 3.098_391_224)] {
        let found = student([1.0; 3], nu).quantile(0.95);
        assert!((found * found / 3.0 / f - 1.0).abs() < 1e-8, "{nu}: {}", found * found / 3.0);
    }
    // t ≈ z (1 + (z² + 1)/(4ν)).
    let z = 1.959_963_984_540_054_f64;
    for nu in [9.9e4, 1.01e5, 1e7, 1e12] {
        let found = student([1.0, 0.0, 0.0], nu).quantile(0.95);
        assert!((found - z * (1.0 + (z * z + 1.0) / 4.0 / nu)).abs() < 1e-8, "{nu}: {found}");
    }
}

/// Compares several shapes with draws, within four standard errors.
#[test]
fn student_vectors_against_draws() {
    let mut random = stream(21, 0);
    for (variances, nu) in [([1.0, 0.3, 0.0], 3.0), ([1.0, 0.5, 0.1], 6.0), ([1.0, 1e-3, 1e-9], 2.0)] {
        let [x, y, z] = variances;
        let vector = StudentVector::new([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], nu);
        let q = vector.quantile(0.95);
        assert!((vector.within(q) - 0.95).abs() < 1e-9);
        let common = rand_distr::ChiSquared::new(nu).unwrap();
        let count = 400_000;
        let inside = (0..count).filter(|_| {
            let square: f64 =
                variances.iter().map(|v| v * random.sample::<f64, _>(StandardNormal).powi(2)).sum();
            square <= q * q * random.sample(common) / nu
        });
        let share = inside.count() as f64 / f64::from(count);
        assert!(
            (share - 0.95).abs() < 4.0 * (0.95 * 0.05 / f64::from(count)).sqrt(),
            "{variances:?}: {share}"
        );
    }
}

/// Checks that with three or more degrees of freedom no shape has a larger quantile than a line of
/// the same trace.
#[test]
fn a_line_has_the_largest_quantile() {
    let mut random = stream(22, 0);
    for nu in [3.0, 4.0, 8.0, 50.0, f64::INFINITY] {
        let quantile = |[x, y, z]: [f64; 3]| {
            StudentVector::new([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], nu).quantile(0.95)
        };
        let line = quantile([1.0, 0.0, 0.0]);
        for _ in 0..if thorough() { 12 } else { 3 } {
            let any = [0; 3].map(|_| random.random::<f64>().powi(3));
            let trace: f64 = any.iter().sum();
            assert!(quantile(any.map(|v| v / trace)) <= line * (1.0 + 1e-9), "{nu} {any:?}");
        }
        assert!(quantile([0.5, 0.5, 0.0]) < line && quantile([1.0 / 3.0; 3]) < line);
    }
}
