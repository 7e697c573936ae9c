//! Corrected joint commands for any manipulator, interpreted ones too.

use crate::compensator::{Compensated, compensate};
use crate::{Error, Manipulator, Orientation, Pose, Quantity, checks, real_pose};

/// Commands that bring the real tool to `target`, from `q` on, or to where the ideal tool is at `q` if none is given.
///
/// See [`compensate`]. Errors as for [`Manipulator::generalized_errors`] and [`Manipulator::joint_jacobian`].
pub fn corrected(
    manipulator: &dyn Manipulator,
    target: Option<&Pose>,
    q: &[f64],
    s: &[f64],
    u: &[f64],
) -> Result<Compensated<Vec<f64>>, Error> {
    let description = manipulator.description();
    let ideal = manipulator.pose(q, s)?;
    let mut transforms = vec![Pose::IDENTITY; description.frames.len() + 1];
    let mut errors = vec![[0.0; 6]; description.frames.len()];
    let room = vec![[0.0; 6]; q.len()];
    compensate(description, target.unwrap_or(&ideal), &q.to_vec(), room, |q, columns| {
        manipulator.generalized_errors(q, s, u, &mut errors)?;
        manipulator.transforms(q, s, &mut transforms)?;
        let pose = manipulator.joint_jacobian(q, s, columns)?;
        if description.orientation == Orientation::EulerYzx {
            columns.iter_mut().for_each(|column| *column = twist(&pose, column));
        }
        let real = real_pose(&transforms, &errors);
        checks::finite(Quantity::Pose, real.0.as_flattened())?;
        Ok(real)
    })
}

/// A column with a rotation vector of one with Euler rows: `ω = σ̇ ŷ + ρ̇ R_y(σ) ẑ + π̇ R_T x̂`.
fn twist(pose: &Pose, column: &[f64; 6]) -> [f64; 6] {
    let [r11, r21, r31] = pose.0[0];
    // cos ρ is not 0 where there are Euler rows.
    let cosine = r11.hypot(r31);
    let (sine, cosine) = (-r31 / cosine, r11 / cosine);
    let [x, y, z, spin, roll, pitch] = *column;
    [x, y, z, roll * sine + pitch * r11, spin + pitch * r21, roll * cosine + pitch * r31]
}
