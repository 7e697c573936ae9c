//! Unknowns of a model, and the roles of its sources.

use abbe_core::Component;

/// A number to be identified.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unknown {
    /// An error of `E_0` at a station, in `F_0`: placement of the machine.
    Base(usize, Component),
    /// A constant generalized error of a frame, numbered from 0.
    Error(usize, Component),
    /// Magnitude of a repeatable source; 1 is its size in the spec.
    Magnitude(usize),
    /// Deviation of coordinate 0, 1 or 2 of a target from its nominal position, in the frame of the
    /// tool. The index is that of [`Model::targets`](super::Model::targets).
    Target(usize, usize),
    /// An error of the tool in a placement, where whole poses are measured.
    Tool(usize, Component),
    /// Deviation of a fixture from its nominal geometry: coordinate 0, 1 or 2 of a point, tilt 0 or
    /// 1 of a direction.
    Fixture(usize, usize),
    /// Deviation of the zero of an observable from its nominal value.
    Zero(usize),
    /// Deviation of an intrinsic parameter of the camera from its nominal value, in the order of
    /// [`Camera::intrinsics`](super::Camera::intrinsics).
    Intrinsic(usize),
}

impl Unknown {
    /// Returns whether it describes the placement of machine, fixtures or targets, or the
    /// instrument, instead of an error of the machine.
    pub fn is_placement(self) -> bool {
        matches!(self, Self::Base(..) | Self::Fixture(..) | Self::Zero(_) | Self::Intrinsic(_))
            || self.is_tool()
    }

    /// Returns whether it is a rotation of the base, of a frame or of the tool.
    pub fn is_rotation(self) -> bool {
        matches!(self, Self::Base(_, component) | Self::Error(_, component) | Self::Tool(_, component)
            if component.is_rotation())
    }

    /// Returns whether it describes the mounting on the tool.
    pub fn is_tool(self) -> bool {
        matches!(self, Self::Target(..) | Self::Tool(..))
    }
}

/// Role of a source in a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The source is present as in the spec.
    Known,
    /// The magnitude of the source is an unknown.
    Unknown,
    /// The source is omitted.
    Off,
}
