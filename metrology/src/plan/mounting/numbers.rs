//! Numbers that describe the errors of a machine without redundancy, and how well rows determine
//! them.
//!
//! The unknowns of a model are `θ = B t`. t has the placement (of the machine, of its targets), the
//! numbers of the chain, and errors of frames where these do not suffice. With the information M of
//! the rows about θ and the prior standard deviations σ of t, the covariance of t after the
//! measurement is
//!
//! ```text
//! C = (Bᵀ M B + diag(σ)⁻²)⁻¹
//! ```
//!
//! The placement has no prior, because an identification attributes to it whatever acts as it does.
//! A redundant number would have no variance of its own: the prior alone would divide the error
//! between it and its equivalents. Therefore a number is left out if it displaces the tool as a
//! combination of the placement and the numbers before it does.

use abbe::Component;
use abbe::identify::{Failure, Model, Observation, Unknown};
use nalgebra::{DMatrix, DVector};

use crate::identify::{ChainError, Prior, Setup, chain_errors, effects, frame_error};

/// Smallest share of the effect of a number that no combination of the others has.
const INDEPENDENT: f64 = 1e-6;

/// Prior information about the placement, as a share of that of the rows; it keeps C finite.
const RIDGE: f64 = 1e-11;

/// Independent numbers of a machine.
pub(super) struct MachineNumbers {
    pub(super) list: Vec<ChainError>,
    /// Prior standard deviation of each.
    pub(super) expected: Vec<f64>,
    /// Root mean square displacement of the tool point in use by one unit of each.
    pub(super) effects: Vec<f64>,
}

impl MachineNumbers {
    /// Finds the numbers: those of the chain, joints first, then errors of frames, from the tool
    /// towards the base. `model` has all errors of all frames.
    pub(super) fn new(setup: &Setup, model: &Model, spec: &abbe_spec::Spec) -> Result<Self, Failure> {
        let is_base = |k: &usize| matches!(model.unknowns[*k], Unknown::Base(0, _));
        let is_error = |k: &usize| matches!(model.unknowns[*k], Unknown::Error(..));
        let columns: Vec<usize> = (0..model.unknowns.len()).filter(|k| is_base(k) || is_error(k)).collect();
        let all = effects(setup, model, &columns)?;
        let mut basis: Vec<DVector<f64>> = Vec::new();
        let mut is_new = |effect: DVector<f64>| {
            let mut rest = effect.clone();
            // A second pass removes rounding errors of the first.
            for _ in 0..2 {
                basis.iter().for_each(|unit| rest.axpy(-unit.dot(&rest), unit, 1.0));
            }
            let is_new = rest.norm() > INDEPENDENT * effect.norm();
            if is_new {
                basis.push(rest.normalize());
            }
            is_new
        };
        for (i, _) in columns.iter().enumerate().filter(|(_, k)| is_base(k)) {
            is_new(all.column(i).into_owned());
        }
        let frames = (0..spec.frames.len()).rev();
        let of_frames =
            frames.flat_map(|frame| Component::ALL.map(|component| frame_error(spec, frame, component)));
        let candidates = chain_errors(spec).into_iter().chain(of_frames);
        let effect = |number: &ChainError| {
            let mut sum = DVector::zeros(all.nrows());
            for (component, error) in Component::ALL.into_iter().zip(number.errors) {
                let unknown = Unknown::Error(number.frame, component);
                if let Some(i) = columns.iter().position(|k| model.unknowns[*k] == unknown) {
                    sum.axpy(error, &all.column(i), 1.0);
                }
            }
            sum
        };
        let list: Vec<ChainError> = candidates.filter(|number| is_new(effect(number))).collect();
        let share = Prior::DEFAULT_SHARE;
        let expected = list.iter().map(|one| if one.is_angle { share } else { share * setup.arm }).collect();
        Ok(Self { list, expected, effects: Vec::new() })
    }

    /// Sets the effects on the tool point at the configurations of use.
    pub(super) fn used_at(mut self, model: &Model, used: &[Observation]) -> Result<Self, Failure> {
        // Without targets, the point is that of the tool.
        let errors = model.unknowns.iter().copied().filter(|unknown| matches!(unknown, Unknown::Error(..)));
        let bare = Model { targets: Vec::new(), ..model.with(errors.collect()) };
        let basis = Basis::directions(&self, &bare);
        let tool_points = bare.tool_points(used)?;
        let mut squares = vec![0.0; self.list.len()];
        for moves in tool_points.derivatives() {
            let moves = moves * &basis;
            squares.iter_mut().zip(moves.column_iter()).for_each(|(sum, by)| *sum += by.norm_squared());
        }
        let count = used.len().max(1) as f64;
        self.effects = squares.into_iter().map(|sum| (sum / count).sqrt()).collect();
        Ok(self)
    }
}

/// The numbers and the placement unknowns as a basis of the unknowns of one model.
pub(super) struct Basis {
    /// B: a row for each unknown; a column for each number, then for each unknown of the placement.
    b: DMatrix<f64>,
    /// Prior standard deviation of each number.
    expected: Vec<f64>,
    /// Unknown of each column after the numbers.
    placement: Vec<Unknown>,
}

impl Basis {
    pub(super) fn new(numbers: &MachineNumbers, model: &Model) -> Self {
        let is_placement = |k: &usize| model.unknowns[*k].is_placement();
        let placement: Vec<usize> = (0..model.unknowns.len()).filter(is_placement).collect();
        let first = numbers.list.len();
        let mut b = Self::directions(numbers, model).resize_horizontally(first + placement.len(), 0.0);
        placement.iter().enumerate().for_each(|(i, k)| b[(*k, first + i)] = 1.0);
        let placement = placement.into_iter().map(|k| model.unknowns[k]).collect();
        Self { b, expected: numbers.expected.clone(), placement }
    }

    fn directions(numbers: &MachineNumbers, model: &Model) -> DMatrix<f64> {
        let mut b = DMatrix::zeros(model.unknowns.len(), numbers.list.len());
        for (k, unknown) in model.unknowns.iter().enumerate() {
            let Unknown::Error(frame, component) = unknown else { continue };
            for (i, _) in numbers.list.iter().enumerate().filter(|(_, one)| one.frame == *frame) {
                b[(k, i)] = numbers.list[i].errors[component.index()];
            }
        }
        b
    }

    /// Returns the covariance C from the information M about the unknowns; none if M is not finite.
    pub(super) fn posterior(&self, information: &DMatrix<f64>) -> Option<Posterior> {
        let mut m = self.b.tr_mul(&(information * &self.b));
        let scale = |i: usize| match (self.expected.get(i), m[(i, i)]) {
            (Some(expected), _) => *expected,
            (None, own) if own > 0.0 => 1.0 / (RIDGE * own).sqrt(),
            (None, _) => 1.0,
        };
        let scales: Vec<f64> = (0..m.nrows()).map(scale).collect();
        // In units of the priors, so that the priors are the identity.
        for (i, j) in (0..scales.len()).flat_map(|i| (0..scales.len()).map(move |j| (i, j))) {
            m[(i, j)] = m[(i, j)] * scales[i] * scales[j] + f64::from(u8::from(i == j));
        }
        let inverse = m.cholesky()?.inverse();
        let covariance =
            DMatrix::from_fn(scales.len(), scales.len(), |i, j| inverse[(i, j)] * scales[i] * scales[j]);
        Some(Posterior { covariance })
    }

    /// Returns the names of all columns.
    pub(super) fn names(&self, numbers: &MachineNumbers, model: &Model) -> Vec<String> {
        let of_placement = self.placement.iter().map(|unknown| match unknown {
            Unknown::Base(..) => "the placement of the machine".to_owned(),
            one if one.is_tool() => "the place of the target".to_owned(),
            one => model.name(*one),
        });
        numbers.list.iter().map(|one| one.name.clone()).chain(of_placement).collect()
    }
}

/// Uncertainty of the numbers after a measurement.
pub(super) struct Posterior {
    covariance: DMatrix<f64>,
}

impl Posterior {
    pub(super) fn deviation(&self, i: usize) -> f64 {
        self.covariance[(i, i)].max(0.0).sqrt()
    }

    pub(super) fn correlation(&self, i: usize, j: usize) -> f64 {
        self.covariance[(i, j)] / (self.deviation(i) * self.deviation(j))
    }
}
