//! The exact chain: equations (2) and (6) with true rotations, frame by frame.
//!
//! Generated code never calls it; it verifies generated code.

use crate::{Component, Description, Orientation, Pose, Scalar};
#[cfg(feature = "std")]
use crate::{Error, Quantity, checks};

/// Returns `A_1 A_2 … A_n · T`, the tool pose in `F_0`. `transforms` holds `A_1 … A_n` and `T`.
pub fn chain(transforms: &[Pose]) -> Pose {
    transforms.iter().fold(Pose::IDENTITY, |product, transform| product.then(transform))
}

/// Returns `A_1 E_1 A_2 E_2 … A_n E_n · T`, equation (6), with exact rotations.
///
/// `transforms` holds `A_1 … A_n` and `T`. `errors` holds the six generalized errors of each frame;
/// frames beyond its end have none.
pub fn real_pose(transforms: &[Pose], errors: &[[f64; 6]]) -> Pose {
    let mut product = Pose::IDENTITY;
    for (i, transform) in transforms.iter().enumerate() {
        product = product.then(transform);
        if let Some(e) = errors.get(i).filter(|_| i + 1 < transforms.len()) {
            product = product.then(&displacement(e));
        }
    }
    product
}

/// Returns the pose of the tool point in `F_0` from `A_1 … A_n` and `T` of a chain or tree of
/// frames, and the generalized errors of the frames; frames beyond the end of `errors` have none.
///
/// With loops, this is the pose at the nominal values of the passive variables: the errors do not
/// move these.
pub fn tool_pose(description: &Description, transforms: &[Pose], errors: &[[f64; 6]]) -> Pose {
    let mut pose = transforms.last().copied().unwrap_or(Pose::IDENTITY);
    let mut frame = description.tool_frame();
    while let Some(at) = frame {
        if let Some(errors) = errors.get(at) {
            pose = displacement(errors).then(&pose);
        }
        pose = transforms[at].then(&pose);
        frame = description.parent(at);
    }
    pose
}

/// Returns the exact pose of the tool point of a machine without loops with given errors, six per
/// frame: equation (6). `transforms` fills in the nominal ones.
///
/// # Errors
///
/// Returns the errors of `transforms`, [`Error::Count`] for another number of frames, and
/// [`Error::NotFinite`] if the pose is not finite.
#[cfg(feature = "std")]
pub fn open_pose(
    description: &Description,
    transforms: impl FnOnce(&mut [Pose]) -> Result<(), Error>,
    errors: &[[f64; 6]],
) -> Result<Pose, Error> {
    let frames = description.frames.len();
    checks::length(Quantity::Errors, [frames, 1], errors.len())?;
    let mut nominal = std::vec![Pose::IDENTITY; frames + 1];
    transforms(&mut nominal)?;
    let pose = tool_pose(description, &nominal, errors);
    checks::finite(Quantity::Pose, pose.0.as_flattened())?;
    Ok(pose)
}

/// Returns `E_i`: translation `(e_x, e_y, e_z)` and rotation `R = R_y(e_s) R_z(e_r) R_x(e_p)`.
pub fn displacement(e: &[f64; 6]) -> Pose {
    let (ss, cs) = Scalar::sin_cos(e[Component::Spin.index()]);
    let (sr, cr) = Scalar::sin_cos(e[Component::Roll.index()]);
    let (sp, cp) = Scalar::sin_cos(e[Component::Pitch.index()]);
    let spin = Pose([[cs, 0.0, -ss], [0.0, 1.0, 0.0], [ss, 0.0, cs], [e[0], e[1], e[2]]]);
    let roll = Pose([[cr, sr, 0.0], [-sr, cr, 0.0], [0.0, 0.0, 1.0], [0.0; 3]]);
    let pitch = Pose([[1.0, 0.0, 0.0], [0.0, cp, sp], [0.0, -sp, cp], [0.0; 3]]);
    spin.then(&roll).then(&pitch)
}

/// Converts the six errors at another point of a frame's link to those of the frame, exactly:
/// `E_i = L E_M L⁻¹` (Figure 5).
///
/// `place` is `L`, the pose of that point relative to the frame; `errors` are the errors there, in
/// its axes. The effects of a located source are the first-order approximation; the real pose of
/// generated code is exact.
pub fn located(place: &Pose, errors: &[f64; 6]) -> [f64; 6] {
    let displaced = place.then(&displacement(errors)).then(&place.inverse());
    let ([x, y, z], [spin, roll, pitch]) = (displaced.position(), euler(0, &displaced));
    [x, y, z, spin, roll, pitch]
}

/// Returns `ΔX = X_real − X_ideal`, equation (5), which `J_e ε` approximates.
///
/// Rows 1–3 are in the length unit of the poses, rows 4–6 in rad as `orientation` says. Euler
/// differences are wrapped to (−π, π]; they are meaningless where the Euler angles of either pose
/// are singular.
pub fn deviation(orientation: Orientation, ideal: &Pose, real: &Pose) -> [f64; 6] {
    let turn = match orientation.last_axis() {
        None => {
            let mut difference = real.then(&ideal.inverse());
            difference.0[3] = [0.0; 3];
            rotation_vector(&difference)
        }
        Some(axis) => {
            let (a, b) = (euler(axis, ideal), euler(axis, real));
            core::array::from_fn(|i| wrap(b[i] - a[i]))
        }
    };
    let (from, to) = (ideal.position(), real.position());
    [to[0] - from[0], to[1] - from[1], to[2] - from[2], turn[0], turn[1], turn[2]]
}

/// Returns the angles of `R = R_y(σ) R_z(ρ) R_x(π)`, in axes [renamed](Orientation::last_axis) so
/// that `axis` is x.
fn euler(axis: usize, pose: &Pose) -> [f64; 3] {
    let [x, y, z] = [0, 1, 2].map(|column| renamed(axis, pose.0[(axis + column) % 3]));
    let cosine = Scalar::sqrt(x[0] * x[0] + x[2] * x[2]);
    [Scalar::atan2(-x[2], x[0]), Scalar::atan2(x[1], cosine), Scalar::atan2(-z[1], y[1])]
}

/// Returns the margin of Euler rows, the cosine of the second angle: `cos ρ = √(r11² + r31²)` in
/// [renamed](Orientation::last_axis) axes. It is 1 for rotation vectors.
pub fn euler_margin(orientation: Orientation, pose: &Pose) -> f64 {
    orientation.last_axis().map_or(1.0, |axis| {
        let [r11, _, r31] = renamed(axis, pose.0[axis]);
        Scalar::sqrt(r11 * r11 + r31 * r31)
    })
}

/// Returns the components along the axes that follow `axis` in cyclic order, itself first.
pub(crate) fn renamed(axis: usize, vector: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| vector[(axis + i) % 3])
}

/// Limit on twice the sine of an angle below which its square underflows; the rotation vector is
/// then half the antisymmetric part.
pub const LEAST_SINE: f64 = 1e-37;

/// Returns the rotation vector of a rotation: its axis times its angle.
pub fn rotation_vector(pose: &Pose) -> [f64; 3] {
    let [x, y, z, _] = pose.0;
    let v = [y[2] - z[1], z[0] - x[2], x[1] - y[0]];
    let twice_sine = Scalar::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    let angle = Scalar::atan2(twice_sine, x[0] + y[1] + z[2] - 1.0);
    // angle / (2 sin angle) → 1/2 for small angles.
    let scale = if twice_sine < LEAST_SINE { 0.5 } else { angle / twice_sine };
    v.map(|component| component * scale)
}

fn wrap(angle: f64) -> f64 {
    use core::f64::consts::{PI, TAU};
    if angle > PI {
        angle - TAU
    } else if angle <= -PI {
        angle + TAU
    } else {
        angle
    }
}

#[cfg(test)]
mod tests;
