//! What is unknown of a machine, and what part its sources have.

use abbe_core::Component;

/// A number that measurements are to tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unknown {
    /// An error of where a machine stands: of a frame `E_0` at `F_0`, at this station.
    Base(usize, Component),
    /// A constant generalized error of a frame, from 0.
    Error(usize, Component),
    /// How large a repeatable source is, 1 = as the spec has it.
    Magnitude(usize),
    /// A coordinate (0, 1, 2) of a target in the frame of the tool, less what the model says.
    Target(usize, usize),
    /// An error of the tool: where whole poses are measured.
    Tool(Component),
    /// Where a fixture stands: a coordinate (0, 1, 2) of a point, a tilt (0, 1) of a direction, less what the model says.
    Fixture(usize, usize),
    /// The zero of a reading, less what the model says.
    Zero(usize),
}

impl Unknown {
    /// Whether it is where the machine or a fixture stands, or what is mounted on its tool: no error of the machine.
    pub fn is_placement(self) -> bool {
        matches!(self, Self::Base(..) | Self::Fixture(..) | Self::Zero(_)) || self.is_tool()
    }

    /// Whether it is what is mounted on the tool.
    pub fn is_tool(self) -> bool {
        matches!(self, Self::Target(..) | Self::Tool(_))
    }
}

/// What part a source has in a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It is there as the spec has it.
    Known,
    /// Its magnitude is among the unknowns.
    Unknown,
    /// It is left out.
    Off,
}
