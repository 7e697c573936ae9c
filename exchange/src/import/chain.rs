//! Serial chain of a file in another format: everything that a spec states about it.
//!
//! Constant transforms before and after the motion of a joint.
//!
//! Multiples of 45° that a file has with too few digits.

use std::f64::consts::{FRAC_PI_4, PI};

use abbe::LengthUnit;
use abbe_spec::{DhConvention, Notes, option::ROUND_ANGLES};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

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

/// Motion by `multiplier · q + offset` along or about a unit vector, and by another variable.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    pub(crate) prismatic: bool,
    pub(crate) axis: [f64; 3],
    /// Index of the variable `q`.
    pub(crate) variable: usize,
    pub(crate) multiplier: f64,
    /// Index of another variable that is added, and its sign.
    pub(crate) with: Option<(usize, f64)>,
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
                Some(Motion { prismatic, axis, variable, multiplier, with, offset }) => {
                    let other = with.map_or(0.0, |(other, sign)| sign * q[other]);
                    joint_motion(*prismatic, *axis, multiplier * q[*variable] + other + offset)
                }
            };
            pose * frame.geometry.before() * motion * frame.geometry.after()
        };
        self.frames.iter().fold(Isometry3::identity(), frame) * self.tool.motion()
    }

    /// Returns configuration `k` of those at which chains are compared; they fill the limits.
    pub(crate) fn sample(&self, k: usize) -> Vec<f64> {
        let value = |(v, variable): (usize, &Variable)| {
            let [lower, upper] = variable.limits.unwrap_or([-PI, PI]);
            // Multiples of the square roots of different integers.
            lower + (upper - lower) * (k as f64 * (v as f64 + 2.0).sqrt()).fract()
        };
        self.variables.iter().enumerate().map(value).collect()
    }

    /// Returns the largest distance in mm of the tool point from that of a chain with other angles.
    pub fn largest_shift(&self, other: &Self) -> f64 {
        let shift = |k| {
            let q = self.sample(k);
            (self.pose(&q).translation.vector - other.pose(&q).translation.vector).norm()
        };
        let millimetres = 1e3 * self.length.in_metres();
        millimetres * (1..=CONFIGURATIONS).map(shift).fold(0.0, f64::max)
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

/// Constant part of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Geometry {
    /// Placement as in URDF; the joint moves after it.
    Origin(Placement),
    /// Denavit-Hartenberg numbers; the motion, which adds to `theta` or `d`, is not part of them.
    DenavitHartenberg(DhRow),
}

/// Denavit-Hartenberg numbers of one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DhRow {
    pub(crate) convention: DhConvention,
    pub(crate) theta: f64,
    pub(crate) d: f64,
    pub(crate) a: f64,
    pub(crate) alpha: f64,
}

impl DhRow {
    /// Returns `Rz(theta) Tz(d)`, which commutes with every motion about or along z.
    fn z(&self) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.theta);
        Isometry3::from_parts(Translation3::new(0.0, 0.0, self.d), turn)
    }

    /// Returns `Tx(a) Rx(alpha)`; the two factors commute.
    fn x(&self) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), self.alpha);
        Isometry3::from_parts(Translation3::new(self.a, 0.0, 0.0), turn)
    }
}

impl Geometry {
    /// Returns the transform from the previous frame to the joint.
    pub(crate) fn before(&self) -> Isometry3<f64> {
        match self {
            Self::Origin(placement) => placement.motion(),
            Self::DenavitHartenberg(row) => match row.convention {
                DhConvention::Standard => row.z(),
                DhConvention::Modified => row.x() * row.z(),
            },
        }
    }

    /// Returns the transform from the joint to the frame.
    pub(crate) fn after(&self) -> Isometry3<f64> {
        match self {
            Self::DenavitHartenberg(row) if row.convention == DhConvention::Standard => row.x(),
            _ => Isometry3::identity(),
        }
    }

    /// Returns the sum of the lengths: the scale of rounding errors.
    pub(crate) fn size(&self) -> f64 {
        match self {
            Self::Origin(placement) => placement.xyz.iter().map(|x| x.abs()).sum(),
            Self::DenavitHartenberg(row) => row.a.abs() + row.d.abs(),
        }
    }
}

/// Number of configurations at which chains are compared.
pub(crate) const CONFIGURATIONS: usize = 100;

/// Largest distance from a multiple of 45°, in rad, that counts as rounding in the file.
const TOLERANCE: f64 = 1e-5;

/// Largest distance from a multiple of 45°, in rad, of an angle that was probably meant to be one.
const NEAR: f64 = 2e-3;

/// Counts the angles of a file that are multiples of 45° but for rounding, and restores them on
/// request.
#[derive(Debug)]
pub struct AngleRounding {
    /// Replaces such an angle by the multiple.
    round: bool,
    /// Largest distance that counts as rounding.
    tolerance: f64,
    count: usize,
    /// Largest distance from a multiple, in rad.
    farthest: f64,
    /// Angles further off that were probably meant to be multiples.
    near: Vec<f64>,
}

impl AngleRounding {
    /// Starts to count; with `round` set, `angle` restores the multiples.
    pub fn new(round: bool) -> Self {
        Self { round, tolerance: TOLERANCE, count: 0, farthest: 0.0, near: Vec::new() }
    }

    /// Restores those that were probably meant, too, if there are any.
    pub fn as_meant(&self) -> Option<Self> {
        (!self.near.is_empty()).then(|| Self { tolerance: NEAR, ..Self::new(true) })
    }

    /// Counts an angle in rad and returns it, rounded to the multiple if that is requested.
    pub(crate) fn angle(&mut self, angle: f64) -> f64 {
        let multiple = (angle / FRAC_PI_4).round() * FRAC_PI_4;
        let off = (multiple - angle).abs();
        if off == 0.0 || off > self.tolerance {
            // Angles of a calibrated machine have more digits.
            let is_short = (angle * 1e4).round() / 1e4 == angle;
            if is_short && 0.0 < off && off < NEAR {
                self.near.push(angle);
            }
            return angle;
        }
        self.count += 1;
        self.farthest = self.farthest.max(off);
        if self.round { multiple } else { angle }
    }

    /// Notes the number of such angles and the largest change. Warns about those further off, with
    /// the `shift` of the tool point in mm that multiples would cause.
    pub fn note(&self, shift: f64, notes: &mut dyn Notes) {
        let Self { round, count, farthest, near, .. } = self;
        if !near.is_empty() {
            let off = |angle: &f64| ((angle / FRAC_PI_4).round() * FRAC_PI_4 - angle).abs();
            let most = near.iter().map(off).fold(0.0, f64::max);
            let listed: Vec<String> = near.iter().take(4).map(f64::to_string).collect();
            notes.warn(&format!(
                "{} ({}{} rad) by up to {:.1} mrad off a multiple of 45°{}; multiples would move the tool by up to {shift:.2} mm; \
                 if they are meant, correct the file",
                if near.len() == 1 { "1 angle is".to_owned() } else { format!("{} angles are", near.len()) },
                listed.join(", "),
                if near.len() > 4 { ", …" } else { "" },
                1e3 * most,
                if *round { ", too far to be rounded" } else { "" }
            ));
        }
        if *count == 0 {
            if *round && near.is_empty() {
                notes.note("no angle was rounded: each is a multiple of 45°, or not near one");
            }
            return;
        }
        let one = *count == 1;
        notes.note(&if *round {
            let angles =
                if one { "angle was rounded to a multiple" } else { "angles were rounded to multiples" };
            format!("{count} {angles} of 45°, by {farthest:.0e} rad at most")
        } else {
            let angles = if one { "angle is a multiple" } else { "angles are multiples" };
            let them = if one { "it" } else { "them" };
            format!(
                "{count} {angles} of 45° within {farthest:.0e} rad; `{ROUND_ANGLES}` rounds \
                 {them}, which makes generated code shorter"
            )
        });
    }
}
