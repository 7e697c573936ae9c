//! Summary statistics of errors, and comparison of two models.

use super::{configurations::Numbering, statistics::student_beyond};

/// Mean, root mean square, maximum and 95th percentile of errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    /// Number of errors.
    pub count: usize,
    /// Number of independent configurations.
    pub configurations: usize,
    /// The mean.
    pub mean: f64,
    /// Cluster-robust standard error of the mean; infinite for a single configuration.
    pub standard_error: f64,
    /// The root mean square.
    pub rms: f64,
    /// The maximum.
    pub max: f64,
    /// 95th percentile: the smallest value that at least 95 % do not exceed.
    pub p95: f64,
}

impl Figures {
    /// Computes the figures of norms at distinct configurations; all are 0 without norms.
    pub fn from_norms(values: Vec<f64>) -> Self {
        let mean = Mean::clustered(values.iter().copied(), &[]);
        Self::from_mean(values, mean)
    }

    fn from_mean(mut values: Vec<f64>, Mean { mean, standard_error, configurations }: Mean) -> Self {
        let count = values.len();
        if count == 0 {
            return Self::default();
        }
        let n = count as f64;
        let rms = (values.iter().map(|v| v * v).sum::<f64>() / n).sqrt();
        let max = values.iter().copied().max_by(f64::total_cmp).unwrap_or_default();
        let rank = (0.95 * n).ceil() as usize;
        let (_, p95, _) = values.select_nth_unstable_by(rank.max(1) - 1, f64::total_cmp);
        Self { count, configurations, mean, standard_error, rms, max, p95: *p95 }
    }
}

/// Distances between model and measurement with their configurations, in twelve bytes each because
/// there can be millions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Distances {
    values: Vec<f64>,
    configurations: Vec<u32>,
}

/// Paired comparison of the distances of two models at the same points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Mean difference; positive if the other model's distances are larger.
    pub gain: f64,
    /// Cluster-robust standard error of the mean difference.
    pub standard_error: f64,
    /// Number of independent configurations.
    pub configurations: usize,
    /// Two-sided p-value of the mean difference, by Student's t.
    pub p: f64,
}

impl Distances {
    /// Appends a distance.
    pub fn push(&mut self, configuration: u32, value: f64) {
        self.values.push(value);
        self.configurations.push(configuration);
    }

    /// Returns all distances in order.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns all distances without their configurations.
    pub fn into_values(self) -> Vec<f64> {
        self.values
    }

    /// Computes the figures; all are 0 without distances.
    pub fn figures(&self) -> Figures {
        Figures::from_mean(self.values.clone(), self.mean())
    }

    /// Computes the figures in place.
    pub fn into_figures(self) -> Figures {
        let mean = self.mean();
        Figures::from_mean(self.values, mean)
    }

    fn mean(&self) -> Mean {
        Mean::clustered(self.values.iter().copied(), &self.configurations)
    }

    /// Replaces the number of each configuration.
    #[must_use]
    pub(super) fn renumbered(mut self, number: impl Fn(u32) -> u32) -> Self {
        self.configurations.iter_mut().for_each(|one| *one = number(*one));
        self
    }

    /// Compares these distances with others at the same points, pair by pair.
    pub fn compared_with(&self, others: &Self) -> Comparison {
        let differences = self.values.iter().zip(&others.values).map(|(own, other)| other - own);
        let Mean { mean: gain, standard_error, configurations } =
            Mean::clustered(differences, &self.configurations);
        let t = if gain == 0.0 { 0.0 } else { gain.abs() / standard_error };
        let p = match configurations {
            0 | 1 => 1.0,
            _ => student_beyond(t, configurations as f64 - 1.0),
        };
        Comparison { gain, standard_error, configurations, p }
    }
}

impl FromIterator<(u32, f64)> for Distances {
    fn from_iter<I: IntoIterator<Item = (u32, f64)>>(values: I) -> Self {
        let (configurations, values) = values.into_iter().unzip();
        Self { values, configurations }
    }
}

impl Extend<(u32, f64)> for Distances {
    fn extend<I: IntoIterator<Item = (u32, f64)>>(&mut self, values: I) {
        values.into_iter().for_each(|(configuration, value)| self.push(configuration, value));
    }
}

/// A mean, its standard error, and its number of configurations.
struct Mean {
    mean: f64,
    standard_error: f64,
    configurations: usize,
}

impl Mean {
    /// Computes a mean with a cluster-robust standard error.
    ///
    /// With the sums `d_c = Σ_i (v_ci − v̄)` over the values of each of `C` configurations:
    /// `s² = C/(C − 1) · Σ d_c² / n²`, which for one value each is the usual one. Without
    /// configurations, each value is a configuration of its own.
    fn clustered(values: impl Iterator<Item = f64> + Clone, configurations: &[u32]) -> Self {
        let count = values.clone().count();
        let n = count.max(1) as f64;
        let mean = values.clone().sum::<f64>() / n;
        let mut sums = Vec::new();
        let squares = match configurations {
            [] => values.map(|value| (value - mean).powi(2)).sum::<f64>(),
            _ => {
                let mut numbering = Numbering::for_keys(configurations.iter().copied());
                for (value, configuration) in values.zip(configurations) {
                    let at = numbering.number(*configuration) as usize;
                    sums.resize(sums.len().max(at + 1), 0.0);
                    sums[at] += value - mean;
                }
                sums.iter().map(|d| d * d).sum::<f64>()
            }
        };
        let configurations = if configurations.is_empty() { count } else { sums.len() };
        let standard_error = match configurations {
            0 => 0.0,
            1 => f64::INFINITY,
            _ => {
                let c = configurations as f64;
                (c / (c - 1.0) * squares).sqrt() / n
            }
        };
        Self { mean, standard_error, configurations }
    }
}

#[cfg(test)]
mod tests;
