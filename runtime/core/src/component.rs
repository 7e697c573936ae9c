//! The six generalized errors of a frame.

/// Generalized error of a frame, one of six in the order of ε.
///
/// **Spin turns about Y, roll about Z, pitch about X**: the order of the rotations is not that of
/// the axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Component {
    /// `e_x`: translation along x.
    X,
    /// `e_y`: translation along y.
    Y,
    /// `e_z`: translation along z.
    Z,
    /// `e_s`: rotation about **y**.
    Spin,
    /// `e_r`: rotation about **z**.
    Roll,
    /// `e_p`: rotation about **x**.
    Pitch,
}

impl Component {
    /// The six components, in the order of ε.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::Spin, Self::Roll, Self::Pitch];

    /// Returns the index within a frame's six errors, 0 to 5.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Returns the axis (0 = x, 1 = y, 2 = z) along or about which the error acts.
    pub const fn axis(self) -> usize {
        match self {
            Self::X | Self::Pitch => 0,
            Self::Y | Self::Spin => 1,
            Self::Z | Self::Roll => 2,
        }
    }

    /// Returns whether the component is a rotation.
    pub const fn is_rotation(self) -> bool {
        matches!(self, Self::Spin | Self::Roll | Self::Pitch)
    }

    /// Returns the name in a spec file: `e_x` … `e_p`.
    pub const fn name(self) -> &'static str {
        ["e_x", "e_y", "e_z", "e_s", "e_r", "e_p"][self as usize]
    }
}
