//! Prior of the unknowns of a fit, and the basis in which the errors of the machine are fitted.
//!
//! What no configuration shows once base and tool are set up anew is not fitted: with the
//! derivatives of whole poses at configurations within the joint limits, an error that is a
//! combination of errors of base and tool and of errors preferred to it is left out. The unknowns
//! of the fit are `x = R θ`, where R adds to each kept error those left out that act as it in every
//! configuration. With standard deviations `Σ^½` of θ, the covariance of x is `R Σ Rᵀ = Uᵀ U`, with
//! `Σ^½ Rᵀ = Q U`, and `W x` with `W = U⁻ᵀ` has independent components with variance 1.

use abbe_analysis::{Workspace, joint_samples};
use abbe_core::{Component, Pose};
use nalgebra::DMatrix;

use super::identifiable::{Columns, by_preference};
use super::{
    Failure, Measurement, Model, Observation, Problem, Result, Solver, Station, Uncertainty, Unknown, Values,
};

/// Number of configurations at which poses are compared.
const CONFIGURATIONS: usize = 60;

/// Standard deviation of an unknown without a prior, as a multiple of that which changes a number
/// by its uncertainty.
const FLAT: f64 = 1e6;

/// Unknowns of a fit with a prior, and the equivalents of the others.
pub(super) struct Basis {
    /// Indices of the unknowns, ascending.
    pub(super) kept: Vec<usize>,
    /// Unknowns left out, each as a combination of kept ones.
    pub(super) redundant: Vec<(usize, Vec<(usize, f64)>)>,
    /// `Σ^½ Rᵀ`: a row for each unknown, kept ones first.
    root: DMatrix<f64>,
}

impl Basis {
    /// Finds the basis for unknowns with these standard deviations, flat where there is none.
    /// `seen` are the derivatives of the data at `x`.
    pub(super) fn new(
        model: &Model,
        data: &[Observation],
        x: &[f64],
        seen: &Columns,
        deviations: &[Option<f64>],
    ) -> Result<Self> {
        let is_placement = |k: &usize| model.unknowns[*k].is_placement();
        // A place that does not move a number as far as it is uncertain stays as stated: only terms
        // of second order tell where it is.
        let is_shown = |k: &usize| {
            let deviation = deviations.get(*k).copied().flatten();
            deviation.is_none_or(|deviation| seen.lengths[*k] * deviation > 1.0)
        };
        let (places, errors): (Vec<usize>, Vec<usize>) = (0..model.unknowns.len()).partition(is_placement);
        let places: Vec<usize> = places.into_iter().filter(is_shown).collect();
        let of = |these: &[usize]| model.with(these.iter().map(|k| model.unknowns[*k]).collect());
        // Places, as these instruments would see them in other configurations.
        let others = Columns::of_rows(model, &elsewhere(model, data)?, x)?;
        let joined = |these: &[usize]| seen.joined(&others, these).ok_or_else(|| Failure::not_finite(data));
        let columns = joined(&places)?;
        let shown = columns.kept(&[&by_preference(&of(&places))]);
        let mut redundant = equivalents(&columns, &shown, &places);
        let places: Vec<usize> = shown.iter().map(|k| places[*k]).collect();
        let mut kept = places.clone();
        if !errors.is_empty() {
            let (columns, anew) = poses(&of(&errors), model, data)?;
            let order: Vec<usize> = by_preference(&of(&errors)).into_iter().map(|k| k + anew).collect();
            let shown = columns.kept(&[&(0..anew).collect::<Vec<_>>(), &order]);
            let indices: Vec<usize> =
                vec![usize::MAX; anew].into_iter().chain(errors.iter().copied()).collect();
            kept.extend(shown.iter().map(|k| indices[*k]).filter(|k| *k < usize::MAX));
            // What these data show beside it, such as the tilt of a machine on instruments of known
            // direction.
            let beside = seen.beside(&kept, order.iter().map(|k| indices[*k]));
            let basis = [&places[..], &beside].concat();
            kept.extend(beside);
            let all = joined(&(0..model.unknowns.len()).collect::<Vec<_>>())?;
            let of_machine = equivalents(&columns, &shown, &indices).into_iter();
            for (k, mut acts_as) in of_machine.filter(|(k, _)| *k < usize::MAX && !kept.contains(k)) {
                acts_as.extend(all.rest_as(k, &acts_as, &basis));
                redundant.push((k, acts_as));
            }
        }
        kept.sort_unstable();
        let numbers = data.iter().map(Observation::count).sum::<usize>().max(1) as f64;
        let deviation = |k: usize| {
            let length = seen.lengths[k];
            let flat = if length > 0.0 { FLAT * numbers.sqrt() / length } else { 1.0 };
            deviations.get(k).copied().flatten().unwrap_or(flat)
        };
        let mut root = DMatrix::zeros(kept.len() + redundant.len(), kept.len());
        kept.iter().enumerate().for_each(|(i, k)| root[(i, i)] = deviation(*k));
        for (i, (k, acts_as)) in redundant.iter().enumerate() {
            for (j, factor) in acts_as {
                let Ok(j) = kept.binary_search(j) else { continue };
                root[(kept.len() + i, j)] = factor * deviation(*k);
            }
        }
        Ok(Self { kept, redundant, root })
    }

    /// Returns W with the standard deviations of these unknowns multiplied by a scale.
    pub(super) fn rows(&self, scaled: &[usize], scale: f64) -> DMatrix<f64> {
        let (mut root, count) = (self.root.clone(), self.kept.len());
        let all = self.kept.iter().chain(self.redundant.iter().map(|(k, _)| k));
        root.row_iter_mut()
            .zip(all)
            .filter(|(_, k)| scaled.contains(k))
            .for_each(|(mut row, _)| row *= scale);
        let upper = root.qr().unpack_r();
        let rows = upper.transpose().solve_lower_triangular(&DMatrix::identity(count, count));
        rows.unwrap_or_else(|| DMatrix::zeros(0, count))
    }
}

/// Returns the columns that are not kept as combinations of kept ones, all by these indices,
/// without those of what is set up anew.
fn equivalents(columns: &Columns, kept: &[usize], indices: &[usize]) -> Vec<(usize, Vec<(usize, f64)>)> {
    let indexed = |(k, acts_as): (usize, Vec<(usize, f64)>)| {
        let acts_as = acts_as.into_iter().map(|(j, factor)| (indices[j], factor));
        (indices[k], acts_as.filter(|(j, _)| *j < usize::MAX).collect())
    };
    columns.redundant(kept).into_iter().map(indexed).collect()
}

/// Returns rows like those of the data at configurations within the joint limits, as the model
/// measures them without errors; none of a camera, which does not see its board everywhere.
fn elsewhere(model: &Model, data: &[Observation]) -> Result<Vec<Observation>> {
    let moved: Vec<usize> = (0..model.manipulator.description().variables.len()).collect();
    let samples = joint_samples(model.manipulator, &moved, CONFIGURATIONS).map_err(Failure::Machine)?;
    let step = data.len().div_ceil(CONFIGURATIONS).max(1);
    let mut at = model.at(&vec![0.0; model.unknowns.len()]);
    let samples = samples.reached().into_iter().filter(|_| model.camera.is_none());
    let samples = samples.map(|sample| Values::from_slice(&sample.q));
    let mut before: Option<Values> = None;
    let rows = samples.zip(data.iter().step_by(step).cycle()).filter_map(|(q, row)| {
        let mut row = Observation { q, ..row.clone() };
        if let Some(from) = row.approach.as_mut().and_then(|approach| approach.from.as_mut()) {
            from.q = before.replace(row.q.clone())?;
        }
        // Expressions and tables need not be defined at every sample.
        let row = at.nominally_seen(&row).ok()?;
        let mut is_finite = true;
        at.linear(&row, |_, derivatives| is_finite &= derivatives.iter().all(|value| value.is_finite()))
            .ok()?;
        is_finite.then_some(row)
    });
    Ok(rows.collect())
}

/// Returns the derivatives of whole poses, in sizes of the machine and rad, with respect to what is
/// set up anew, followed by the unknowns of `errors`; and the number of the former.
fn poses(errors: &Model, model: &Model, data: &[Observation]) -> Result<(Columns, usize)> {
    let is_any = |is: fn(&Unknown) -> bool| model.unknowns.iter().any(is);
    let base = is_any(|unknown| matches!(unknown, Unknown::Base(..) | Unknown::Fixture(..)));
    let base = Component::ALL.into_iter().filter(|_| base).map(|component| Unknown::Base(0, component));
    let tool = is_any(|unknown| unknown.is_tool());
    let tool = Component::ALL.into_iter().filter(|_| tool).map(|component| Unknown::Tool(0, component));
    let anew: Vec<Unknown> = base.chain(tool).collect();
    let count = anew.len();
    let seen = Model {
        stations: vec![Station::at(Pose::IDENTITY)],
        targets: Vec::new(),
        mountings: vec![Pose::IDENTITY],
        fixtures: Vec::new(),
        known_distances: Vec::new(),
        observables: Vec::new(),
        camera: None,
        reference_length: None,
        uncertainty: Uncertainty { length: model.arm_length()?, angle: 1.0 },
        ..errors.with(anew.into_iter().chain(errors.unknowns.iter().copied()).collect())
    };
    let measured = || Measurement::Pose(Box::new(Pose::IDENTITY));
    let rows = data.iter().step_by(data.len().div_ceil(CONFIGURATIONS).max(1));
    let rows =
        rows.map(|row| Observation { station: 0, measured: measured(), approach: None, ..row.clone() });
    let rows = elsewhere(&seen, &rows.collect::<Vec<_>>())?;
    Ok((Columns::of_rows(&seen, &rows, &vec![0.0; seen.unknowns.len()])?, count))
}

/// Standard deviation d of `ln s` of the scale s before the data; its mean is −d², so that s² is 1
/// in the mean.
const SPREAD: f64 = 1.5;

/// Largest error that is expected, in prior standard deviations: a few errors can be much larger
/// than all others.
const LARGEST: f64 = 2.0;

/// Standard deviations from zero from which an error is certain.
const CERTAIN: f64 = 5.0;

/// Largest `|ln s|`, and the number of scales at which the likelihood is evaluated.
const SCALES: (f64, usize) = (6.0, 61);

impl Solver<'_> {
    /// Chooses the scale s of the prior of these unknowns by the data: the root mean square of s,
    /// whose square scales the variance, under the likelihood and a log-normal prior, or half of
    /// the largest error that is certain.
    ///
    /// With `J x = y` in units of this noise, `P = WᵀW` for the scale s, and `N = JᵀJ`,
    /// `−2 ln p(y | s) = ln |N + P| − ln |P| + min_x (‖J x − y‖² + ‖W x‖²)`.
    pub(super) fn scale_of_prior(&self, basis: &Basis, scaled: &[usize]) -> f64 {
        let (p, noise) = (self.x.len(), self.noise());
        let j = self.data_alone.columns(0, p) / noise;
        let y = (self.data_alone.column(p) / noise) + &j * &self.x;
        let likelihood = |log: f64| {
            let w = basis.rows(scaled, log.exp());
            let mut stack = DMatrix::zeros(j.nrows() + w.nrows(), p + 1);
            stack.view_mut((0, 0), j.shape()).copy_from(&j);
            stack.view_mut((0, p), (y.len(), 1)).copy_from(&y);
            stack.view_mut((j.nrows(), 0), w.shape()).copy_from(&w);
            let Problem { a, b } = Problem::from_triangle(stack);
            let logs = |of: &DMatrix<f64>| (0..p).map(|i| of[(i, i)].abs().ln()).sum::<f64>();
            let left = b.rows(p.min(b.len()), b.len().saturating_sub(p)).norm_squared();
            logs(&w) - logs(&a) - 0.5 * (left + (log / SPREAD + SPREAD).powi(2))
        };
        let (end, count) = SCALES;
        let logs: Vec<f64> = (0..count).map(|i| end * (2.0 * i as f64 / (count - 1) as f64 - 1.0)).collect();
        let all: Vec<f64> = logs.iter().map(|log| likelihood(*log)).collect();
        let most = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let weights = all.iter().map(|value| (value - most).exp());
        let (sum, mean) = logs
            .iter()
            .zip(weights)
            .fold((0.0, 0.0), |(sum, mean), (log, weight)| (sum + weight, mean + weight * (2.0 * log).exp()));
        let scale = f64::sqrt(mean / sum);
        if scale.is_finite() { scale.max(self.largest(basis, scaled, noise) / LARGEST) } else { 1.0 }
    }

    /// Returns the largest of these unknowns that is certain, in its prior standard deviations.
    fn largest(&self, basis: &Basis, scaled: &[usize], noise: f64) -> f64 {
        let Some(half) = self.problem.half() else { return 0.0 };
        let size = |i: usize| {
            let x = self.x[i].abs();
            let is_certain = x > CERTAIN * noise * half.row(i).norm();
            if is_certain { x / basis.root.column(i).norm() } else { 0.0 }
        };
        (0..self.x.len()).filter(|i| scaled.contains(&basis.kept[*i])).map(size).fold(0.0, f64::max)
    }
}
