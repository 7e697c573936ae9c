//! Derivatives of points and orientations with respect to the six errors of a frame, at any size of
//! the errors.
//!
//! Let `P` be the product before `E`, and `E` a translation by `(e_x, e_y, e_z)` to the origin `o`
//! followed by `R = R_y(e_s) R_z(e_r) R_x(e_p)`. Each rotation turns the rest of the chain about an
//! axis through `o`: `a_s = P ŷ`, `a_r = P R_y ẑ`, `a_p = P R_y R_z x̂`. Hence
//! `∂p/∂e = a × (p − o)` and `ω = a`; a translation along axis k is `P ê_k`. At ε = 0 these are the
//! columns of `J_e`.

use abbe_analysis::sampling::vectors::cross;
use abbe_core::{Component, Pose, Scalar, displacement};

/// Axes, origin and pose of a frame with its errors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Direction of the translation or axis of the rotation, by component.
    axes: [[f64; 3]; 6],
    origin: [f64; 3],
    /// Product including `E`.
    pub(super) after: Pose,
}

/// Displacement by the errors of a frame, cached while they stay the same.
#[derive(Clone, Copy, Debug)]
pub(super) struct Displaced {
    errors: [f64; 6],
    pose: Pose,
    /// Sine and cosine of the spin.
    spin: (f64, f64),
}

impl Displaced {
    pub(super) const NOTHING: Self = Self { errors: [0.0; 6], pose: Pose::IDENTITY, spin: (0.0, 1.0) };

    /// Updates the displacement if the errors have changed.
    pub(super) fn by(&mut self, errors: &[f64; 6]) -> &Self {
        if self.errors != *errors {
            let spin = Scalar::sin_cos(errors[Component::Spin.index()]);
            *self = Self { errors: *errors, pose: displacement(errors), spin };
        }
        self
    }
}

impl Frame {
    /// Applies the errors after the product `before`.
    pub(super) fn new(before: &Pose, errors: &Displaced) -> Self {
        let after = before.then(&errors.pose);
        let (sine, cosine) = errors.spin;
        let [x, y, z, _] = before.0;
        let roll = before.turn([sine, 0.0, cosine]);
        // Component order: x, y, z, spin, roll, pitch. R_x keeps its own axis.
        Self { axes: [x, y, z, y, roll, after.0[0]], origin: after.position(), after }
    }

    /// Returns a frame whose errors do not move the tool.
    pub(super) fn at_rest(after: Pose) -> Self {
        Self { axes: [[0.0; 3]; 6], origin: after.position(), after }
    }

    /// Returns the derivative of a point with respect to a component.
    pub(super) fn point(&self, component: Component, point: [f64; 3]) -> [f64; 3] {
        let axis = self.axes[component.index()];
        if !component.is_rotation() {
            return axis;
        }
        cross(axis, core::array::from_fn(|i| point[i] - self.origin[i]))
    }

    /// Returns the rotation vector per unit of a component.
    pub(super) fn turn(&self, component: Component) -> [f64; 3] {
        if component.is_rotation() { self.axes[component.index()] } else { [0.0; 3] }
    }
}

/// Returns `J_l⁻¹(r) ω`: the change of the rotation vector `r` by a further rotation ω.
///
/// `J_l⁻¹ = I − ½[r] + (1/θ² − (1 + cos θ)/(2 θ sin θ)) [r]²`.
pub(super) fn turned(r: [f64; 3], omega: [f64; 3]) -> [f64; 3] {
    let angle = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
    let factor = if angle < 1e-4 {
        1.0 / 12.0
    } else {
        1.0 / (angle * angle) - (1.0 + angle.cos()) / (2.0 * angle * angle.sin())
    };
    let once = cross(r, omega);
    let twice = cross(r, once);
    core::array::from_fn(|i| omega[i] - 0.5 * once[i] + factor * twice[i])
}
