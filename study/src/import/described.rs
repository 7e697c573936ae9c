//! A robot as its URDF file describes it: for what is written back into the file.

use abbe::Pose;
use abbe_spec::document::Document;
use nalgebra::Isometry3;

use super::almost::Almost;
use super::chain::{Chain, Frame, Motion};
use super::geometry::Geometry;
use super::placement::{Placement, moved};
use super::urdf::{self, Ends};

/// The chain between two links of a file.
pub(crate) struct Described(Chain);

/// A joint on it, from base to tip.
pub(crate) struct Joint {
    pub(crate) name: String,
    /// Where it stands in the link before it: the numbers of its `origin`.
    pub(crate) xyz: [f64; 3],
    pub(crate) rpy: [f64; 3],
    /// Its unit vector, and whether it slides along it; none of a fixed one.
    pub(crate) axis: Option<([f64; 3], bool)>,
    /// How it is moved where all variables are 0: not at all, unless it follows another joint with an offset.
    pub(crate) at_zero: Pose,
}

impl Described {
    /// Reads a file; what is wrong goes to the document.
    pub(crate) fn read(document: &mut Document, base: Option<&str>, tip: Option<&str>) -> Option<Self> {
        let ends = Ends { base: base.map(str::to_owned), tip: tip.map(str::to_owned) };
        urdf::chain(document, &ends, false, &mut Almost::new(false), &mut ()).map(Self)
    }

    /// Its variables, by the names that a spec has for them.
    pub(crate) fn variables(&self) -> impl Iterator<Item = &str> {
        self.0.variables.iter().map(|variable| variable.name.as_str())
    }

    /// Its joints.
    pub(crate) fn joints(&self) -> Vec<Joint> {
        let joint = |frame: &Frame| {
            let Placement { xyz, rpy } = match frame.geometry {
                Geometry::Origin(placement) => placement,
                Geometry::Numbers(_) => Placement::default(),
            };
            let at_zero = match frame.motion {
                Some(Motion { prismatic, axis, offset, .. }) => moved(prismatic, axis, offset),
                None => Isometry3::identity(),
            };
            let axis = frame.motion.map(|motion| (motion.axis, motion.prismatic));
            Joint { name: frame.joint.clone(), xyz, rpy, axis, at_zero: pose(&at_zero) }
        };
        self.0.frames.iter().map(joint).collect()
    }

    /// Where the tip is; in m and rad.
    pub(crate) fn pose(&self, q: &[f64]) -> Pose {
        pose(&self.0.pose(q))
    }
}

/// As URDF writes it: roll, pitch and yaw of a pose.
pub(crate) fn roll_pitch_yaw(pose: &Pose) -> [f64; 3] {
    let Pose([x, y, z, _]) = *pose;
    let matrix = nalgebra::Matrix3::from_columns(&[x.into(), y.into(), z.into()]);
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(matrix);
    Placement::from_motion(&Isometry3::from_parts(Default::default(), rotation.into())).rpy
}

/// `T(xyz) Rz(yaw) Ry(pitch) Rx(roll)`.
pub(crate) fn placed(xyz: [f64; 3], rpy: [f64; 3]) -> Pose {
    pose(&Placement { xyz, rpy }.motion())
}

fn pose(motion: &Isometry3<f64>) -> Pose {
    let matrix = motion.to_homogeneous();
    Pose(std::array::from_fn(|j| std::array::from_fn(|i| matrix[(i, j)])))
}
