//! Rotary axes that carry the workpiece of a machine tool. The kinematics of the control holds
//! where they are; tables over an angle hold errors that vary with it.
//!
//! The chain starts at the workpiece, so `A_i E_i` leads from the table of axis i, which is `F_0`
//! or the next table, to its base. Seen from the base the axis is displaced by `E_i⁻¹`. Fixed
//! frames after the axis, `A_k E_k` without a variable, belong to the base.

use abbe::analysis::sampling::vectors::{add, cross, dot, scale};
use abbe::{Error, Manipulator, Orientation, Pose, deviation};
use abbe_spec::number::digits;
use serde::Serialize;

use super::{ChainErrors, Link, PoseDifference, RealMachine, product, slides::Axes};

/// Mean displacement of a rotary axis of the workpiece from its nominal pose.
#[derive(Clone, Debug, Serialize)]
pub struct RotaryAxis {
    /// Name of its variable.
    pub variable: String,
    /// Displacement of its origin along X, Y and Z of its base, in the unit of length of the spec.
    pub position: [f64; 3],
    /// Rotation about X, Y and Z of its base, in rad; the part about the axis itself is an error of
    /// its zero.
    pub angles: [f64; 3],
}

impl RotaryAxis {
    /// Returns the displacements of the rotary axes of a machine, with all variables at 0.
    pub(crate) fn all(machine: &RealMachine, axes: &Axes) -> Result<Vec<Self>, Error> {
        let zero = vec![0.0; machine.spec.variables.len()];
        let (nominal, _) = machine.links(&zero, &ChainErrors::none(&machine.spec))?;
        let (real, _) = machine.links(&zero, &machine.mean)?;
        let axis = |variable: &usize| {
            let (name, frame) =
                (&machine.spec.variables[*variable].name, machine.spec.variables[*variable].frame);
            let moved = displacement(machine, *variable, &nominal, &real);
            let [x, y, z, a, b, c] = deviation(Orientation::RotationVector, &Pose::IDENTITY, &moved);
            let base = product(&nominal[..=frame]);
            Self { variable: name.clone(), position: base.turn([x, y, z]), angles: base.turn([a, b, c]) }
        };
        Ok(axes.rotary.iter().map(axis).collect())
    }

    /// Returns the sentence that states the displacement for the control in mm and mrad; `mm` is
    /// the unit of length in mm.
    pub(crate) fn sentence(&self, mm: f64) -> String {
        // Rounded to 0.1 µm and 0.1 µrad.
        let numbers = |values: [f64; 3], names: [&str; 3], factor: f64| {
            let rounded = |value: f64| (value * factor * 1e4).round() / 1e4 + 0.0;
            let one = |(name, value): (&str, f64)| format!("{name} {}", digits(rounded(value), 4));
            names.into_iter().zip(values).map(one).collect::<Vec<_>>().join(", ")
        };
        format!(
            "Enter the pose of the rotary axis `{}` of the workpiece in the kinematic parameters of \
             the control: relative to the part that carries it, it is displaced by {} mm and \
             rotated by {} mrad on average.",
            self.variable,
            numbers(self.position, ["X", "Y", "Z"], mm),
            numbers(self.angles, ["A", "B", "C"], 1e3)
        )
    }
}

/// Rotary axis of the workpiece that turns about X, Y or Z of `F_0` where all variables are 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TabledAxis {
    /// Index of its variable.
    pub(crate) variable: usize,
    /// Direction: 0 = X, 1 = Y, 2 = Z.
    pub(crate) axis: usize,
    /// Limits of the variable.
    pub(crate) range: [f64; 2],
    /// Point on the axis in `F_0`, where all variables are 0.
    pub(crate) center: [f64; 3],
    /// Point on the axis in its own frame.
    own_center: [f64; 3],
    /// Its frame in `F_0`, where all variables are 0.
    base: Pose,
}

impl TabledAxis {
    /// Finds the rotary axes that tables can hold, from the table of the workpiece to the bed.
    ///
    /// `None` stands for an axis without limits, in another direction, or with the letter of one
    /// before it.
    pub(crate) fn all(machine: &RealMachine, axes: &Axes) -> Result<Vec<Option<Self>>, Error> {
        let zero = vec![0.0; machine.spec.variables.len()];
        let (nominal, _) = machine.links(&zero, &ChainErrors::none(&machine.spec))?;
        let mut found: Vec<Option<Self>> = Vec::new();
        for variable in &axes.rotary {
            let one = &machine.spec.variables[*variable];
            let base = product(&nominal[..=one.frame]);
            let direction = base.turn(own_direction(machine, *variable)?);
            let along =
                |axis: &usize| (0..3).all(|k| (direction[k] - f64::from(u8::from(k == *axis))).abs() < 1e-9);
            let is_new = |axis: &usize| found.iter().flatten().all(|other| other.axis != *axis);
            let axis = (0..3).find(along).filter(is_new);
            let mut q = zero.clone();
            q[*variable] = std::f64::consts::PI;
            let half = machine.links(&q, &ChainErrors::none(&machine.spec))?.0[one.frame].transform;
            // Half a turn moves the origin of the frame to the other side of the axis.
            let own_center = scale(nominal[one.frame].transform.inverse().then(&half).position(), 0.5);
            let has_ends = one.limits.iter().all(|limit| limit.is_finite());
            found.push(axis.filter(|_| has_ends).map(|axis| Self {
                variable: *variable,
                axis,
                range: one.limits,
                center: base.apply(own_center),
                own_center,
                base,
            }));
        }
        Ok(found)
    }

    /// Returns the letter of the axis.
    pub(crate) fn letter(&self) -> char {
        ['A', 'B', 'C'][self.axis.min(2)]
    }

    /// Returns the six errors of the table at the angle `value` by ISO 230-1, actual minus nominal
    /// seen from the part that carries it: translations along X, Y and Z of a point on the axis,
    /// then rotations about X, Y and Z. The other axes are at home, other rotary axes at 0.
    pub(crate) fn errors(&self, machine: &RealMachine, axes: &Axes, value: f64) -> Result<[f64; 6], Error> {
        let (mut q, u) = machine.at_home(self.variable, value);
        axes.rotary.iter().filter(|other| **other != self.variable).for_each(|other| q[*other] = 0.0);
        let (nominal, _) = machine.links(&q, &ChainErrors::none(&machine.spec))?;
        let (real, _) = machine.links(&q, &machine.errors_at(&q, &u)?)?;
        let moved = displacement(machine, self.variable, &nominal, &real);
        let [x, y, z, a, b, c] = deviation(Orientation::RotationVector, &Pose::IDENTITY, &moved);
        let shift = add([x, y, z], cross([a, b, c], self.own_center));
        let ([x, y, z], [a, b, c]) = (self.base.turn(shift), self.base.turn([a, b, c]));
        Ok([x, y, z, a, b, c])
    }
}

/// Returns the displacement of the table of a rotary axis, seen from the part that carries it.
///
/// Fixed frames after the axis belong to that part.
fn displacement(machine: &RealMachine, variable: usize, nominal: &[Link], real: &[Link]) -> Pose {
    let frame = machine.spec.variables[variable].frame;
    let fixed = machine.spec.frames[frame + 1..].iter().take_while(|next| next.variable.is_none());
    let last = frame + fixed.count();
    let with_base = product(&real[frame..=last]).then(&product(&nominal[frame + 1..=last]).inverse());
    nominal[frame].transform.inverse().then(&with_base).inverse()
}

/// Returns the direction of a rotary axis of the workpiece in its own frame, of length 1.
fn own_direction(machine: &RealMachine, variable: usize) -> Result<[f64; 3], Error> {
    let frame = machine.spec.variables[variable].frame;
    let zero = vec![0.0; machine.spec.variables.len()];
    let turned = |angle: f64| {
        let mut q = zero.clone();
        q[variable] = angle;
        Ok(machine.links(&q, &ChainErrors::none(&machine.spec))?.0[frame].transform)
    };
    let (from, to) = (turned(0.0)?, turned(1.0)?);
    let [_, _, _, a, b, c] =
        deviation(Orientation::RotationVector, &Pose::IDENTITY, &from.inverse().then(&to));
    Ok([a, b, c])
}

/// Returns the error of the angle of a rotary axis of the workpiece, as a change of its variable.
///
/// It is the rotation about the axis by the small motion `A⁻¹ Ã E` of its frame.
pub(crate) fn angle_error(machine: &RealMachine, axis: usize, q: &[f64], u: &[f64]) -> Result<f64, Error> {
    let frame = machine.spec.variables[axis].frame;
    let (nominal, _) = machine.links(q, &ChainErrors::none(&machine.spec))?;
    let (real, _) = machine.links(q, &machine.errors_at(q, u)?)?;
    let moved = nominal[frame].transform.inverse().then(&real[frame].transform).then(&real[frame].error);
    let [_, _, _, a, b, c] = deviation(Orientation::RotationVector, &Pose::IDENTITY, &moved);
    Ok(dot([a, b, c], own_direction(machine, axis)?))
}

/// Returns the difference that remains with a control that has the real poses of the rotary axes,
/// whose slides move the tool point accordingly, if its commands are corrected, too; `None` without
/// rotary axes. Poses are without the angles of the axes if tables correct these.
pub(crate) fn placed_difference(
    machine: &RealMachine,
    axes: &Axes,
    are_angles_corrected: bool,
    corrected: impl Fn(&[f64], &[f64]) -> Vec<f64>,
) -> Result<Option<PoseDifference>, Error> {
    if axes.rotary.is_empty() {
        return Ok(None);
    }
    let errors = errors_of_poses(machine, axes, are_angles_corrected)?;
    let commanded = |q: &[f64]| commanded(machine, axes, &errors, q);
    machine.command_difference(|q, u| Ok(corrected(&commanded(q)?, u))).map(Some)
}

/// Takes over the mean errors of everything before the first slide, without those of the angles of
/// the axes if tables correct these.
fn errors_of_poses(
    machine: &RealMachine,
    axes: &Axes,
    are_angles_corrected: bool,
) -> Result<ChainErrors, Error> {
    let first = axes.first_frame();
    let mut errors = ChainErrors::none(&machine.spec);
    errors.frames[..first].copy_from_slice(&machine.mean.frames[..first]);
    errors.dh_numbers[..first].copy_from_slice(&machine.mean.dh_numbers[..first]);
    for variable in &axes.rotary {
        if !are_angles_corrected {
            errors.joints[*variable] = machine.mean.joints[*variable];
            continue;
        }
        let frame = machine.spec.variables[*variable].frame;
        let direction = own_direction(machine, *variable)?;
        let [_, _, _, s, r, p] = &mut errors.frames[frame];
        // Spin about Y, roll about Z, pitch about X.
        let about = dot([*p, *s, *r], direction);
        [p, s, r].into_iter().zip(direction).for_each(|(angle, along)| *angle -= about * along);
        errors.dh_numbers[frame][0] = 0.0;
    }
    Ok(errors)
}

/// Returns the command of that control for a configuration of the nominal machine; orientations are
/// not corrected.
fn commanded(machine: &RealMachine, axes: &Axes, errors: &ChainErrors, q: &[f64]) -> Result<Vec<f64>, Error> {
    let wanted = machine.manipulator.pose(q, &machine.s)?.position();
    let (links, tool) = machine.links(q, errors)?;
    let first = axes.first_frame();
    let bed = product(&links[..first]);
    let reached = links[first..].iter().fold(bed, |pose, link| link.after(&pose)).then(&tool).position();
    let mut q = q.to_vec();
    for slide in &axes.slides {
        let along = bed.0[slide.axis];
        q[slide.variable] += (0..3).map(|k| along[k] * (wanted[k] - reached[k])).sum::<f64>();
    }
    Ok(q)
}
