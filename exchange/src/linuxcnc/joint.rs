//! Joint of LinuxCNC with a compensation file.
//!
//! Matrix of LinuxCNC's kinematics `matrixkins`: the joints X, Y and Z are a linear function of the
//! coordinates, which corrects scales and squareness.

use std::fmt::Write;

use abbe::{Error, Manipulator, VariableKind, analysis::sampling::grid};
use abbe_spec::number::digits;

use crate::export::rotary_axes::angle_error;
use crate::export::slides::{Axes, interpolated};
use crate::export::{ExportedFile, RealMachine, product};

/// Joint with a file.
pub(super) struct CompensatedJoint {
    pub(super) variable: usize,
    /// Index among the slides; none for a rotary axis.
    pub(super) slide: Option<usize>,
    /// Letter of a slide, name of the variable of a rotary axis.
    pub(super) name: String,
    range: [f64; 2],
    /// Correction by the matrix along itself, per length.
    slope: f64,
    pub(super) home: f64,
    /// Unit of the variable in mm or degrees.
    pub(super) factor: f64,
    /// Inputs that give its direction of approach.
    pub(super) directions: Vec<usize>,
}

impl CompensatedJoint {
    /// Returns the joint of a machine that has a matrix, whose file holds what that leaves.
    pub(super) fn after(self, matrix: &CalibrationMatrix, axes: &Axes) -> Self {
        let slope = self.slide.map(|k| axes.slides[k].axis).map_or(0.0, |axis| matrix.slope(axis, axis));
        Self { slope, ..self }
    }

    /// Returns the slides, then the rotary axes with limits.
    pub(super) fn all(machine: &RealMachine, axes: &Axes) -> Vec<Self> {
        let joint = |variable: usize, slide: Option<usize>, name: String| {
            let one = &machine.spec.variables[variable];
            let factor = match one.kind {
                VariableKind::Prismatic => machine.spec.length.in_metres() * 1e3,
                VariableKind::Revolute => 1_f64.to_degrees(),
            };
            let directions = machine.directions(variable);
            Self { variable, slide, name, range: one.limits, home: one.home, slope: 0.0, factor, directions }
        };
        let slides = axes.slides.iter().enumerate();
        let slides = slides.map(|(k, slide)| joint(slide.variable, Some(k), slide.letter().to_string()));
        let rotary = axes
            .rotary
            .iter()
            .map(|variable| joint(*variable, None, machine.spec.variables[*variable].name.clone()));
        slides.chain(rotary).filter(|joint| joint.range.iter().all(|end| end.is_finite())).collect()
    }

    pub(super) fn file(&self) -> String {
        format!("{}.comp", self.name.to_lowercase())
    }

    /// Returns the lines of the file, in mm or degrees. Trims are 0 at home, as the mean of both
    /// directions.
    pub(super) fn lines(
        &self,
        machine: &RealMachine,
        axes: &Axes,
        nodes: usize,
    ) -> Result<Vec<[f64; 3]>, Error> {
        let values = abbe::analysis::sampling::grid(self.range, nodes);
        let errors: Result<Vec<[f64; 2]>, Error> =
            values.iter().map(|value| self.errors(machine, axes, *value)).collect();
        let errors = errors?;
        let [forward, reverse] = interpolated(&values, &errors, self.home);
        let at_home = (forward + reverse) / 2.0;
        let line = |(value, errors): (&f64, &[f64; 2])| {
            let [forward, reverse] = errors.map(|error| (value + error - at_home) * self.factor);
            [value * self.factor, forward, reverse]
        };
        Ok(values.iter().zip(&errors).map(line).collect())
    }

    /// Returns the error at home, the mean of both directions, in the unit of the variable.
    pub(super) fn error_at_home(&self, machine: &RealMachine, axes: &Axes) -> Result<f64, Error> {
        let [forward, reverse] = self.errors(machine, axes, self.home)?;
        Ok((forward + reverse) / 2.0)
    }

    /// Returns the errors at `value`, approached from below and from above: of a slide that of the
    /// tool point along it, with the other slides at home and rotary axes at 0, after the matrix.
    fn errors(&self, machine: &RealMachine, axes: &Axes, value: f64) -> Result<[f64; 2], Error> {
        let mut errors = [0.0; 2];
        for (error, side) in errors.iter_mut().zip([1.0, -1.0]) {
            let (q, mut u) = match self.slide {
                Some(k) => axes.at(machine, k, value),
                None => machine.at_home(self.variable, value),
            };
            self.directions.iter().for_each(|input| u[*input] = side);
            *error = match self.slide {
                Some(k) => {
                    let (links, tool) = machine.links(&q, &axes.errors(machine, &q, &u)?)?;
                    let real = product(&links).then(&tool);
                    let ideal = machine.manipulator.pose(&q, &machine.s)?;
                    let axis = axes.slides[k].axis;
                    let corrected = self.slope * (value - self.home);
                    real.position()[axis] - ideal.position()[axis] + corrected
                }
                None => angle_error(machine, self.variable, &q, &u)?,
            };
        }
        Ok(errors)
    }

    pub(super) fn unit(&self) -> &'static str {
        if self.slide.is_some() { "mm" } else { "deg" }
    }

    /// Returns the sentence about the sign: an actual position of the joint.
    pub(super) fn sentence(&self, nominal: f64, actual: f64) -> String {
        let unit = self.unit();
        format!(
            "The files hold actual positions: at the command {} = {} {unit} the axis is at {} \
             {unit}, and LinuxCNC adds nominal minus actual, {} {unit}, to the command.",
            self.name,
            digits(nominal, 6),
            digits(actual, 8),
            digits(nominal - actual, 4)
        )
    }
}

/// Values of each slide at which errors are fitted.
const NODES: usize = 7;

/// Linear part of the correction of three slides: joints X, Y, Z by coordinates X, Y, Z.
#[derive(Clone, Copy, Debug)]
pub(super) struct CalibrationMatrix([[f64; 3]; 3]);

impl CalibrationMatrix {
    /// Fits minus the errors of the tool point by least squares over a grid of the slides, with a
    /// constant that the origin takes. `directions` are averaged over both values.
    ///
    /// On a full grid the coordinates are not correlated: each slope is a regression of its own.
    pub(super) fn fit(machine: &RealMachine, axes: &Axes, directions: &[usize]) -> Result<Self, Error> {
        let nodes: Vec<Vec<f64>> = axes.slides.iter().map(|slide| grid(slide.range, NODES)).collect();
        let middle: Vec<f64> = nodes.iter().map(|nodes| nodes.iter().sum::<f64>() / NODES as f64).collect();
        let (mut slopes, mut squares) = ([[0.0; 3]; 3], [0.0; 3]);
        for node in 0..NODES.pow(axes.slides.len() as u32) {
            let (mut q, u) = axes.at(machine, 0, axes.slides[0].range[0]);
            let mut at = [0.0; 3];
            for (k, slide) in axes.slides.iter().enumerate() {
                let value = nodes[k][node / NODES.pow(k as u32) % NODES];
                q[slide.variable] = value;
                at[slide.axis] = value - middle[k];
            }
            let ideal = machine.manipulator.pose(&q, &machine.s)?.position();
            for side in [1.0, -1.0] {
                let mut u = u.clone();
                directions.iter().for_each(|input| u[*input] = side);
                let (links, tool) = machine.links(&q, &axes.errors(machine, &q, &u)?)?;
                let real = product(&links).then(&tool).position();
                for (j, at) in at.into_iter().enumerate() {
                    squares[j] += at * at;
                    (0..3).for_each(|i| slopes[i][j] -= at * (real[i] - ideal[i]));
                }
            }
        }
        // A direction without a slide is not corrected.
        let has = |axis: usize| axes.slides.iter().any(|slide| slide.axis == axis);
        let slope = |i: usize, j: usize| if has(i) && has(j) { slopes[i][j] / squares[j] } else { 0.0 };
        Ok(Self([0, 1, 2].map(|i| [0, 1, 2].map(|j| slope(i, j)))))
    }

    /// Returns the correction of joint `i` by a distance along `j`, per length.
    pub(super) fn slope(&self, i: usize, j: usize) -> f64 {
        self.0[i][j]
    }

    /// Writes the commands that set the matrix in a HAL file.
    pub(super) fn file(&self, name: &str) -> ExportedFile {
        let mut text = format!("# {name}: for KINEMATICS = matrixkins\n");
        for (i, joint) in ["x", "y", "z"].into_iter().enumerate() {
            for (j, axis) in ["x", "y", "z"].into_iter().enumerate() {
                let _ = writeln!(text, "setp matrixkins.C_{joint}{axis} {:.12}", self.element(i, j));
            }
        }
        ExportedFile { name: "matrixkins.hal".to_owned(), text }
    }

    fn element(&self, i: usize, j: usize) -> f64 {
        f64::from(u8::from(i == j)) + self.0[i][j] + 0.0
    }
}
