//! Errors that the measurements could not determine, as directions for the spec.
//!
//! A fit determines combinations of the unknowns θ: the kept unknowns take the values `x = R θ`,
//! where R adds to each kept unknown those held at zero that act as it in these data. Numbers of
//! the chain replace some kept unknowns by `v = F x`; the columns of W are the errors of the
//! written values. The written machine differs from the real one by
//!
//! ```text
//! W F x̂ − θ = W F (x̂ − R θ) + (W F R − 1) θ
//! ```
//!
//! The first term is the noise, with the covariance of the spec. The second has no effect on the
//! data, and with the priors σ of θ it has the covariance `U Uᵀ`, `U = (W F R − 1) diag(σ)`.
//! Combinations of its columns that move no point of the tool in any configuration are removed:
//! with the effects G of the unknowns on a frame at the flange and `(G U)ᵀ G U = V Λ Vᵀ`, the
//! columns `U V` of a positive Λ are left.

use abbe::analysis::decompose::symmetric_eigen;
use abbe::analysis::{Workspace, joint_samples};
use abbe::identify::{Failure, Measurement, Model, Observation, Unknown};
use abbe::{Component, Error, Pose, Quantity};
use nalgebra::{DMatrix, DVector, RowDVector, SymmetricEigen};

use super::as_joint_errors::AsJointErrors;
use super::fitted::{fitted_mountings, fitted_targets};
use super::priors::Prior;
use super::setup::Setup;
use super::solve::Solved;

/// Number of configurations at which effects are evaluated.
const SAMPLES: usize = 100;

/// Smallest effect of a direction, as a share of the largest effect of one unknown.
const NO_EFFECT: f64 = 1e-6;

/// Smallest entry of a direction, as a share of the largest effect of an entry in it.
const ROUNDING: f64 = 1e-9;

/// Directions of errors that the measurements could not determine.
#[derive(Clone, Debug, Default)]
pub(super) struct UndeterminedDirections {
    /// Measured points in the last frame: nominal, and as they were found.
    pub(super) points: Vec<[f64; 3]>,
    /// Quantities of the columns.
    pub(super) of: Vec<Column>,
    /// Directions of one standard deviation each.
    pub(super) rows: Vec<Vec<f64>>,
}

/// Quantity of a column.
#[derive(Clone, Copy, Debug)]
pub(super) enum Column {
    /// An error of `F_0`.
    Base(Component),
    /// An error of a frame, numbered from 0.
    Error(usize, Component),
    /// A magnitude that was fitted, by its row in the covariance.
    Fitted(usize),
    /// A magnitude that was held at its declared value: index of the source, and that value.
    Held(usize, f64),
}

impl UndeterminedDirections {
    pub(super) fn new(
        setup: &Setup,
        solved: &Solved,
        joint_errors: Option<&AsJointErrors>,
        rows: &[Observation],
    ) -> Result<Self, Failure> {
        let model = &solved.model;
        let (directions, columns) = (directions(solved, joint_errors)?, machine_unknowns(model));
        let directions = directions.select_rows(&columns);
        let effects = effects(setup, model, &columns)?;
        let directions = with_effect(&effects, &directions)?;
        // Entries without an effect are rounding errors.
        let size = |k: usize| effects.column(k).norm();
        let largest = |direction: usize| {
            (0..columns.len()).map(|k| (directions[(k, direction)] * size(k)).abs()).fold(0.0, f64::max)
        };
        let least: Vec<f64> = (0..directions.ncols()).map(|i| ROUNDING * largest(i)).collect();
        let occurs = |k: &usize| (0..least.len()).any(|i| (directions[(*k, i)] * size(*k)).abs() > least[i]);
        let used = (0..columns.len()).filter(occurs);
        let used: Vec<usize> = used.filter(|k| Column::new(solved, columns[*k]).is_some()).collect();
        let row = |i: usize| used.iter().map(|k| directions[(*k, i)]).collect();
        let of = used.iter().filter_map(|k| Column::new(solved, columns[*k])).collect();
        Ok(Self {
            points: measured_points(setup, solved, rows)?,
            of,
            rows: (0..least.len()).map(row).collect(),
        })
    }
}

impl Column {
    /// Returns none for a term that was not fitted.
    fn new(solved: &Solved, k: usize) -> Option<Self> {
        let index = solved.fit.identifiable.kept.iter().position(|one| *one == k);
        match (solved.model.unknowns[k], index) {
            (Unknown::Base(_, component), _) => Some(Self::Base(component)),
            (Unknown::Error(frame, component), _) => Some(Self::Error(frame, component)),
            (Unknown::Magnitude(_), Some(index)) => Some(Self::Fitted(index)),
            _ => solved.own_magnitude(k).map(|own| Self::Held(own.source, own.declared.value)),
        }
    }
}

/// Returns `(W F R − 1) diag(σ)`: a row for each unknown, a column for each with a prior.
fn directions(solved: &Solved, joint_errors: Option<&AsJointErrors>) -> Result<DMatrix<f64>, Failure> {
    let (model, fit) = (&solved.model, &solved.fit);
    let (p, kept) = (model.unknowns.len(), &fit.identifiable.kept);
    let default = model.priors(Prior::DEFAULT_SHARE)?;
    let priors = (0..p).map(|k| fit.priors.get(k).copied().flatten().or(default[k]));
    let sizes = model.expected(&priors.collect::<Vec<_>>())?;
    let mut w = DMatrix::zeros(p, kept.len());
    kept.iter().enumerate().for_each(|(i, k)| w[(*k, i)] = 1.0);
    let mut forms = DMatrix::identity(kept.len(), kept.len());
    if let Some(joint_errors) = joint_errors {
        forms = DMatrix::from_fn(kept.len(), kept.len(), |i, j| joint_errors.forms[i][j]);
        for number in &joint_errors.numbers {
            w.column_mut(number.index).fill(0.0);
            let (frame, errors) = number.twist;
            for (component, error) in Component::ALL.into_iter().zip(errors) {
                let unknown = Unknown::Error(frame, component);
                if let Some(k) = model.unknowns.iter().position(|one| *one == unknown) {
                    w[(k, number.index)] = error;
                }
            }
        }
    }
    // Places on the bench, and where the machine stands on it, are no errors of the machine.
    let is_of_bench =
        |unknown: Unknown| matches!(unknown, Unknown::Base(..) | Unknown::Fixture(..) | Unknown::Zero(_));
    let uncertain = (0..p).filter(|k| !is_of_bench(model.unknowns[*k]));
    let uncertain: Vec<(usize, f64)> = uncertain.filter_map(|k| Some((k, sizes[k]?))).collect();
    let columns: Vec<DVector<f64>> =
        uncertain.iter().map(|(k, _)| DVector::from_vec(fit.identifiable.kept_coordinates(*k))).collect();
    if columns.is_empty() {
        return Ok(DMatrix::zeros(p, 0));
    }
    let r = DMatrix::from_columns(&columns);
    let mut directions = w * forms * r;
    for (i, (k, size)) in uncertain.iter().enumerate() {
        directions[(*k, i)] -= 1.0;
        directions.column_mut(i).scale_mut(*size);
    }
    Ok(directions)
}

/// Returns the indices of the unknowns that displace points of the tool in `F_0` of the first
/// station.
fn machine_unknowns(model: &Model) -> Vec<usize> {
    let is_of_machine = |k: &usize| {
        matches!(model.unknowns[*k], Unknown::Base(0, _) | Unknown::Error(..) | Unknown::Magnitude(_))
    };
    (0..model.unknowns.len()).filter(is_of_machine).collect()
}

/// Computes G, the displacements of three points of the tool by each unknown at configurations
/// within the joint limits. The points are as far from each other as the arm is long.
fn effects(setup: &Setup, model: &Model, columns: &[usize]) -> Result<DMatrix<f64>, Failure> {
    let all: Vec<usize> = (0..setup.description.variables.len()).collect();
    let samples = joint_samples(model.manipulator, &all, SAMPLES).map_err(Failure::Machine)?;
    let nothing = || Measurement::Points(Vec::new().into());
    let samples = samples.reached().into_iter();
    let samples: Vec<Observation> =
        samples.map(|sample| Observation::new(0, sample.q, sample.u, nothing())).collect();
    let unknowns = columns.iter().map(|k| model.unknowns[*k]).collect();
    let bare = Model { targets: Vec::new(), ..model.with(unknowns) };
    let [x, y, z, _] = Pose::IDENTITY.0;
    let mut rows: Vec<RowDVector<f64>> = Vec::new();
    for point in [[0.0; 3], [setup.arm, 0.0, 0.0], [0.0, setup.arm, 0.0]] {
        let shifted = Model { mountings: vec![Pose([x, y, z, point]); bare.mountings.len()], ..bare.clone() };
        for sample in &samples {
            // Expressions and tables need not be defined at every sample.
            let Ok(points) = shifted.tool_points(std::slice::from_ref(sample)) else { continue };
            let moves = points.derivatives().iter().flat_map(|moves| moves.row_iter());
            rows.extend(moves.map(|row| row.clone_owned()).filter(|row| row.iter().all(|v| v.is_finite())));
        }
    }
    Ok(match rows.is_empty() {
        true => DMatrix::zeros(0, columns.len()),
        false => DMatrix::from_rows(&rows),
    })
}

/// Returns the combinations `U V` of the directions that have an effect, in columns.
fn with_effect(effects: &DMatrix<f64>, directions: &DMatrix<f64>) -> Result<DMatrix<f64>, Failure> {
    let moved = effects * directions;
    let single = |k: usize| effects.column(k).norm() * directions.row(k).amax();
    let largest = (0..effects.ncols()).map(single).fold(0.0, f64::max);
    let eigen = symmetric_eigen(moved.tr_mul(&moved));
    let not_finite = Failure::Machine(Error::NotFinite { quantity: Quantity::Jacobian, index: 0 });
    let SymmetricEigen { eigenvalues, eigenvectors } = eigen.ok_or(not_finite)?;
    let has_effect = |i: &usize| eigenvalues[*i].max(0.0).sqrt() > NO_EFFECT * largest;
    let mut order: Vec<usize> = (0..eigenvalues.len()).filter(has_effect).collect();
    order.sort_by(|a, b| eigenvalues[*b].total_cmp(&eigenvalues[*a]));
    Ok(directions * eigenvectors.select_columns(&order))
}

/// Returns the measured points in the last frame: nominal, and as they were found.
fn measured_points(setup: &Setup, solved: &Solved, rows: &[Observation]) -> Result<Vec<[f64; 3]>, Failure> {
    let Solved { model, fit, .. } = solved;
    let Some(row) = rows.first() else { return Ok(Vec::new()) };
    let frames = setup.description.frames.len();
    let mut transforms = vec![Pose::IDENTITY; frames + 1];
    model.manipulator.transforms(&row.q, &model.s, &mut transforms).map_err(Failure::Machine)?;
    let mut points = setup.delivered_points();
    points.extend(match setup.pose {
        true => fitted_mountings(model, &fit.x).iter().map(Pose::position).collect(),
        false => model.mounted(&fitted_targets(model, &fit.x)),
    });
    Ok(points.into_iter().map(|point| transforms[frames].apply(point)).collect())
}
