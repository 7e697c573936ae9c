//! A chain as it was described elsewhere: all that a spec says of it.

use abbe::LengthUnit;
use nalgebra::Isometry3;

use super::geometry::Geometry;
use super::placement::{Placement, moved};

/// From the base to the tool point.
#[derive(Debug)]
pub(super) struct Chain {
    /// What the robot is called in its file.
    pub(super) robot: String,
    /// What was taken from the file, in words.
    pub(super) origin: String,
    /// The unit of every length.
    pub(super) length: LengthUnit,
    /// Whether angles are written in degrees.
    pub(super) degrees: bool,
    /// The links, or the frames, at its ends.
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
    /// In rad, or in the chain's unit of length.
    pub(super) limits: Option<[f64; 2]>,
    /// Whether it turns without end.
    pub(super) continuous: bool,
}

/// A frame at its joint.
#[derive(Debug)]
pub(super) struct Frame {
    pub(super) joint: String,
    /// The link that it belongs to, if the file has links.
    pub(super) link: Option<String>,
    pub(super) geometry: Geometry,
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
            let moved = match &frame.motion {
                None => Isometry3::identity(),
                Some(Motion { prismatic, axis, variable, multiplier, offset }) => {
                    moved(*prismatic, *axis, multiplier * q[*variable] + offset)
                }
            };
            pose * frame.geometry.before() * moved * frame.geometry.after()
        };
        self.frames.iter().fold(Isometry3::identity(), frame) * self.tool.motion()
    }
}
