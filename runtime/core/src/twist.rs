//! Jacobian columns as twists, for either orientation of rows 4–6.

use crate::{Orientation, Pose, chain::renamed};

/// Returns a column with rows 4–6 converted to the small rotation in `F_0` axes. `pose` is the tool
/// pose.
///
/// For Euler rows, in [renamed](Orientation::last_axis) axes, `ω = σ̇ ŷ + ρ̇ R_y(σ) ẑ + π̇ R_T x̂`,
/// which is defined where the rows are.
pub fn twist(orientation: Orientation, pose: &Pose, column: &[f64; 6]) -> [f64; 6] {
    let Some(axis) = orientation.last_axis() else { return *column };
    // The x axis of the tool is (cos σ cos ρ, sin ρ, −sin σ cos ρ).
    let [r11, r21, r31] = renamed(axis, pose.0[axis]);
    let cosine = r11.hypot(r31);
    let (sin_spin, cos_spin) = (-r31 / cosine, r11 / cosine);
    let [x, y, z, spin, roll, pitch] = *column;
    let turn = [roll * sin_spin + pitch * r11, spin + pitch * r21, roll * cos_spin + pitch * r31];
    // Back to the axes of F_0: three cyclic renamings are none.
    let [a, b, c] = renamed((3 - axis) % 3, turn);
    [x, y, z, a, b, c]
}
