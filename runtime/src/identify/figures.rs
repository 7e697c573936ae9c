//! Figures of many errors, and whether one model is better than another.

use super::Configurations;
use super::statistics::student_beyond;

/// Mean, root mean square, largest, and the value that 95 % do not exceed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    /// How many there are.
    pub count: usize,
    /// At how many independent configurations.
    pub configurations: usize,
    /// The mean.
    pub mean: f64,
    /// The standard error of the mean: errors of one configuration count together. Infinite where there is only one.
    pub standard_error: f64,
    /// The root mean square.
    pub rms: f64,
    /// The largest.
    pub max: f64,
    /// The smallest that at least 95 % do not exceed.
    pub p95: f64,
}

impl Figures {
    /// Those of norms, each at a configuration of its own; all 0 if there are none.
    pub fn from_norms(values: Vec<f64>) -> Self {
        Distances(values.into_iter().enumerate().collect()).figures()
    }
}

/// Distances between model and measurement, each with its configuration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Distances(pub Vec<(usize, f64)>);

/// How much smaller the distances of one model are than those of another, at the same points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// The mean of the differences: above 0 if the other's are larger.
    pub gain: f64,
    /// Its standard error, configurations counted.
    pub standard_error: f64,
    /// At how many independent configurations.
    pub configurations: usize,
    /// How likely a mean so far from 0, either way, is if both are as good: Student's t.
    pub p: f64,
}

impl Distances {
    /// Figures of them; all 0 if there are none.
    pub fn figures(&self) -> Figures {
        let mut values: Vec<f64> = self.0.iter().map(|(_, value)| *value).collect();
        let count = values.len();
        if count == 0 {
            return Figures::default();
        }
        let n = count as f64;
        let (mean, standard_error, configurations) = self.mean();
        let rms = (values.iter().map(|v| v * v).sum::<f64>() / n).sqrt();
        let max = values.iter().copied().max_by(f64::total_cmp).unwrap_or_default();
        let rank = (0.95 * n).ceil() as usize;
        let (_, p95, _) = values.select_nth_unstable_by(rank.max(1) - 1, f64::total_cmp);
        Figures { count, configurations, mean, standard_error, rms, max, p95: *p95 }
    }

    /// How much smaller these are than others of the same points, pair by pair.
    pub fn compared_with(&self, others: &Self) -> Comparison {
        let pairs = self.0.iter().zip(&others.0);
        let differences = Self(pairs.map(|((at, own), (_, other))| (*at, other - own)).collect());
        let (gain, standard_error, configurations) = differences.mean();
        let t = if gain == 0.0 { 0.0 } else { gain.abs() / standard_error };
        let p = match configurations {
            0 | 1 => 1.0,
            _ => student_beyond(t, configurations as f64 - 1.0),
        };
        Comparison { gain, standard_error, configurations, p }
    }

    /// The mean, its standard error, and how many configurations stand behind it.
    ///
    /// With the sums `d_c = Σ_i (v_ci − v̄)` over the values of each of `C` configurations:
    /// `s² = C/(C − 1) · Σ d_c² / n²`, which for one value each is that of a mean.
    fn mean(&self) -> (f64, f64, usize) {
        let Configurations { count, number } =
            Configurations::from_numbers(self.0.iter().map(|(at, _)| *at).collect());
        let n = self.0.len().max(1) as f64;
        let mean = self.0.iter().map(|(_, value)| value).sum::<f64>() / n;
        let mut sums = vec![0.0; count];
        self.0.iter().zip(number).for_each(|((_, value), at)| sums[at] += value - mean);
        let standard_error = match count {
            0 => 0.0,
            1 => f64::INFINITY,
            _ => {
                let c = count as f64;
                (c / (c - 1.0) * sums.iter().map(|d| d * d).sum::<f64>()).sqrt() / n
            }
        };
        (mean, standard_error, count)
    }
}

#[cfg(test)]
mod tests {
    use super::Distances;

    #[test]
    fn a_mean_is_as_sure_as_its_configurations() {
        let once: Vec<(usize, f64)> = [3.0, 5.0, 4.0, 8.0].into_iter().enumerate().collect();
        let ten_times: Vec<(usize, f64)> = (0..10).flat_map(|_| once.clone()).collect();
        let (once, ten_times) = (Distances(once), Distances(ten_times));
        // Standard deviation √(14/3), of four.
        assert!((once.figures().standard_error - (14.0f64 / 3.0 / 4.0).sqrt()).abs() < 1e-12);
        assert!((ten_times.figures().standard_error - once.figures().standard_error).abs() < 1e-12);
        assert_eq!((ten_times.figures().count, ten_times.figures().configurations), (40, 4));
    }

    #[test]
    fn a_comparison_is_that_of_student() {
        let at = |values: [f64; 5]| Distances(values.into_iter().enumerate().collect());
        let found = at([1.0, 2.0, 3.0, 4.0, 5.0]).compared_with(&at([1.5, 2.1, 3.6, 4.4, 5.2]));
        // Differences 0.5 0.1 0.6 0.4 0.2: t = 3.882 with 4 degrees of freedom, p = 0.0178.
        assert!((found.gain - 0.36).abs() < 1e-12 && (found.p - 0.0178).abs() < 2e-4, "{found:?}");
        let same = at([1.0; 5]).compared_with(&at([1.0; 5]));
        assert_eq!((same.gain, same.p), (0.0, 1.0));
    }
}
