//! The remainder that `ΔX ≈ J_e ε` neglects is of second order.

use super::{Configuration, Failure, Sample, Subject};
use crate::{Component, Manipulator, deviation};

/// Sizes of the errors, in rad and arm lengths.
const SIZES: [f64; 5] = [1e-3, 3e-4, 1e-4, 3e-5, 1e-5];

/// Slope of the first-order remainder that is furthest from 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Slope {
    /// Fitted `d log ‖deviation − J_e ε‖ / d log ‖ε‖`.
    pub slope: f64,
    /// Configuration at which it occurs.
    pub at: Configuration,
    /// Number of configurations fitted.
    pub fitted: usize,
    /// Number of configurations skipped because Euler rows are nearly singular there.
    pub skipped: usize,
}

impl Slope {
    /// Returns [`Failure::Slope`] if the slope is further from 2 than a tolerance.
    pub fn within(&self, tolerance: f64) -> Result<(), Failure> {
        if (self.slope - 2.0).abs() <= tolerance {
            return Ok(());
        }
        Err(Failure::Slope { slope: self.slope, at: self.at.clone() })
    }
}

/// Returns the slope with which `‖deviation − J_e ε‖` falls as ε shrinks, with all errors at once,
/// at the worst sample.
///
/// The slope is 2 if `J_e` is right and 1 if one of its columns is wrong. A chain without remainder
/// has slope 2 by definition.
pub fn remainder_slope(manipulator: &dyn Manipulator, samples: usize) -> Result<Slope, Failure> {
    let subject = Subject::new(manipulator)?;
    let (samples, skipped) = subject.samples(samples)?;
    let mut worst = Slope { slope: 2.0, at: Configuration::default(), fitted: samples.len(), skipped };
    for (i, at) in samples.iter().enumerate() {
        let slope = slope_at(&subject, at, i)?;
        if (slope - 2.0).abs() >= (worst.slope - 2.0).abs() || slope.is_nan() {
            worst.slope = if slope.is_nan() { f64::INFINITY } else { slope };
            worst.at = at.given.clone();
        }
    }
    Ok(worst)
}

fn slope_at(subject: &Subject, at: &Sample, sample: usize) -> Result<f64, Failure> {
    let description = subject.manipulator.description();
    let frames = description.frames.len();
    let mut columns = vec![[0.0; 6]; 6 * frames];
    subject
        .manipulator
        .error_jacobian(&at.given.q, &at.given.s, &mut columns)
        .map_err(|error| Failure::Evaluation { at: at.given.clone(), error })?;

    let mut points = [[0.0; 2]; SIZES.len()];
    for (point, size) in points.iter_mut().zip(SIZES) {
        let size = size * at.margin;
        let mut errors = vec![[0.0; 6]; frames];
        let mut remainder = [0.0; 6];
        for (j, column) in columns.iter().enumerate() {
            let component = Component::ALL[j % 6];
            let unit = if component.is_rotation() { 1.0 } else { subject.arm };
            let value = size * unit * direction(sample * columns.len() + j);
            errors[j / 6][component.index()] = value;
            for (remainder, entry) in remainder.iter_mut().zip(column) {
                *remainder -= entry * value;
            }
        }
        let real = subject.displaced_pose(at, &errors)?;
        let deviation = deviation(description.orientation, &at.pose, &real);
        for (remainder, entry) in remainder.iter_mut().zip(deviation) {
            *remainder += entry;
        }
        let squares = subject.scaled(remainder).map(|row| row * row);
        *point = [size.ln(), squares.iter().sum::<f64>().sqrt()];
    }
    if points.iter().all(|[_, remainder]| *remainder < 1e-14) {
        return Ok(2.0);
    }
    Ok(fitted_slope(points.map(|[size, remainder]| [size, remainder.ln()])))
}

/// Returns term `index` of a low-discrepancy sequence in (−1, 1): multiples of the golden ratio.
fn direction(index: usize) -> f64 {
    2.0 * ((index + 1) as f64 * 0.618_033_988_749_894_9).fract() - 1.0
}

/// Returns the slope of the least-squares line through the points.
fn fitted_slope<const N: usize>(points: [[f64; 2]; N]) -> f64 {
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / N as f64;
    let (x, y) = (mean(0), mean(1));
    let product = |a: &[f64; 2]| (a[0] - x) * (a[1] - y);
    let square = |a: &[f64; 2]| (a[0] - x) * (a[0] - x);
    points.iter().map(product).sum::<f64>() / points.iter().map(square).sum::<f64>()
}
