//! Linear axes of machine tools: X, Y and Z along the axes of `F_0`, one on the other, and their
//! errors by ISO 230-1.
//!
//! The workpiece is at rest or on rotary axes, which are at 0 where errors of slides are evaluated.

use abbe::analysis::sampling::vectors::{add, cross, subtract};
use abbe::{Error, Manipulator, Orientation, Pose, VariableKind, deviation, real_pose};
use abbe_spec::{Diagnostics, mistake, option::TO_TABLE};

use super::{ChainErrors, RealMachine, product};

/// Linear axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slide {
    /// Index of its variable.
    pub(crate) variable: usize,
    /// Index of its frame.
    pub(crate) frame: usize,
    /// Direction: 0 = X, 1 = Y, 2 = Z.
    pub(crate) axis: usize,
    /// Limits of the variable.
    pub(crate) range: [f64; 2],
}

impl Slide {
    /// Returns the letter of the axis.
    pub(crate) fn letter(&self) -> char {
        ['X', 'Y', 'Z'][self.axis.min(2)]
    }

    /// Returns `count` equidistant values from one limit to the other.
    pub(crate) fn nodes(&self, count: usize) -> Vec<f64> {
        abbe::analysis::sampling::grid(self.range, count)
    }
}

/// Axes of a machine tool.
pub(crate) struct Axes {
    /// Slides from the bed to the tool.
    pub(crate) slides: Vec<Slide>,
    /// Variables of the rotary axes of the workpiece.
    pub(crate) rotary: Vec<usize>,
}

impl Axes {
    /// Finds the axes of a machine; a machine of another structure is a mistake.
    pub(crate) fn find(machine: &RealMachine) -> Result<Self, Diagnostics> {
        let spec = &machine.spec;
        let refused = |name: &str, reason: &str| {
            let help = format!(
                "these tables need slides along X, Y and Z of F_0 that carry the tool; \
                rotary axes must carry the workpiece. `{TO_TABLE}` exports any machine"
            );
            Err(mistake::with_help(&machine.origin, format!("`{name}` {reason}"), help))
        };
        let evaluated = |error: Error| mistake::whole(&machine.origin, &error);
        let zero = vec![0.0; spec.variables.len()];
        let up_to = |q: &[f64], frame: usize| {
            let mut transforms = vec![Pose::IDENTITY; spec.frames.len() + 1];
            let done = machine.manipulator.transforms(q, &machine.s, &mut transforms).map_err(evaluated);
            done.map(|()| transforms[..=frame].iter().fold(Pose::IDENTITY, |pose, next| pose.then(next)))
        };
        let (mut slides, mut rotary): (Vec<Slide>, Vec<usize>) = (Vec::new(), Vec::new());
        // After the first slide there are only slides.
        let sliding = spec.variables.iter().filter(|one| one.kind == VariableKind::Prismatic);
        let first = sliding.map(|one| one.frame).min();
        for (i, variable) in spec.variables.iter().enumerate() {
            let (name, frame) = (variable.name.as_str(), variable.frame);
            match (variable.kind, first) {
                (VariableKind::Prismatic, _) => {}
                (VariableKind::Revolute, None) => {
                    return refused(name, "is a rotary axis, and the machine has no slide");
                }
                (VariableKind::Revolute, Some(first)) if frame > first => {
                    return refused(name, "is a rotary axis of the tool");
                }
                (VariableKind::Revolute, Some(_)) => {
                    rotary.push(i);
                    continue;
                }
            }
            if !variable.limits.iter().all(|limit| limit.is_finite()) {
                return refused(name, "has no limits, so its table has no ends");
            }
            let mut q = zero.clone();
            q[i] = 1.0;
            let (from, to) = (up_to(&zero, frame)?, up_to(&q, frame)?);
            let moved: [f64; 3] = std::array::from_fn(|k| to.position()[k] - from.position()[k]);
            let along =
                |axis: usize| (0..3).all(|k| (moved[k] - f64::from(u8::from(k == axis))).abs() < 1e-9);
            let Some(axis) = (0..3).find(|axis| along(*axis)) else {
                return refused(name, "does not translate in the direction of X, Y or Z of F_0");
            };
            let parallel =
                (0..3).all(|k| (0..3).all(|l| (from.0[k][l] - Pose::IDENTITY.0[k][l]).abs() < 1e-9));
            if !parallel {
                return refused(name, "moves a frame whose axes are not parallel to those of F_0");
            }
            if slides.iter().any(|other| other.axis == axis) {
                return refused(name, "is a second slide along the same axis");
            }
            slides.push(Slide { variable: i, frame, axis, range: variable.limits });
        }
        slides.sort_by_key(|slide| slide.frame);
        Ok(Self { slides, rotary })
    }

    /// Returns the index of the frame of the first slide.
    pub(crate) fn first_frame(&self) -> usize {
        self.slides.first().map_or(0, |slide| slide.frame)
    }

    /// Returns the configuration with slide `k` at `value`, the other slides at home and rotary
    /// axes at 0, and the nominal inputs.
    pub(crate) fn at(&self, machine: &RealMachine, k: usize, value: f64) -> (Vec<f64>, Vec<f64>) {
        let (mut q, u) = machine.at_home(self.slides[k].variable, value);
        self.rotary.iter().for_each(|variable| q[*variable] = 0.0);
        (q, u)
    }

    /// Returns a sentence about errors of an axis that depend on more than its position, which a
    /// table over one axis cannot hold.
    ///
    /// The inputs `followed` are known to the format.
    pub(crate) fn errors_beyond_own_axis(&self, machine: &RealMachine, followed: &[usize]) -> Option<String> {
        let slides = self.slides.iter().map(|slide| slide.variable);
        let variables: Vec<usize> = slides.chain(self.rotary.iter().copied()).collect();
        machine.errors_beyond_own_axis(&variables, followed)
    }

    /// Returns the errors of the slides and of the frames after them.
    pub(crate) fn errors(&self, machine: &RealMachine, q: &[f64], u: &[f64]) -> Result<ChainErrors, Error> {
        let mut errors = machine.errors_at(q, u)?;
        if !self.rotary.is_empty() {
            let before = self.first_frame();
            errors.frames[..before].fill([0.0; 6]);
            errors.dh_numbers[..before].fill([0.0; 4]);
            self.rotary.iter().for_each(|variable| errors.joints[*variable] = 0.0);
        }
        Ok(errors)
    }
}

/// Reference point: the origin of the frame of the first slide where all variables are 0.
pub(crate) struct Reference {
    /// Position in `F_0`.
    pub(crate) point: [f64; 3],
    /// Nominal tool point, from the reference point along the axes of `F_0`.
    pub(crate) tool: [f64; 3],
}

impl Reference {
    /// Finds the reference point of a machine.
    pub(crate) fn new(machine: &RealMachine, axes: &Axes) -> Result<Self, Error> {
        Self::of_frames(machine, axes.slides.first().map_or(0, |slide| slide.frame + 1))
    }

    /// Takes the origin of the last frame as the reference point: the tool reference point.
    pub(crate) fn at_tool(machine: &RealMachine) -> Result<Self, Error> {
        Self::of_frames(machine, machine.spec.frames.len())
    }

    /// Takes the origin of the last of `count` frames as the reference point.
    fn of_frames(machine: &RealMachine, count: usize) -> Result<Self, Error> {
        let zero = vec![0.0; machine.spec.variables.len()];
        let (links, _) = machine.links(&zero, &ChainErrors::none(&machine.spec))?;
        let point = product(&links[..count]).position();
        let tool = machine.manipulator.pose(&zero, &machine.s)?.position();
        Ok(Self { point, tool: subtract(tool, point) })
    }

    /// Returns the six errors of the carriage of slide `k` at `value` by ISO 230-1, actual minus
    /// nominal.
    ///
    /// They are translations along X, Y and Z at the reference point, which moves with the
    /// carriage, then rotations about X, Y and Z. With the small motion `(t, θ) = A⁻¹ Ã E` of the
    /// frame and `r` from its origin to the reference point the translation is `t + θ × r`. The
    /// other slides are at home, rotary axes at 0.
    pub(crate) fn errors(
        &self,
        machine: &RealMachine,
        axes: &Axes,
        k: usize,
        value: f64,
    ) -> Result<[f64; 6], Error> {
        let slide = axes.slides[k];
        let (q, u) = axes.at(machine, k, value);
        let (nominal, _) = machine.links(&q, &ChainErrors::none(&machine.spec))?;
        let (real, _) = machine.links(&q, &axes.errors(machine, &q, &u)?)?;
        let i = slide.frame;
        let moved = nominal[i].transform.inverse().then(&real[i].transform).then(&real[i].error);
        let [x, y, z, a, b, c] = deviation(Orientation::RotationVector, &Pose::IDENTITY, &moved);
        let frame =
            nominal[..=i].iter().fold(Pose::IDENTITY, |pose, link| pose.then(&link.transform)).position();
        let mut point = self.point;
        axes.slides[..=k].iter().for_each(|slide| point[slide.axis] += q[slide.variable]);
        let [x, y, z] = add([x, y, z], cross([a, b, c], subtract(point, frame)));
        Ok([x, y, z, a, b, c])
    }
}

/// Interpolates a table with rising nodes linearly at `x`; beyond its ends the table is constant.
pub(crate) fn interpolated<const N: usize>(nodes: &[f64], rows: &[[f64; N]], x: f64) -> [f64; N] {
    let above = nodes.partition_point(|node| *node <= x);
    match (above.checked_sub(1).map(|i| (nodes[i], rows[i])), nodes.get(above).zip(rows.get(above))) {
        (Some((from, low)), Some((to, high))) => {
            let share = (x - from) / (to - from);
            std::array::from_fn(|i| low[i] + share * (high[i] - low[i]))
        }
        (Some((_, row)), None) => row,
        (None, Some((_, row))) => *row,
        (None, None) => [0.0; N],
    }
}

/// Nodes of an axis in mm or degrees, and at each of them its errors along X, Y and Z in mm, then
/// about X, Y and Z in rad.
pub(crate) type ErrorTable = (Vec<f64>, Vec<[f64; 6]>);

/// Returns the real and the ideal tool point from the reference point in mm: the product of `T(x)
/// T(t) R(θ)` of all slides, and the tool.
///
/// `mm` is the unit of length of `q` in mm.
pub(crate) fn tool_points(
    slides: &[Slide],
    tables: &[ErrorTable],
    tool: [f64; 3],
    q: &[f64],
    mm: f64,
) -> [[f64; 3]; 2] {
    let (mut real, mut ideal) = (Pose::IDENTITY, tool);
    for (slide, (nodes, errors)) in slides.iter().zip(tables) {
        let at = q[slide.variable] * mm;
        ideal[slide.axis] += at;
        let [x, y, z, a, b, c] = interpolated(nodes, errors, at);
        let mut shift = [x, y, z];
        shift[slide.axis] += at;
        real = real.then(&small_motion(shift, [a, b, c]));
    }
    [real.apply(tool), ideal]
}

/// Returns a translation after a rotation about X, Y and Z; for one angle, or small ones.
pub(crate) fn small_motion([x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> Pose {
    // Spin about Y, roll about Z, pitch about X.
    real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[[x, y, z, b, c, a]])
}
