//! Places for a target, and the information that the planned rows have with a target there.
//!
//! The displacement of a point at p by small errors `(e, ω)` of a frame is `R (e + ω × p)`, affine
//! in p. The information `M = JᵀJ` is therefore a polynomial of second degree in the three
//! coordinates of a target, and ten values determine it for all places.

use abbe::LengthUnit;
use abbe::analysis::sampling::norm;
use abbe::identify::{Failure, Measurement, Model, Observation, Unknown};
use nalgebra::DMatrix;

/// Largest distance from the planned target: a share of the arm length, and metres.
const FARTHEST: [f64; 2] = [0.1, 0.3];

/// Smallest distance, as a share of the largest.
const NEAREST: f64 = 0.05;

/// Distances within a decade.
const SERIES: [f64; 10] = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];

/// The planned rows with a target moved or added.
pub(super) struct Mounting<'a> {
    pub(super) model: Model<'a>,
    /// Planned position of the target that is moved, or of the one beside which another is added.
    pub(super) planned: [f64; 3],
    pub(super) is_additional: bool,
    rows: Vec<Observation>,
}

impl<'a> Mounting<'a> {
    /// Moves the target of a model that has only one.
    pub(super) fn moved(model: &Model<'a>, rows: &[Observation]) -> Option<Self> {
        let [planned] = model.targets[..] else { return None };
        Some(Self { model: model.clone(), planned, is_additional: false, rows: rows.to_vec() })
    }

    /// Adds a target that is measured as the first one is.
    pub(super) fn with_another(model: &Model<'a>, rows: &[Observation]) -> Option<Self> {
        let planned = *model.targets.first()?;
        let (mut model, mut rows) = (model.clone(), rows.to_vec());
        let new = model.targets.len();
        let is_unknown = model.unknowns.iter().any(|unknown| unknown.is_tool());
        model.targets.push(planned);
        if is_unknown {
            model.unknowns.extend([0, 1, 2].map(|axis| Unknown::Target(new, axis)));
        }
        let of_first: Vec<usize> = (0..model.observables.len())
            .filter(|i| !model.observables[*i].kind.is_angle && model.observables[*i].targets[0] == 0)
            .collect();
        for i in &of_first {
            let mut observable = model.observables[*i].clone();
            observable.targets = [new; 2];
            model.observables.push(observable);
        }
        for row in &mut rows {
            match &mut row.measured {
                Measurement::Points(points) => {
                    let all = points.iter().copied().chain([points.first().copied().flatten()]);
                    *points = all.collect();
                }
                Measurement::Readings(readings) => {
                    let more: Vec<_> = of_first.iter().map(|i| readings[*i]).collect();
                    readings.extend(more);
                }
                Measurement::Pose(_) => return None,
            }
        }
        Some(Self { model, planned, is_additional: true, rows })
    }

    /// Returns the information about the unknowns with the target at a displacement from the
    /// planned position.
    fn information(&self, by: [f64; 3], model_error: f64) -> Result<DMatrix<f64>, Failure> {
        let mut model = self.model.clone();
        if let Some(target) = model.targets.last_mut() {
            *target = std::array::from_fn(|i| self.planned[i] + by[i]);
        }
        model.information(&self.rows, model_error)
    }

    /// Returns the information with the target at any displacement. `step` is a typical one.
    pub(super) fn everywhere(&self, step: f64, model_error: f64) -> Result<InformationAt, Failure> {
        let at = |by: [f64; 3]| self.information(by, model_error);
        let along =
            |of: &[usize], size: f64| at(std::array::from_fn(|i| if of.contains(&i) { size } else { 0.0 }));
        let constant = at([0.0; 3])?;
        let (mut linear, mut square) = (Vec::new(), Vec::new());
        for a in 0..3 {
            let [more, less] = [along(&[a], step)?, along(&[a], -step)?];
            linear.push((&more - &less) / (2.0 * step));
            square.push((more + less - 2.0 * &constant) / (2.0 * step * step));
        }
        let mut mixed = Vec::new();
        for [a, b] in MIXED {
            let both = along(&[a, b], step)? - &constant - (&linear[a] + &linear[b]) * step;
            mixed.push(both / (step * step) - &square[a] - &square[b]);
        }
        Ok(InformationAt { constant, linear, square, mixed })
    }
}

/// Pairs of different axes.
const MIXED: [[usize; 2]; 3] = [[0, 1], [0, 2], [1, 2]];

/// Information as a polynomial in the displacement of a target.
pub(super) struct InformationAt {
    constant: DMatrix<f64>,
    linear: Vec<DMatrix<f64>>,
    square: Vec<DMatrix<f64>>,
    mixed: Vec<DMatrix<f64>>,
}

impl InformationAt {
    pub(super) fn at(&self, by: [f64; 3]) -> DMatrix<f64> {
        let mut sum = self.constant.clone();
        for (by, (linear, square)) in by.iter().zip(self.linear.iter().zip(&self.square)) {
            sum += linear * *by + square * (by * by);
        }
        for (mixed, [a, b]) in self.mixed.iter().zip(MIXED) {
            sum += mixed * (by[a] * by[b]);
        }
        sum
    }
}

/// Returns the largest distance of a place from the planned target.
pub(super) fn farthest(arm: f64, unit: LengthUnit) -> f64 {
    (FARTHEST[0] * arm).min(FARTHEST[1] / unit.in_metres())
}

/// Returns displacements up to a distance along the axes of the tool and the diagonals between
/// them, by round numbers of millimetres, the nearest first.
pub(super) fn displacements(farthest: f64, unit: LengthUnit) -> Vec<[f64; 3]> {
    let millimetre = 1e-3 / unit.in_metres();
    let first = (NEAREST * farthest / millimetre).log10().floor() as i32;
    let sizes =
        (first..first + 4).flat_map(|decade| SERIES.map(|size| size * 10f64.powi(decade) * millimetre));
    let signs = || [0.0, 1.0, -1.0].into_iter();
    let directions = || signs().flat_map(move |z| signs().flat_map(move |y| signs().map(move |x| [x, y, z])));
    let all = sizes.flat_map(|size| directions().map(move |direction| direction.map(|x| x * size)));
    let is_near = |by: &[f64; 3]| (NEAREST * farthest..=farthest).contains(&norm(*by));
    let mut all: Vec<[f64; 3]> = all.filter(is_near).collect();
    all.sort_by(|a, b| norm(*a).total_cmp(&norm(*b)));
    all
}

/// Returns whether a place is in the body of the tool: near the line from the planned target to the
/// flange.
pub(super) fn is_in_tool(by: [f64; 3], planned: [f64; 3], flange: [f64; 3]) -> bool {
    /// Smallest distance from that line, as a share of the displacement.
    const BESIDE: f64 = 0.5;
    let line: [f64; 3] = std::array::from_fn(|i| flange[i] - planned[i]);
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
    let square = dot(line, line);
    let along = if square > 0.0 { (dot(by, line) / square).clamp(0.0, 1.0) } else { 0.0 };
    norm(std::array::from_fn(|i| by[i] - along * line[i])) < BESIDE * norm(by)
}
