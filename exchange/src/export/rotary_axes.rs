//! Rotary axes that carry the workpiece of a machine tool. Tables of slides do not hold them; the
//! kinematics of the control does.
//!
//! The chain starts at the workpiece, so `A_i E_i` leads from the table of axis i, which is `F_0`
//! or the next table, to its base. Seen from the base the axis is displaced by `E_i⁻¹`. Fixed
//! frames after the axis, `A_k E_k` without a variable, belong to the base.

use abbe::{Error, Manipulator, Orientation, Pose, deviation};
use abbe_spec::number::digits;
use serde::Serialize;

use super::chain_errors::{ChainErrors, product};
use super::pose_difference::PoseDifference;
use super::real_machine::RealMachine;
use super::slides::Axes;

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
            let fixed = machine.spec.frames[frame + 1..].iter().take_while(|next| next.variable.is_none());
            let last = frame + fixed.count();
            let with_base = product(&real[frame..=last]).then(&product(&nominal[frame + 1..=last]).inverse());
            let moved = nominal[frame].transform.inverse().then(&with_base);
            let [x, y, z, a, b, c] =
                deviation(Orientation::RotationVector, &Pose::IDENTITY, &moved.inverse());
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
            "The rotary axis `{}` of the workpiece has no table. Enter its pose in the kinematic \
             parameters of the control: relative to the part that carries it, it is displaced by \
             {} mm and rotated by {} mrad on average.",
            self.variable,
            numbers(self.position, ["X", "Y", "Z"], mm),
            numbers(self.angles, ["A", "B", "C"], 1e3)
        )
    }
}

/// Kinematics of a control that has the real poses of the rotary axes: its slides move the tool
/// point accordingly.
pub(crate) struct Kinematics<'a> {
    machine: &'a RealMachine,
    axes: &'a Axes,
    /// Mean errors of everything before the first slide.
    errors: ChainErrors,
}

impl<'a> Kinematics<'a> {
    /// Takes over the mean errors of everything before the first slide.
    pub(crate) fn new(machine: &'a RealMachine, axes: &'a Axes) -> Self {
        let first = axes.first_frame();
        let mut errors = ChainErrors::none(&machine.spec);
        errors.frames[..first].copy_from_slice(&machine.mean.frames[..first]);
        errors.dh_numbers[..first].copy_from_slice(&machine.mean.dh_numbers[..first]);
        axes.rotary.iter().for_each(|variable| errors.joints[*variable] = machine.mean.joints[*variable]);
        Self { machine, axes, errors }
    }

    /// Returns the difference that remains if its commands are corrected, too; `None` without
    /// rotary axes.
    pub(crate) fn remains(
        &self,
        corrected: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Result<Option<PoseDifference>, Error> {
        if self.axes.rotary.is_empty() {
            return Ok(None);
        }
        self.machine.command_difference(|q| Ok(corrected(&self.commanded(q)?))).map(Some)
    }

    /// Returns the command for a configuration of the nominal machine; orientations are not
    /// corrected.
    fn commanded(&self, q: &[f64]) -> Result<Vec<f64>, Error> {
        let wanted = self.machine.manipulator.pose(q, &self.machine.s)?.position();
        let (links, tool) = self.machine.links(q, &self.errors)?;
        let first = self.axes.first_frame();
        let bed = product(&links[..first]);
        let reached = links[first..].iter().fold(bed, |pose, link| link.after(&pose)).then(&tool).position();
        let mut q = q.to_vec();
        for slide in &self.axes.slides {
            let along = bed.0[slide.axis];
            q[slide.variable] += (0..3).map(|k| along[k] * (wanted[k] - reached[k])).sum::<f64>();
        }
        Ok(q)
    }
}
