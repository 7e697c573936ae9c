//! Figures of many errors.

/// Mean, root mean square, largest, and the value that 95 % do not exceed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    /// How many there are.
    pub count: usize,
    /// The mean.
    pub mean: f64,
    /// The root mean square.
    pub rms: f64,
    /// The largest.
    pub max: f64,
    /// The smallest that at least 95 % do not exceed.
    pub p95: f64,
}

impl Figures {
    /// Those of norms; all 0 if there are none.
    pub fn from_norms(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let count = values.len();
        let n = count.max(1) as f64;
        let rank = (0.95 * n).ceil() as usize;
        Self {
            count,
            mean: values.iter().sum::<f64>() / n,
            rms: (values.iter().map(|v| v * v).sum::<f64>() / n).sqrt(),
            max: values.last().copied().unwrap_or_default(),
            p95: values.get(rank.saturating_sub(1)).copied().unwrap_or_default(),
        }
    }
}
