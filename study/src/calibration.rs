//! Errors of a calibration: what remains between an identified machine and the real one.
//!
//! The noise of the measurements and what they could not determine give the errors of the machine
//! the covariance of the spec, relative to a base and a target that are set up anew.

use std::sync::Arc;

use abbe::identify::{Failure, Measurement, Model, Observation, Role, Uncertainty, Unknown};
use abbe::{Class, Description, Manipulator, Pose};
use abbe_spec::{Identified, Source, Spec, Uncertain};

/// Name of all random sources of a calibration together.
const CALIBRATION: &str = "calibration";

/// Share of a variance below which what remains of it is rounding.
const ROUNDING: f64 = 1e-12;

/// Step of a joint for differences, in rad or the length unit.
const STEP: f64 = 1e-5;

/// Independent errors of a calibration.
pub struct CalibrationErrors {
    /// Identified quantities; one of them can occur twice.
    pub of: Vec<Identified>,
    /// Independent normal errors: each has a standard deviation for every quantity.
    pub parts: Vec<Vec<f64>>,
}

impl CalibrationErrors {
    /// Returns the errors that the covariance of a spec says.
    pub fn new(spec: &Spec) -> Self {
        Self { of: spec.covariance.of.clone(), parts: independent_parts(&spec.covariance.rows) }
    }
}

/// Predicts the deviation of a point of the tool from where an identified machine has it: by the
/// errors of the calibration, and by the random sources of the spec, among them what its model does
/// not explain.
pub struct Prediction<'a> {
    model: Model<'a>,
    errors: &'a CalibrationErrors,
    /// Variances of the magnitudes of random sources, the last unknowns of the model.
    random: Vec<f64>,
}

impl<'a> Prediction<'a> {
    /// Creates the prediction for a point in the frame of the tool; returns `None` if the spec
    /// states no covariance.
    pub fn new(
        spec: &'a Spec,
        manipulator: &'a dyn Manipulator,
        errors: &'a CalibrationErrors,
        point: [f64; 3],
    ) -> Option<Self> {
        let unknown = |identified: &Identified| match identified {
            Identified::Error(frame, component) => Some(Some(Unknown::Error(*frame, *component))),
            Identified::Base(component) => Some(Some(Unknown::Base(0, *component))),
            Identified::Magnitude(source) => Some(spec.enabled_index(*source).map(Unknown::Magnitude)),
            Identified::Joint(_) => None,
        };
        let unknowns: Vec<Unknown> = errors.of.iter().filter_map(unknown).collect::<Option<_>>()?;
        if errors.of.is_empty() {
            return None;
        }
        let random = random_sources(manipulator.description()).into_iter();
        let (of_random, random): (Vec<Unknown>, Vec<f64>) =
            random.map(|(source, variance)| (Unknown::Magnitude(source), variance)).unzip();
        let ideal = Model::ideal(manipulator, vec![[0.0; 3]], Uncertainty { length: 1.0, angle: 1.0 });
        let [x, y, z, _] = Pose::IDENTITY.0;
        let ideal = Model { mountings: vec![Pose([x, y, z, point])], ..ideal };
        let model = ideal.with([unknowns, of_random].concat());
        debug_assert!(model.roles.iter().all(|role| *role != Role::Known), "nothing but what is unknown");
        Some(Self { model, errors, random })
    }

    /// Returns the standard deviation of the point (√trace of its covariance) at each configuration
    /// that can be evaluated.
    pub fn deviations(&self, configurations: impl Iterator<Item = (Vec<f64>, Vec<f64>)>) -> Vec<f64> {
        let deviation = |covariance: [[f64; 3]; 3]| (0..3).map(|i| covariance[i][i]).sum::<f64>().sqrt();
        configurations.filter_map(|(q, u)| self.covariance(q, u).ok().map(deviation)).collect()
    }

    /// Returns the covariance `Σ_l (M l)(M l)ᵀ + Σ_k v_k m_k m_kᵀ` of the point in `F_0`, in
    /// squares of the length unit, for the parts l of the covariance and random sources of
    /// variances v, with the Jacobians M and m of the point.
    ///
    /// # Errors
    ///
    /// The configuration is outside of the domain of the machine, or its loops do not close.
    pub fn covariance(&self, q: Vec<f64>, u: Vec<f64>) -> Result<[[f64; 3]; 3], Failure> {
        let row = Observation::new(0, q, u, Measurement::Points(Vec::new().into()));
        let zero = vec![0.0; self.model.unknowns.len()];
        let (_, of_unknowns) = self.model.at(&zero).tool(&row)?;
        let (of_errors, of_random) = of_unknowns.split_at(zero.len() - self.random.len());
        let mut of_errors = of_errors.iter().copied();
        let moves = self.errors.of.iter().map(|one| match one {
            Identified::Joint(joint) => self.moves_of_joint(&row, *joint),
            _ => Ok(of_errors.next().unwrap_or_default()),
        });
        let moves: Vec<[f64; 3]> = moves.collect::<Result<_, Failure>>()?;
        let displacement = |part: &Vec<f64>| {
            let terms = moves.iter().zip(part);
            terms.fold([0.0; 3], |sum, (moved, size)| std::array::from_fn(|i| sum[i] + size * moved[i]))
        };
        let of_parts = self.errors.parts.iter().map(|part| (displacement(part), 1.0));
        let of_random = of_random.iter().copied().zip(self.random.iter().copied());
        let mut covariance = [[0.0; 3]; 3];
        for (moved, variance) in of_parts.chain(of_random) {
            for (row, one) in covariance.iter_mut().zip(moved) {
                row.iter_mut().zip(moved).for_each(|(sum, other)| *sum += variance * one * other);
            }
        }
        Ok(covariance)
    }

    /// Returns the derivative of the point with respect to a joint, by central differences.
    fn moves_of_joint(&self, row: &Observation, joint: usize) -> Result<[f64; 3], Failure> {
        let zero = vec![0.0; self.model.unknowns.len()];
        let at = |step: f64| {
            let mut q = row.q.to_vec();
            q[joint] += step;
            let row = Observation::new(0, q, row.u.to_vec(), Measurement::Points(Vec::new().into()));
            Ok::<_, Failure>(self.model.at(&zero).pose(&row)?.position())
        };
        let (before, after) = (at(-STEP)?, at(STEP)?);
        Ok(std::array::from_fn(|i| (after[i] - before[i]) / (2.0 * STEP)))
    }
}

/// Returns the uncertainty of a calibration as independent normal sources: their covariance is the
/// spec's `[covariance]`. There are none without one.
pub fn calibration_errors(spec: &Spec) -> Vec<Source> {
    let CalibrationErrors { of, parts } = CalibrationErrors::new(spec);
    let count = parts.len();
    let source = |(k, part): (usize, Vec<f64>)| {
        let quantities = of.iter().map(|one| Uncertain::Identified(*one)).zip(part);
        let propagated = quantities.filter(|(_, factor)| *factor != 0.0).collect();
        let name = format!("{CALIBRATION} {}", k + 1);
        let description = format!("Part {} of {count} of the uncertainty of the identified errors", k + 1);
        Source::propagating(name, description, propagated)
    };
    parts.into_iter().enumerate().map(source).collect()
}

/// Returns the spec with the first part of the calibration named as all of it, for reports in which
/// it stands for all.
pub fn named_as_one(spec: &Arc<Spec>) -> Arc<Spec> {
    let mut named = spec.clone();
    if let Some(first) = spec.sources.iter().position(Source::is_calibration_error) {
        CALIBRATION.clone_into(&mut Arc::make_mut(&mut named).sources[first].name);
    }
    named
}

/// Returns the indices of the random sources, without errors of a calibration, with the variances
/// of their magnitudes.
pub fn random_sources(description: &Description) -> Vec<(usize, f64)> {
    let own = description.sources.iter().enumerate().filter(|(_, source)| !source.is_calibration());
    let variance = |class: Class| match class {
        Class::Random(distribution) => Some(1.0 / distribution.divisor_squared()),
        _ => None,
    };
    own.filter_map(|(i, source)| Some((i, variance(source.class)?))).collect()
}

/// Returns true if the covariance contains the magnitude of a source.
pub fn has_magnitude(spec: &Spec, source: usize) -> bool {
    spec.covariance.of.contains(&Identified::Magnitude(source))
}

/// Returns vectors l with `Σ l lᵀ = C`, the columns of a Cholesky factor with pivots: independent
/// normal errors times these have the covariance C. A covariance that is singular has fewer of
/// them. Negative eigenvalues, which rounding of written numbers causes, count as 0.
fn independent_parts(covariance: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = covariance.len();
    let mut rest = covariance.to_vec();
    let mut parts = Vec::new();
    // The quantities have different units: pivots are relative to their own variances.
    let share = |rest: &[Vec<f64>], i: usize| match covariance[i][i] {
        0.0 => 0.0,
        variance => rest[i][i] / variance,
    };
    for _ in 0..count {
        let Some(pivot) = (0..count).max_by(|i, j| share(&rest, *i).total_cmp(&share(&rest, *j))) else {
            break;
        };
        if share(&rest, pivot) <= ROUNDING {
            break;
        }
        let root = rest[pivot][pivot].sqrt();
        let part: Vec<f64> = rest.iter().map(|row| row[pivot] / root).collect();
        for (row, left) in rest.iter_mut().zip(&part) {
            row.iter_mut().zip(&part).for_each(|(entry, right)| *entry -= left * right);
        }
        parts.push(part);
    }
    parts
}

#[cfg(test)]
mod tests;
