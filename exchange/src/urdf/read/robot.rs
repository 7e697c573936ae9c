//! Links and joints of a URDF file, with the spans that mistakes point to.

use abbe_spec::{Diagnostic, diagnostic::Span};

use crate::placement::Placement;

/// Robot of a file.
#[derive(Debug)]
pub(super) struct Robot {
    pub(super) name: String,
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<Joint>,
    /// Number of shapes in other files, which are not read.
    pub(super) meshes: usize,
    /// Sentences about what was not read as it stands.
    pub(super) notes: Vec<String>,
}

/// Rigid body.
#[derive(Debug)]
pub(super) struct Link {
    pub(super) name: String,
    pub(super) span: Span,
    /// Mass in kg and centre of mass in the frame of the link.
    pub(super) mass: Option<(f64, [f64; 3])>,
    /// Mistakes, which matter if the chain has the link.
    pub(super) faults: Vec<Diagnostic>,
}

/// Joint between two links: the frame of the child is at `placement` in the parent, and moves after
/// it.
#[derive(Debug)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) span: Span,
    pub(super) kind: JointKind,
    pub(super) parent: Named,
    pub(super) child: Named,
    pub(super) placement: Placement,
    /// Unit vector of the motion.
    pub(super) axis: [f64; 3],
    /// Lower and upper limit in rad or m.
    pub(super) limits: Option<[f64; 2]>,
    pub(super) mimic: Option<Mimic>,
    /// Mistakes, which matter if the chain has the joint.
    pub(super) faults: Vec<Diagnostic>,
}

/// Reference to a link or joint by its name.
#[derive(Debug)]
pub(super) struct Named {
    pub(super) name: String,
    pub(super) span: Span,
}

/// Coupling to another joint: the value is `multiplier · q + offset`.
#[derive(Debug)]
pub(super) struct Mimic {
    pub(super) joint: Named,
    pub(super) multiplier: f64,
    pub(super) offset: f64,
}

/// Kind of a joint.
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
    /// Names and values of all kinds.
    pub(super) const ALL: [(&'static str, Self); 6] = [
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("fixed", Self::Fixed),
        ("planar", Self::Planar),
        ("floating", Self::Floating),
    ];
}
