//! Covariance of the errors of the identified machine, relative to base and target.
//!
//! A fit has combinations `x = R θ` of the unknowns θ, where R adds to each kept error those that
//! act as it in every configuration, with the posterior covariance C: noise, and where the data say
//! little, the prior. Numbers of the chain replace some kept unknowns by `v = F x`; the columns of
//! W are the errors of the written values. The written machine differs from the real one by `W F
//! (x̂ − x)`, of which `W F C^½` are the parts.
//!
//! What no configuration shows once base and target are set up anew is no error of the machine.
//! With the effects G of the errors on the measured points in the fitted rows, and those B of the
//! errors of `F_0` and of the last frame that are set up anew, the parts D lose `B⁺ G D`: base and
//! target are where these rows place them. With the effects H on a frame at the flange within the
//! joint limits and `(H D)ᵀ H D = V Λ Vᵀ`, the columns `D V` of a positive Λ are left.

use abbe::analysis::decompose::symmetric_eigen;
use abbe::analysis::{Workspace, joint_samples};
use abbe::identify::{Failure, Measurement, Model, Observation, Unknown};
use abbe::{Component, Error, Pose, Quantity};
use nalgebra::{DMatrix, RowDVector, SymmetricEigen};

use super::fitted::{fitted_mountings, fitted_targets};
use super::{AsJointErrors, Setup, Solved, unknowns_of};

/// Number of configurations at which effects are evaluated.
const SAMPLES: usize = 100;

/// Smallest effect of a motion of base and target in the fitted rows, as a share of the largest.
const SEEN: f64 = 1e-4;

/// Smallest effect of a part, as a share of the largest effect of one unknown.
const NO_EFFECT: f64 = 1e-6;

/// Smallest entry of a part, as a share of the largest effect of an entry in it.
const ROUNDING: f64 = 1e-9;

/// Failure of a decomposition.
const NOT_FINITE: Failure = Failure::Machine(Error::NotFinite { quantity: Quantity::Jacobian, index: 0 });

/// Covariance of errors of the machine, as independent parts.
#[derive(Clone, Debug, Default)]
pub(super) struct FoundCovariance {
    /// Quantities of the rows.
    pub(super) of: Vec<Uncertain>,
    /// Standard deviations of each part, in columns.
    parts: Vec<Vec<f64>>,
}

/// Quantity of a row.
#[derive(Clone, Copy, Debug)]
pub(super) enum Uncertain {
    /// An error of `F_0`.
    Base(Component),
    /// An error of a frame, numbered from 0.
    Error(usize, Component),
    /// A magnitude that was fitted, by its index among the kept unknowns.
    Fitted(usize),
}

impl FoundCovariance {
    pub(super) fn new(
        setup: &Setup,
        solved: &Solved,
        joint_errors: Option<&AsJointErrors>,
        data: &[Observation],
    ) -> Result<Self, Failure> {
        let model = &solved.model;
        if solved.fit.identifiable.kept.is_empty() {
            return Ok(Self::default());
        }
        let base = Component::ALL.map(|component| Unknown::Base(0, component));
        let of_machine = |unknown: &Unknown| matches!(unknown, Unknown::Error(..) | Unknown::Magnitude(_));
        let rows: Vec<Unknown> =
            base.into_iter().chain(model.unknowns.iter().copied().filter(of_machine)).collect();
        let of_unknowns = parts(solved, joint_errors)?;
        let mut parts = DMatrix::zeros(rows.len(), of_unknowns.ncols());
        for (i, row) in rows.iter().enumerate().skip(base.len()) {
            let k = model.unknowns.iter().position(|unknown| unknown == row).unwrap_or_default();
            parts.set_row(i, &of_unknowns.row(k));
        }
        let spread = |[x, y, z]: [f64; 3]| [[x, y, z], [x + setup.arm, y, z], [x, y + setup.arm, z]];
        let measured = match setup.pose {
            true => fitted_mountings(model, &solved.fit.x)
                .iter()
                .flat_map(|pose| spread(pose.position()))
                .collect(),
            false => model.mounted(&fitted_targets(model, &solved.fit.x)),
        };
        let step = data.len().div_ceil(SAMPLES).max(1);
        let fitted: Vec<Observation> = data.iter().step_by(step).cloned().collect();
        let all: Vec<usize> = (0..setup.description.variables.len()).collect();
        let samples = joint_samples(model.manipulator, &all, SAMPLES).map_err(Failure::Machine)?.reached();
        let nothing = || Measurement::Points(Vec::new().into());
        let samples = samples.into_iter().map(|sample| Observation::new(0, sample.q, sample.u, nothing()));
        let samples: Vec<Observation> = samples.collect();
        let effects = |points: &[[f64; 3]], at: &[Observation]| effects(&setup.ideal, &rows, points, at);
        let last = setup.description.frames.len() - 1;
        // Instruments at unknown places are set up anew with the base.
        let stands = |unknown: &Unknown| matches!(unknown, Unknown::Base(..) | Unknown::Fixture(..));
        let is_base_anew = model.unknowns.iter().any(stands);
        let is_anew = |unknown: Unknown| match unknown {
            Unknown::Base(..) => is_base_anew,
            Unknown::Error(frame, _) => frame == last && !setup.placement,
            _ => false,
        };
        let anew: Vec<usize> = (0..rows.len()).filter(|i| is_anew(rows[*i])).collect();
        without_setups(&effects(&measured, &fitted), &anew, &mut parts);
        let effects = effects(&spread([0.0; 3]), &samples);
        let parts = with_effect(&effects, &parts)?;
        // Entries without an effect are rounding errors.
        let size = |k: usize| effects.column(k).norm();
        let largest =
            |part: usize| (0..rows.len()).map(|k| (parts[(k, part)] * size(k)).abs()).fold(0.0, f64::max);
        let least: Vec<f64> = (0..parts.ncols()).map(|i| ROUNDING * largest(i)).collect();
        let occurs = |k: &usize| (0..least.len()).any(|i| (parts[(*k, i)] * size(*k)).abs() > least[i]);
        let used = (0..rows.len()).filter(occurs);
        let row = |k: usize| Some((Uncertain::new(solved, rows[k])?, parts.row(k).iter().copied().collect()));
        let (of, parts) = used.filter_map(row).unzip();
        Ok(Self { of, parts })
    }

    /// Returns the covariance of two rows.
    pub(super) fn between(&self, i: usize, j: usize) -> f64 {
        self.parts[i].iter().zip(&self.parts[j]).map(|(a, b)| a * b).sum()
    }
}

impl Uncertain {
    /// Returns none for a term that was not fitted.
    fn new(solved: &Solved, unknown: Unknown) -> Option<Self> {
        match unknown {
            Unknown::Base(_, component) => Some(Self::Base(component)),
            Unknown::Error(frame, component) => Some(Self::Error(frame, component)),
            _ => {
                let k = solved.model.unknowns.iter().position(|one| *one == unknown)?;
                solved.fit.identifiable.kept.iter().position(|one| *one == k).map(Self::Fitted)
            }
        }
    }
}

/// Returns `W F C^½`: a row for each unknown.
fn parts(solved: &Solved, joint_errors: Option<&AsJointErrors>) -> Result<DMatrix<f64>, Failure> {
    let (model, fit) = (&solved.model, &solved.fit);
    let (p, kept) = (model.unknowns.len(), &fit.identifiable.kept);
    let mut w = DMatrix::zeros(p, kept.len());
    kept.iter().enumerate().for_each(|(i, k)| w[(*k, i)] = 1.0);
    let mut forms = DMatrix::identity(kept.len(), kept.len());
    if let Some(joint_errors) = joint_errors {
        forms = DMatrix::from_fn(kept.len(), kept.len(), |i, j| joint_errors.forms[i][j]);
        for number in &joint_errors.numbers {
            w.column_mut(number.index).fill(0.0);
            for (unknown, error) in unknowns_of(&number.errors) {
                if let Some(k) = model.unknowns.iter().position(|one| *one == unknown) {
                    w[(k, number.index)] = error;
                }
            }
        }
    }
    let written = w * forms;
    let SymmetricEigen { eigenvalues, eigenvectors } =
        symmetric_eigen(fit.covariance.clone()).ok_or(NOT_FINITE)?;
    let root = eigenvectors * DMatrix::from_diagonal(&eigenvalues.map(|value| value.max(0.0).sqrt()));
    Ok(written * root)
}

/// Subtracts from each part the motions of what is set up anew, in the rows `anew`, that are
/// nearest to its effect.
fn without_setups(effects: &DMatrix<f64>, anew: &[usize], parts: &mut DMatrix<f64>) {
    if anew.is_empty() || effects.nrows() == 0 {
        return;
    }
    let mut motions = effects.select_columns(anew);
    let lengths: Vec<f64> =
        motions.column_iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
    motions.column_iter_mut().zip(&lengths).for_each(|(mut column, length)| column /= *length);
    let Ok(nearest) = motions.svd(true, true).solve(&(effects * &*parts), SEEN) else { return };
    for ((i, k), length) in anew.iter().enumerate().zip(&lengths) {
        let change = nearest.row(i) / *length;
        parts.row_mut(*k).zip_apply(&change, |value, change| *value -= change);
    }
}

/// Computes the displacements of points, given in the frame of the tool, by each unknown at some
/// configurations. The model is the ideal chain, on which `analyze` propagates errors: unknowns
/// that cancel each other cancel there.
fn effects(model: &Model, unknowns: &[Unknown], points: &[[f64; 3]], rows: &[Observation]) -> DMatrix<f64> {
    let bare = Model { targets: Vec::new(), ..model.with(unknowns.to_vec()) };
    let [x, y, z, _] = Pose::IDENTITY.0;
    let mut moved: Vec<RowDVector<f64>> = Vec::new();
    for point in points {
        let shifted =
            Model { mountings: vec![Pose([x, y, z, *point]); bare.mountings.len()], ..bare.clone() };
        for row in rows {
            // Expressions and tables need not be defined at every sample.
            let Ok(points) = shifted.tool_points(std::slice::from_ref(row)) else { continue };
            let moves = points.derivatives().iter().flat_map(|moves| moves.row_iter());
            moved.extend(moves.map(|row| row.clone_owned()).filter(|row| row.iter().all(|v| v.is_finite())));
        }
    }
    if moved.is_empty() { DMatrix::zeros(0, unknowns.len()) } else { DMatrix::from_rows(&moved) }
}

/// Returns the combinations `U V` of the parts that have an effect, in columns.
fn with_effect(effects: &DMatrix<f64>, parts: &DMatrix<f64>) -> Result<DMatrix<f64>, Failure> {
    let moved = effects * parts;
    let single = |k: usize| effects.column(k).norm() * parts.row(k).amax();
    let largest = (0..effects.ncols()).map(single).fold(0.0, f64::max);
    let SymmetricEigen { eigenvalues, eigenvectors } =
        symmetric_eigen(moved.tr_mul(&moved)).ok_or(NOT_FINITE)?;
    let has_effect = |i: &usize| eigenvalues[*i].max(0.0).sqrt() > NO_EFFECT * largest;
    let mut order: Vec<usize> = (0..eigenvalues.len()).filter(has_effect).collect();
    order.sort_by(|a, b| eigenvalues[*b].total_cmp(&eigenvalues[*a]));
    Ok(parts * eigenvectors.select_columns(&order))
}
