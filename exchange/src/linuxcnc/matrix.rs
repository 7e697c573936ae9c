//! Matrix of LinuxCNC's kinematics `matrixkins`: the joints X, Y and Z are a linear function of the
//! coordinates, which corrects scales and squareness.

use std::fmt::Write;

use abbe::analysis::sampling::grid;
use abbe::{Error, Manipulator};

use crate::export::slides::Axes;
use crate::export::{ExportedFile, RealMachine, product};

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
