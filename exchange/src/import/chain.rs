//! Serial chain of a file in another format: everything that a spec states about it.

use abbe::LengthUnit;
use nalgebra::Isometry3;

use super::geometry::Geometry;
use crate::placement::{Placement, joint_motion};

/// Serial chain from the base to the tool point.
#[derive(Debug)]
pub struct Chain {
    /// Name of the robot in its file.
    pub(crate) robot: String,
    /// Part of the file that the chain is, in words.
    pub(crate) description: String,
    /// Unit of every length.
    pub(crate) length: LengthUnit,
    /// Writes angles in degrees where a short number gives the same angle.
    pub(crate) degrees: bool,
    /// Link or frame that is `F_0`.
    pub(crate) base: String,
    /// Link or frame of the tool point.
    pub(crate) tip: String,
    /// Joint variables, in the order of the frames that they move first.
    pub(crate) variables: Vec<Variable>,
    pub(crate) frames: Vec<Frame>,
    /// Pose of the tool point in the last frame.
    pub(crate) tool: Placement,
    pub(crate) masses: Vec<Mass>,
}

/// A joint variable.
#[derive(Debug)]
pub(crate) struct Variable {
    /// Name, in the file, of the joint that the variable belongs to.
    pub(crate) joint: String,
    /// Identifier in the spec.
    pub(crate) name: String,
    pub(crate) prismatic: bool,
    /// Lower and upper limit, in rad or the unit of length of the chain.
    pub(crate) limits: Option<[f64; 2]>,
    /// Turns without limits.
    pub(crate) continuous: bool,
}

/// Frame that follows a joint.
#[derive(Debug)]
pub(crate) struct Frame {
    pub(crate) joint: String,
    /// Link that the frame belongs to, if the file has links.
    pub(crate) link: Option<String>,
    pub(crate) geometry: Geometry,
    pub(crate) motion: Option<Motion>,
    /// `true` if the chain leads from the child link of the joint to its parent.
    pub(crate) upward: bool,
}

/// Motion by `multiplier · q + offset` along or about a unit vector.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    pub(crate) prismatic: bool,
    pub(crate) axis: [f64; 3],
    /// Index of the variable `q`.
    pub(crate) variable: usize,
    pub(crate) multiplier: f64,
    pub(crate) offset: f64,
}

/// Mass of a link.
#[derive(Debug)]
pub(crate) struct Mass {
    pub(crate) link: String,
    pub(crate) kilograms: f64,
    /// Index of the frame that carries the link.
    pub(crate) frame: usize,
    /// Centre of mass in that frame.
    pub(crate) centre: [f64; 3],
}

impl Chain {
    /// Returns the pose of the tool point in `F_0` for one value per variable.
    pub(crate) fn pose(&self, q: &[f64]) -> Isometry3<f64> {
        let frame = |pose: Isometry3<f64>, frame: &Frame| {
            let motion = match &frame.motion {
                None => Isometry3::identity(),
                Some(Motion { prismatic, axis, variable, multiplier, offset }) => {
                    joint_motion(*prismatic, *axis, multiplier * q[*variable] + offset)
                }
            };
            pose * frame.geometry.before() * motion * frame.geometry.after()
        };
        self.frames.iter().fold(Isometry3::identity(), frame) * self.tool.motion()
    }

    /// Returns the index of the frame that declares a variable: that of its joint, or else the
    /// first that it moves.
    pub(crate) fn owner(&self, variable: usize) -> usize {
        let joint = &self.variables[variable].joint;
        let moved = |frame: &Frame| frame.motion.is_some_and(|motion| motion.variable == variable);
        let frames = || self.frames.iter().enumerate().filter(|(_, frame)| moved(frame));
        let at_joint = frames().find(|(_, frame)| frame.joint == *joint);
        at_joint.or_else(|| frames().next()).map_or(0, |(i, _)| i)
    }
}
