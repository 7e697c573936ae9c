//! What a URDF file says of links and joints, with the place of everything that can be wrong.

use abbe_spec::diagnostic::Span;

use crate::import::placement::Placement;

/// A robot as its file has it.
#[derive(Debug)]
pub(super) struct Robot {
    pub(super) name: String,
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<Joint>,
    /// How many shapes refer to files, which are not read.
    pub(super) meshes: usize,
}

/// A rigid body.
#[derive(Debug)]
pub(super) struct Link {
    pub(super) name: String,
    pub(super) span: Span,
    /// Its mass in kg and its centre in the link's frame, if it has one.
    pub(super) mass: Option<(f64, [f64; 3])>,
}

/// What holds two links together: the child's frame stands at `placement`, then moves.
#[derive(Debug)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) span: Span,
    pub(super) kind: JointKind,
    pub(super) parent: Named,
    pub(super) child: Named,
    pub(super) placement: Placement,
    /// A unit vector.
    pub(super) axis: [f64; 3],
    /// The lower and the upper limit in rad or m.
    pub(super) limits: Option<[f64; 2]>,
    pub(super) mimic: Option<Mimic>,
}

/// The name of something else, where it is said.
#[derive(Debug)]
pub(super) struct Named {
    pub(super) name: String,
    pub(super) span: Span,
}

/// A joint that follows another: `multiplier · q + offset`.
#[derive(Debug)]
pub(super) struct Mimic {
    pub(super) joint: Named,
    pub(super) multiplier: f64,
    pub(super) offset: f64,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JointKind {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
    Planar,
    Floating,
}

impl JointKind {
    pub(super) const ALL: [(&'static str, Self); 6] = [
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("fixed", Self::Fixed),
        ("planar", Self::Planar),
        ("floating", Self::Floating),
    ];
}
