//! Independent parts of the errors of a calibration.

/// Share of a variance below which what remains of it is rounding.
const ROUNDING: f64 = 1e-12;

/// Returns vectors l with `Σ l lᵀ = C`, the columns of a Cholesky factor with pivots: independent
/// normal errors times these have the covariance C. A covariance that is singular has fewer of
/// them. Negative eigenvalues, which rounding of written numbers causes, count as 0.
pub(crate) fn independent_parts(covariance: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = covariance.len();
    let mut rest = covariance.to_vec();
    let mut parts = Vec::new();
    // The quantities have different units: pivots are relative to their own variances.
    let share = |rest: &[Vec<f64>], i: usize| match covariance[i][i] {
        0.0 => 0.0,
        variance => rest[i][i] / variance,
    };
    for _ in 0..count {
        let Some(pivot) = (0..count).max_by(|i, j| share(&rest, *i).total_cmp(&share(&rest, *j))) else {
            break;
        };
        if share(&rest, pivot) <= ROUNDING {
            break;
        }
        let root = rest[pivot][pivot].sqrt();
        let part: Vec<f64> = rest.iter().map(|row| row[pivot] / root).collect();
        for (row, left) in rest.iter_mut().zip(&part) {
            row.iter_mut().zip(&part).for_each(|(entry, right)| *entry -= left * right);
        }
        parts.push(part);
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::independent_parts;

    /// Holds that the parts have the covariance, for quantities of different units and a singular
    /// matrix.
    #[test]
    fn parts_have_the_covariance() {
        let columns = [[0.1, 2e-6, 0.0, 0.5], [0.03, -5e-7, 0.0, 0.5]];
        let covariance: Vec<Vec<f64>> =
            (0..4).map(|i| (0..4).map(|j| columns.iter().map(|c| c[i] * c[j]).sum()).collect()).collect();
        let parts = independent_parts(&covariance);
        assert_eq!(parts.len(), 2);
        for i in 0..4 {
            for j in 0..4 {
                let sum: f64 = parts.iter().map(|part| part[i] * part[j]).sum();
                let scale = (covariance[i][i] * covariance[j][j]).sqrt();
                assert!((sum - covariance[i][j]).abs() <= 1e-12 * scale, "{i} {j}");
            }
        }
    }
}
