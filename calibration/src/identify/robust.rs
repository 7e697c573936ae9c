//! Robust losses: weights of iteratively reweighted least squares.

/// Loss function of a residual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Loss {
    /// Squared residual.
    #[default]
    Squares,
    /// Huber: squared up to 1.345 scales, linear beyond.
    Huber,
    /// Tukey's biweight: constant beyond 4.685 scales.
    Tukey,
}

impl Loss {
    /// Returns the weight of a residual of a given norm, in scales; 0 if it is rejected.
    ///
    /// For a vector of `d` residuals the thresholds grow with `√d`, which keeps the share of good
    /// rows with full weight.
    pub fn weight(self, norm: f64, d: usize) -> f64 {
        let stretch = (d.max(1) as f64).sqrt();
        match self {
            Self::Squares => 1.0,
            Self::Huber => (1.345 * stretch / norm.max(1e-300)).min(1.0),
            Self::Tukey => {
                let share = norm / (4.685 * stretch);
                if share < 1.0 { (1.0 - share * share).powi(2) } else { 0.0 }
            }
        }
    }

    /// Returns the cost of a residual, in scales: its square at full weight. With `n = |r|` and the
    /// weight `w`, its derivative is `2 n w`.
    pub(super) fn cost(self, norm: f64, d: usize) -> f64 {
        let stretch = (d.max(1) as f64).sqrt();
        match self {
            Self::Squares => norm * norm,
            Self::Huber => {
                let bound = 1.345 * stretch;
                if norm <= bound { norm * norm } else { bound * (2.0 * norm - bound) }
            }
            Self::Tukey => {
                let bound = 4.685 * stretch;
                let share = (norm / bound).min(1.0);
                bound * bound / 3.0 * (1.0 - (1.0 - share * share).powi(3))
            }
        }
    }
}

/// Returns the median absolute deviation from zero divided by 0.6745, an estimate of the standard
/// deviation that up to half of the values do not affect.
pub fn robust_scale(residuals: &mut [f64]) -> f64 {
    robust_scale_after(residuals, 0)
}

/// Returns the robust scale after a fit of `spent` unknowns: the median of all but the `spent`
/// smallest residuals.
///
/// A fit makes as many residuals vanish as it has unknowns, so the median of all is too small for
/// few rows (DuMouchel and O'Brien, *Integrating a robust option into a multiple regression
/// computing environment*, 1989).
pub(super) fn robust_scale_after(residuals: &mut [f64], spent: usize) -> f64 {
    if residuals.is_empty() {
        return 0.0;
    }
    residuals.iter_mut().for_each(|r| *r = r.abs());
    let middle = (residuals.len() + spent.min(residuals.len() - 1)) / 2;
    let (_, median, _) = residuals.select_nth_unstable_by(middle, f64::total_cmp);
    *median / 0.674_489_750_196_082
}

#[cfg(test)]
mod tests;
