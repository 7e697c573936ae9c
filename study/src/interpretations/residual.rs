//! How far two lists of poses are from each other.

use abbe::Pose;
use abbe::identify::f_test;

/// What is left, as root mean squares.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Residual {
    pub(crate) position: f64,
    /// None if orientations were not seen.
    pub(crate) angle: Option<f64>,
    /// Both as a length, angles times a lever: as it would be if nothing had been fitted.
    pub(crate) both: f64,
    /// How many numbers more were seen than fitted.
    pub(super) freedom: f64,
}

/// The sum over all rows of `|Δp|²`, and of `½ |ΔR|²`, which is the square of a small angle.
pub(super) fn squares(predicted: &[Pose], seen: &[Pose], oriented: bool) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (predicted, seen) in predicted.iter().zip(seen) {
        let (a, b) = (&predicted.0, &seen.0);
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

impl Residual {
    /// Of so many rows, angles with this lever; of the numbers that were seen, so many are fitted.
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

    /// Whether this is more than noise makes of what leaves so little, by an F-test of their variances. A rule: angles are
    /// taken for as noisy as positions, and the best of many interpretations is best by chance, too.
    pub(super) fn is_beyond(&self, other: &Self) -> bool {
        let squares = |residual: &Self| residual.both.powi(2) * residual.freedom;
        let (own, least) = (squares(self), squares(other));
        f_test(own + least, least, self.freedom as usize, other.freedom as usize).p < 1e-6
    }
}
