//! Distance between two lists of poses.

use abbe::{Pose, identify::f_test};

/// Residuals as root mean squares.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PoseResidual {
    pub(crate) position: f64,
    /// Residual of orientations in rad; none if they were not measured.
    pub(crate) angle: Option<f64>,
    /// Position and angle combined as a length, with angles times a lever, corrected for the number
    /// of fitted parameters.
    pub(crate) both: f64,
    /// Degrees of freedom: number of measured values minus number of fitted parameters.
    pub(super) freedom: f64,
}

/// Returns the sums over all rows of `|Δp|²` and of `½ |ΔR|²`, which is the square of a small
/// angle.
pub(super) fn squares(predicted: &[Pose], measured: &[Pose], oriented: bool) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (predicted, measured) in predicted.iter().zip(measured) {
        let (a, b) = (&predicted.0, &measured.0);
        sums[0] += square(a[3], b[3]);
        if oriented {
            sums[1] += 0.5 * (square(a[0], b[0]) + square(a[1], b[1]) + square(a[2], b[2]));
        }
    }
    sums
}

fn square(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    x * x + y * y + z * z
}

impl PoseResidual {
    /// Computes the residual from sums of squares over `rows`, with angles times `lever`; the last
    /// argument is the numbers of measured values and of fitted parameters.
    pub(super) fn new(
        [positions, angles]: [f64; 2],
        rows: usize,
        oriented: bool,
        lever: f64,
        [numbers, fitted]: [usize; 2],
    ) -> Self {
        let mean = |sum: f64| (sum / rows as f64).max(0.0).sqrt();
        let freedom = numbers as f64 - fitted as f64;
        Self {
            position: mean(positions),
            angle: oriented.then(|| mean(angles)),
            both: mean(positions + lever * lever * angles) * (numbers as f64 / freedom).sqrt(),
            freedom,
        }
    }

    /// Tests by an F-test of the variances whether this residual exceeds the other by more than
    /// noise.
    ///
    /// The test is a rule of thumb: it takes angles to be as noisy as positions, and it ignores
    /// that the best of many interpretations is partly best by chance.
    pub(super) fn exceeds(&self, other: &Self) -> bool {
        let squares = |residual: &Self| residual.both.powi(2) * residual.freedom;
        let (own, least) = (squares(self), squares(other));
        f_test(own + least, least, self.freedom as usize, other.freedom as usize).p < 1e-6
    }
}
