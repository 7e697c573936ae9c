//! Nominal chain of a URDF file, joint by joint.

use abbe::Pose;
use abbe_spec::{Diagnostic, Document, option::BASE};
use nalgebra::Isometry3;

use super::read::{Ends, read};
use crate::import::AngleRounding;
use crate::import::chain::{Chain, Frame, Geometry, Motion};
use crate::placement::{Placement, joint_motion, pose};

/// Chain between two links of a file.
pub(super) struct NominalChain(Chain);

/// Joint of the chain.
pub(super) struct NominalJoint {
    pub(super) name: String,
    /// Translation of its `origin`, in m.
    pub(super) xyz: [f64; 3],
    /// Rotation of its `origin`, in rad.
    pub(super) rpy: [f64; 3],
    /// Unit vector of the motion; `None` for a fixed joint.
    pub(super) axis: Option<[f64; 3]>,
    /// Motion where all variables are 0: the identity, unless the joint follows another with an
    /// offset.
    pub(super) at_zero: Pose,
}

impl NominalChain {
    /// Reads a file; mistakes go to the document.
    pub(super) fn read(document: &Document, ends: &Ends) -> Option<Self> {
        let chain = read(document, ends, false, &mut AngleRounding::new(false), &mut ())?;
        if let Some(frame) = chain.frames.iter().find(|frame| frame.upward) {
            let message =
                format!("the tip is no descendant of the base: the chain goes up at `{}`", frame.joint);
            return document.fail(Diagnostic::whole_file(message).help(
                format!("errors of such a chain cannot be written as origins of the file; choose a base link above the tip by `{BASE}`"),
            ));
        }
        Some(Self(chain))
    }

    /// Iterates over the variables by their names in a spec.
    pub(super) fn variables(&self) -> impl Iterator<Item = &str> {
        self.0.variables.iter().map(|variable| variable.name.as_str())
    }

    /// Returns the joints from base to tip.
    pub(super) fn joints(&self) -> Vec<NominalJoint> {
        let joint = |frame: &Frame| {
            let Placement { xyz, rpy } = match frame.geometry {
                Geometry::Origin(placement) => placement,
                Geometry::DenavitHartenberg(_) => Placement::default(),
            };
            let at_zero = match frame.motion {
                Some(Motion { prismatic, axis, offset, .. }) => joint_motion(prismatic, axis, offset),
                None => Isometry3::identity(),
            };
            let axis = frame.motion.map(|motion| motion.axis);
            NominalJoint { name: frame.joint.clone(), xyz, rpy, axis, at_zero: pose(&at_zero) }
        };
        self.0.frames.iter().map(joint).collect()
    }

    /// Returns the pose of the tip in the base, in m.
    pub(super) fn pose(&self, q: &[f64]) -> Pose {
        pose(&self.0.pose(q))
    }
}
