//! Errors of a chain, and the frames with them.

use abbe::Pose;
use abbe_spec::Spec;

/// Errors of a chain at one configuration, or their means.
#[derive(Clone, Debug)]
pub(crate) struct ChainErrors {
    /// Generalized errors of each frame: `e_x e_y e_z e_s e_r e_p`.
    pub(crate) frames: Vec<[f64; 6]>,
    /// Errors of the joint variables.
    pub(crate) joints: Vec<f64>,
    /// Errors of the structural parameters.
    pub(crate) parameters: Vec<f64>,
    /// Errors of theta, d, a and alpha of each frame.
    pub(crate) dh_numbers: Vec<[f64; 4]>,
}

impl ChainErrors {
    /// Returns the errors of the nominal chain: zeros.
    pub(crate) fn none(spec: &Spec) -> Self {
        Self {
            frames: vec![[0.0; 6]; spec.frames.len()],
            joints: vec![0.0; spec.variables.len()],
            parameters: vec![0.0; spec.parameters.len()],
            dh_numbers: vec![[0.0; 4]; spec.frames.len()],
        }
    }
}

/// Frame of the real chain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    /// `A_i` with the errors of its numbers.
    pub(crate) transform: Pose,
    /// `E_i`.
    pub(crate) error: Pose,
}

impl Link {
    /// Returns `pose · A_i E_i`.
    pub(crate) fn after(&self, pose: &Pose) -> Pose {
        pose.then(&self.transform).then(&self.error)
    }
}

/// Returns the product `A_1 E_1 A_2 E_2 …`.
pub(crate) fn product(links: &[Link]) -> Pose {
    links.iter().fold(Pose::IDENTITY, |pose, link| link.after(&pose))
}

/// Returns `Rz(angle) Tz(shift)`.
pub(crate) fn about_z(angle: f64, shift: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    Pose([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, shift]])
}

/// Returns `Rx(angle) Tx(shift)`.
pub(crate) fn about_x(angle: f64, shift: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    Pose([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c], [shift, 0.0, 0.0]])
}
