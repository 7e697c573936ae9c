//! Alternatives to a named error: other single errors that explain the same data as well.
//!
//! A set of errors with the directions V, in coordinates of the kept unknowns x̂ with covariance C,
//! explains the data up to `χ² = min_δ (x̂ − V δ)ᵀ C⁻¹ (x̂ − V δ)`. The set has the significant
//! errors and all unknowns of placement. One error is replaced by another: twice the logarithm of
//! their likelihood ratio is the increase of χ². It is 0 for errors that are equivalent in these
//! data.

use abbe::identify::{Failure, Fit, Model, Observation, Unknown};
use abbe::{Component, VariableKind};
use abbe_spec::Spec;
use nalgebra::{Cholesky, DVector, Dyn};
use serde::Serialize;

use super::chain_numbers::{ChainError, chain_errors, error_unit, frame_error, unknowns_of};
use super::{Prior, Setup};

/// 95 % quantile of χ² with one degree of freedom.
const CHI_SQUARED_95: f64 = 3.84;

/// Largest value of an alternative, as a multiple of the default prior.
const PLAUSIBLE: f64 = 3.0;

/// Share of a direction that must remain beside the other errors of the set.
const INDEPENDENT: f64 = 1e-6;

/// Largest distance of a target on an axis, as a share of the arm length.
const ON_AXIS: f64 = 1e-3;

/// Another error that explains the data as well as the named one (likelihood ratio, 95 %).
#[derive(Clone, Debug, Serialize)]
pub struct Alternative {
    /// Name: `zero of q5`, `a of shoulder`, `e_x of wrist`.
    pub number: String,
    /// Value that replaces the named error, in `unit`.
    pub value: f64,
    /// Standard deviation of the value, in `unit`.
    pub standard_deviation: f64,
    /// Unit: the length unit, or rad.
    pub unit: &'static str,
}

/// Significant errors of a fit.
pub(super) struct Significant {
    /// Names of numbers of the chain.
    pub(super) names: Vec<String>,
    /// Other errors of the machine, by index among the kept unknowns.
    pub(super) errors: Vec<usize>,
}

/// Explanations of the data of one fit.
pub(super) struct Explanations<'a> {
    pub(super) spec: &'a Spec,
    pub(super) model: &'a Model<'a>,
    fit: &'a Fit,
    /// Cholesky decomposition of the covariance of the kept unknowns; none if it is singular.
    cholesky: Option<Cholesky<f64, Dyn>>,
    candidates: Vec<ChainError>,
    /// Standard deviations of the default prior: of a length and of an angle.
    expected: [f64; 2],
}

impl<'a> Explanations<'a> {
    pub(super) fn new(spec: &'a Spec, setup: &Setup, model: &'a Model<'a>, fit: &'a Fit) -> Self {
        let mut candidates = chain_errors(spec);
        let plain = spec.frames.iter().enumerate().filter(|(_, frame)| frame.convention.is_none());
        let of_frames =
            plain.flat_map(|(frame, _)| Component::ALL.map(|component| frame_error(spec, frame, component)));
        candidates.extend(of_frames.collect::<Vec<_>>());
        let share = Prior::DEFAULT_SHARE;
        Self {
            spec,
            model,
            fit,
            cholesky: fit.covariance.clone().cholesky(),
            candidates,
            expected: [share * setup.arm, share],
        }
    }

    /// Returns a kept unknown by its index among these.
    pub(super) fn kept(&self, index: usize) -> Unknown {
        self.model.unknowns[self.fit.identifiable.kept[index]]
    }

    /// Returns the alternatives to one of the significant numbers, the best explanation first.
    pub(super) fn alternatives(
        &self,
        name: &str,
        value: f64,
        standard_deviation: f64,
        significant: &Significant,
    ) -> Vec<Alternative> {
        let relative = standard_deviation / value.abs();
        let Some(named) = self.named(name) else { return Vec::new() };
        let Some(beside) = self.beside_significant(name, significant) else { return Vec::new() };
        let (Some(found), Some(own)) = (beside.rest(&self.found()), self.direction(named)) else {
            return Vec::new();
        };
        let Some(own) = beside.independent(&own) else { return Vec::new() };
        let explained = |direction: &DVector<f64>| direction.dot(&found).powi(2) / direction.norm_squared();
        let least = explained(&own) - CHI_SQUARED_95;
        let mut taken = vec![named];
        let mut alternatives = Vec::new();
        for one in &self.candidates {
            let is_significant = significant.names.contains(&one.name);
            if is_significant || taken.iter().any(|other| is_same(one, other)) {
                continue;
            }
            let Some(direction) = self.direction(one).and_then(|d| beside.independent(&d)) else { continue };
            let value = direction.dot(&found) / direction.norm_squared();
            let plausible = PLAUSIBLE * self.expected[usize::from(one.is_angle)];
            if explained(&direction) < least || value.abs() > plausible {
                continue;
            }
            // Errors of frames that are equal to a listed error have another name only.
            let is_renamed = !self.is_number(one)
                && taken.iter().any(|other| {
                    let of_other = self.direction(other).and_then(|d| beside.independent(&d));
                    one.is_angle == other.is_angle && of_other.is_some_and(|d| is_equal(&d, &direction))
                });
            if is_renamed {
                continue;
            }
            taken.push(one);
            let alternative = Alternative {
                number: one.name.clone(),
                value,
                standard_deviation: relative * value.abs(),
                unit: error_unit(self.spec, one.is_angle),
            };
            alternatives.push((explained(&direction), alternative));
        }
        alternatives.sort_by(|a, b| b.0.total_cmp(&a.0));
        alternatives.into_iter().map(|(_, alternative)| alternative).collect()
    }

    /// Returns the value of a number that alone explains what it can beside the significant errors,
    /// and its standard deviation.
    pub(super) fn alone(&self, name: &str, significant: &Significant) -> Option<(f64, f64)> {
        let beside = self.beside_significant(name, significant)?;
        let own = beside.independent(&self.direction(self.named(name)?)?)?;
        let found = beside.rest(&self.found())?;
        Some((own.dot(&found) / own.norm_squared(), 1.0 / own.norm()))
    }

    fn named(&self, name: &str) -> Option<&ChainError> {
        self.candidates.iter().find(|one| one.name == name)
    }

    /// Returns the values of the kept unknowns.
    fn found(&self) -> DVector<f64> {
        let kept = &self.fit.identifiable.kept;
        DVector::from_iterator(kept.len(), kept.iter().map(|k| self.fit.x[*k]))
    }

    /// Returns the significant errors without one, and all places and magnitudes.
    fn beside_significant(&self, name: &str, significant: &Significant) -> Option<Beside<'_>> {
        let kept = &self.fit.identifiable.kept;
        let of_placement = kept.iter().enumerate().filter(|(_, k)| {
            let unknown = self.model.unknowns[**k];
            unknown.is_placement() || matches!(unknown, Unknown::Magnitude(_))
        });
        let unit = |i: usize| DVector::from_fn(kept.len(), |j, _| f64::from(u8::from(i == j)));
        let mut set: Vec<DVector<f64>> = of_placement.map(|(i, _)| unit(i)).collect();
        set.extend(significant.errors.iter().copied().map(unit));
        let rest = significant.names.iter().filter(|other| **other != name);
        let direction = |name: &String| self.direction(self.named(name)?);
        set.extend(rest.filter_map(direction));
        self.beside(set)
    }

    /// Is true for a number of the chain, false for an error of a frame.
    fn is_number(&self, one: &ChainError) -> bool {
        !Component::ALL.iter().any(|component| one.name.starts_with(component.name()))
    }

    /// Returns the errors of a frame as a combination of the kept unknowns; none if a part of it is
    /// no unknown of the model.
    fn direction(&self, one: &ChainError) -> Option<DVector<f64>> {
        let identifiable = &self.fit.identifiable;
        let mut sum = DVector::zeros(identifiable.kept.len());
        for (unknown, error) in unknowns_of(&one.errors) {
            let k = self.model.unknowns.iter().position(|other| *other == unknown)?;
            sum += error * DVector::from_vec(identifiable.kept_coordinates(k));
        }
        Some(sum)
    }

    fn beside(&self, set: Vec<DVector<f64>>) -> Option<Beside<'_>> {
        let mut beside = Beside { cholesky: self.cholesky.as_ref()?, basis: Vec::new() };
        for direction in set {
            let rest = beside.independent(&direction);
            beside.basis.extend(rest.map(|rest| rest.normalize()));
        }
        Some(beside)
    }
}

/// Orthonormal basis of the other errors of a set, in standard deviations.
struct Beside<'a> {
    cholesky: &'a Cholesky<f64, Dyn>,
    basis: Vec<DVector<f64>>,
}

impl Beside<'_> {
    /// Returns the part of `L⁻¹ v` orthogonal to the basis, with `C = L Lᵀ`.
    fn rest(&self, v: &DVector<f64>) -> Option<DVector<f64>> {
        let mut rest = self.cholesky.l_dirty().solve_lower_triangular(v)?;
        // A second pass removes rounding errors of the first.
        for _ in 0..2 {
            for unit in &self.basis {
                let along = unit.dot(&rest);
                rest.axpy(-along, unit, 1.0);
            }
        }
        Some(rest)
    }

    /// Returns the rest of a direction; none if it is a combination of the basis.
    fn independent(&self, v: &DVector<f64>) -> Option<DVector<f64>> {
        let all = self.cholesky.l_dirty().solve_lower_triangular(v)?.norm();
        self.rest(v).filter(|rest| rest.norm() > INDEPENDENT * all)
    }
}

/// Returns whether two numbers are the same errors of the same frames up to a factor.
fn is_same(a: &ChainError, b: &ChainError) -> bool {
    let dot = |x: &ChainError, y: &ChainError| {
        let y: Vec<(Unknown, f64)> = unknowns_of(&y.errors).collect();
        let factor = |one| y.iter().find(|(other, _)| *other == one).map_or(0.0, |(_, error)| *error);
        unknowns_of(&x.errors).map(|(one, error)| error * factor(one)).sum::<f64>()
    };
    dot(a, b).powi(2) >= (1.0 - 1e-9) * dot(a, a) * dot(b, b)
}

/// Returns whether two directions are equal up to the sign.
fn is_equal(a: &DVector<f64>, b: &DVector<f64>) -> bool {
    let size = 1e-6 * a.norm();
    (a - b).norm() <= size || (a + b).norm() <= size
}

/// Returns the name of the last revolute joint if all targets are on its axis.
///
/// A rotation by θ moves a point at the distance r from the axis by `2 r sin(θ/2)`.
pub(super) fn target_on_axis(setup: &Setup, rows: &[Observation]) -> Result<Option<String>, Failure> {
    const ANGLE: f64 = 0.7;
    let mut variables = setup.description.variables.iter().enumerate();
    let last = variables.rfind(|(_, variable)| variable.kind == VariableKind::Revolute);
    let (Some((joint, variable)), Some(row)) = (last, rows.first()) else { return Ok(None) };
    if setup.pose || setup.ideal.targets.is_empty() {
        return Ok(None);
    }
    let mut turned = row.clone();
    let mut q = row.q.to_vec();
    q[joint] += ANGLE;
    turned.q = q.into();
    let model = setup.ideal.with(Vec::new());
    let mut at = model.at(&[]);
    let [here, there] = [at.pose(row)?, at.pose(&turned)?];
    let radius = |target: &[f64; 3]| {
        let (a, b) = (here.apply(*target), there.apply(*target));
        let moved = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
        moved / (2.0 * (ANGLE / 2.0).sin())
    };
    let is_on_axis = model.targets.iter().all(|target| radius(target) <= ON_AXIS * setup.arm);
    Ok(is_on_axis.then(|| variable.name.to_string()))
}
