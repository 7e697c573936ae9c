//! Jacobian columns as twists, for either orientation of rows 4–6.

use crate::{Orientation, Pose};

/// Returns a column with rows 4–6 converted to the small rotation in `F_0` axes. `pose` is the tool
/// pose.
///
/// For Euler rows `ω = σ̇ ŷ + ρ̇ R_y(σ) ẑ + π̇ R_T x̂`, which is defined where the rows are.
pub fn twist(orientation: Orientation, pose: &Pose, column: &[f64; 6]) -> [f64; 6] {
    match orientation {
        Orientation::RotationVector => *column,
        Orientation::EulerYzx => {
            // The x axis of the tool is (cos σ cos ρ, sin ρ, −sin σ cos ρ).
            let [r11, r21, r31] = pose.0[0];
            let cos_roll = roll_cosine(pose);
            let (sin_spin, cos_spin) = (-r31 / cos_roll, r11 / cos_roll);
            let [x, y, z, spin, roll, pitch] = *column;
            [x, y, z, roll * sin_spin + pitch * r11, spin + pitch * r21, roll * cos_spin + pitch * r31]
        }
    }
}

/// Returns `cos ρ = √(r11² + r31²)`, the margin of Euler rows.
pub fn roll_cosine(pose: &Pose) -> f64 {
    let [r11, _, r31] = pose.0[0];
    r11.hypot(r31)
}
