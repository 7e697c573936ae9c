//! A chain as it was described elsewhere: all that a spec says of it.

use nalgebra::Isometry3;

use super::placement::{Placement, moved};

/// From the base to the tool point.
#[derive(Debug)]
pub(super) struct Chain {
    /// What the robot is called in its file.
    pub(super) robot: String,
    /// The links at its ends.
    pub(super) base: String,
    pub(super) tip: String,
    /// What moves it, in the order of the frames.
    pub(super) variables: Vec<Variable>,
    pub(super) frames: Vec<Frame>,
    /// From the last frame to the tool point.
    pub(super) tool: Placement,
    pub(super) masses: Vec<Mass>,
}

/// A joint variable.
#[derive(Debug)]
pub(super) struct Variable {
    /// The joint whose value it is, as its file has it.
    pub(super) joint: String,
    /// As a spec can have it.
    pub(super) name: String,
    pub(super) prismatic: bool,
    /// In rad or m.
    pub(super) limits: Option<[f64; 2]>,
    /// Whether it turns without end.
    pub(super) continuous: bool,
}

/// A frame at its joint: placed, then moved.
#[derive(Debug)]
pub(super) struct Frame {
    pub(super) joint: String,
    /// The link that it belongs to.
    pub(super) link: String,
    pub(super) placement: Placement,
    pub(super) motion: Option<Motion>,
}

/// By `multiplier · q + offset` along or about a unit vector.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub(super) prismatic: bool,
    pub(super) axis: [f64; 3],
    /// Which variable is `q`.
    pub(super) variable: usize,
    pub(super) multiplier: f64,
    pub(super) offset: f64,
}

/// What a link weighs.
#[derive(Debug)]
pub(super) struct Mass {
    pub(super) link: String,
    pub(super) kilograms: f64,
    /// The frame that carries it, and its centre there.
    pub(super) frame: usize,
    pub(super) centre: [f64; 3],
}

impl Chain {
    /// The pose of the tool point in the base: what the written spec must have as well.
    pub(super) fn pose(&self, q: &[f64]) -> Isometry3<f64> {
        let frame = |pose: Isometry3<f64>, frame: &Frame| {
            let pose = pose * frame.placement.motion();
            match &frame.motion {
                None => pose,
                Some(Motion { prismatic, axis, variable, multiplier, offset }) => {
                    pose * moved(*prismatic, *axis, multiplier * q[*variable] + offset)
                }
            }
        };
        self.frames.iter().fold(Isometry3::identity(), frame) * self.tool.motion()
    }
}
