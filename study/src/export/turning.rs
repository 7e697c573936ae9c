//! Axes that turn the workpiece of a machine tool: no table of its slides holds them, but controls are told where they stand.
//!
//! From the workpiece on, `A_i E_i` takes what carries axis i to what it turns, so what carries it finds it displaced by `E_i⁻¹`. What
//! stands still behind it, `A_k E_k` with no variable, belongs to where it stands.

use abbe::{Error, Manipulator, Orientation, Pose, deviation};
use serde::Serialize;

use super::difference::Difference;
use super::found::{Errors, Found, Link};
use super::slides::Slide;
use crate::number::digits;

/// Where an axis really stands that turns the workpiece, in the mean over the workspace, from where it should stand.
#[derive(Clone, Debug, Serialize)]
pub struct Turning {
    /// Its variable.
    pub variable: String,
    /// The origin of its frame along X, Y and Z of what carries it, in the spec's length unit.
    pub position: [f64; 3],
    /// Its turn about these, in rad; about the axis itself it is its zero.
    pub angles: [f64; 3],
}

impl Turning {
    /// The axes of these variables, with axes as they are where all variables are 0.
    pub(super) fn all(found: &Found, variables: &[usize]) -> Result<Vec<Self>, Error> {
        let zero = vec![0.0; found.spec.variables.len()];
        let (nominal, _) = found.links(&zero, &Errors::none(&found.spec))?;
        let (real, _) = found.links(&zero, &found.mean)?;
        let axis = |variable: &usize| {
            let (name, frame) =
                (&found.spec.variables[*variable].name, found.spec.variables[*variable].frame);
            let still = found.spec.frames[frame + 1..].iter().take_while(|next| next.variable.is_none());
            let last = frame + still.count();
            let up_to = |links: &[Link]| links.iter().fold(Pose::IDENTITY, |pose, link| behind(&pose, link));
            let behind_it = up_to(&real[frame..=last]).then(&up_to(&nominal[frame + 1..=last]).inverse());
            let moved = nominal[frame].transform.inverse().then(&behind_it);
            let [x, y, z, a, b, c] =
                deviation(Orientation::RotationVector, &Pose::IDENTITY, &moved.inverse());
            let turned = up_to(&nominal[..=frame]);
            Self { variable: name.clone(), position: turned.turn([x, y, z]), angles: turned.turn([a, b, c]) }
        };
        Ok(variables.iter().map(axis).collect())
    }

    /// What a control is told of it, in mm and mrad.
    pub(super) fn sentence(&self, mm: f64) -> String {
        // To a tenth of a micrometre, or of a microradian.
        let numbers = |values: [f64; 3], names: [&str; 3], factor: f64| {
            let rounded = |value: f64| (value * factor * 1e4).round() / 1e4 + 0.0;
            let one = |(name, value): (&str, f64)| format!("{name} {}", digits(rounded(value), 4));
            names.into_iter().zip(values).map(one).collect::<Vec<_>>().join(", ")
        };
        format!(
            "`{}` turns the workpiece and is in no table. Where it stands belongs in the kinematics of the control, which has numbers for that: seen \
             from what carries it, and in the mean, it is displaced by {} mm and turned by {} mrad.",
            self.variable,
            numbers(self.position, ["X", "Y", "Z"], mm),
            numbers(self.angles, ["A", "B", "C"], 1e3)
        )
    }
}

fn behind(pose: &Pose, link: &Link) -> Pose {
    pose.then(&link.transform).then(&link.error)
}

/// The frame of the first slide.
fn first(slides: &[Slide]) -> usize {
    slides.first().map_or(0, |slide| slide.frame)
}

/// A control that knows where the axes stand that turn the workpiece: the slides bring the tool point where it should be by that.
pub(super) struct Kinematics<'a> {
    found: &'a Found,
    slides: &'a [Slide],
    turning: &'a [usize],
    errors: Errors,
}

impl<'a> Kinematics<'a> {
    /// With the means of all errors before the first slide.
    pub(super) fn new(found: &'a Found, slides: &'a [Slide], turning: &'a [usize]) -> Self {
        let first = first(slides);
        let mut errors = Errors::none(&found.spec);
        errors.frames[..first].copy_from_slice(&found.mean.frames[..first]);
        errors.numbers[..first].copy_from_slice(&found.mean.numbers[..first]);
        turning.iter().for_each(|variable| errors.joints[*variable] = found.mean.joints[*variable]);
        Self { found, slides, turning, errors }
    }

    /// What remains when its commands are then corrected; nothing else remains where nothing turns.
    pub(super) fn remains(
        &self,
        corrected: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Result<Option<Difference>, Error> {
        if self.turning.is_empty() {
            return Ok(None);
        }
        self.found.of_commands(|q| Ok(corrected(&self.commanded(q)?))).map(Some)
    }

    /// What it commands for a configuration of the ideal machine: of orientations it corrects nothing.
    pub(super) fn commanded(&self, q: &[f64]) -> Result<Vec<f64>, Error> {
        let wanted = self.found.manipulator.pose(q, &self.found.s)?.position();
        let (links, tool) = self.found.links(q, &self.errors)?;
        let first = first(self.slides);
        let bed = links[..first].iter().fold(Pose::IDENTITY, |pose, link| behind(&pose, link));
        let reached =
            links[first..].iter().fold(bed, |pose, link| behind(&pose, link)).then(&tool).position();
        let mut q = q.to_vec();
        for slide in self.slides {
            let along = bed.0[slide.axis];
            q[slide.variable] += (0..3).map(|k| along[k] * (wanted[k] - reached[k])).sum::<f64>();
        }
        Ok(q)
    }
}
