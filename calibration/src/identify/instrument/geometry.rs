//! Positions and orientations at one configuration, from which observables are computed.

use super::{Camera, Fixture};
use abbe_core::Pose;

/// The tool, the targets and the fixtures at one configuration.
pub(in super::super) struct Geometry<'a> {
    /// Pose of `F_0` in the frame of the instrument.
    pub(in super::super) base: Pose,
    /// Pose of the tool in the frame of the instrument.
    pub(in super::super) tool: Pose,
    /// Pose of the tool in `F_0`.
    pub(in super::super) tool_in_f0: Pose,
    /// Positions of the targets in the frame of the tool.
    pub(in super::super) targets: &'a [[f64; 3]],
    /// Nominal fixtures.
    pub(in super::super) fixtures: &'a [Fixture],
    /// Displacements of the fixtures, by their unknowns.
    pub(in super::super) displacements: &'a [[f64; 3]],
    /// The camera with its current intrinsic parameters, if there is one.
    pub(in super::super) camera: Option<&'a Camera>,
    /// Pose of the tool in `F_0` and the targets, in the previous row.
    pub(in super::super) previous: Option<(Pose, &'a [[f64; 3]])>,
}

impl Geometry<'_> {
    /// Returns the position of a target in `F_0`.
    pub(super) fn target(&self, target: usize) -> [f64; 3] {
        self.tool_in_f0.apply(self.targets[target])
    }

    /// Returns the position of a target in the frame of the instrument.
    pub(super) fn target_seen(&self, target: usize) -> [f64; 3] {
        self.tool.apply(self.targets[target])
    }

    /// Returns the position of a target in `F_0` in the previous row, or its present one if there
    /// is none.
    pub(super) fn previous_target(&self, target: usize) -> [f64; 3] {
        self.previous.map_or_else(|| self.target(target), |(tool, targets)| tool.apply(targets[target]))
    }

    /// Returns the pose of the tool in `F_0` in the previous row, or its present one if there is
    /// none.
    pub(super) fn previous_tool(&self) -> Pose {
        self.previous.map_or(self.tool_in_f0, |(tool, _)| tool)
    }

    /// Returns the point or the unit direction of a fixture; zero if there is none.
    pub(super) fn fixture(&self, fixture: Option<usize>) -> [f64; 3] {
        fixture.map_or([0.0; 3], |f| self.fixtures[f].geometry.displaced(&self.displacements[f]).vector())
    }
}
