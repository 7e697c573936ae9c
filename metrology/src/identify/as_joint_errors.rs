//! Expresses identified errors of frames as errors of joint zeros, structural parameters and
//! Denavit-Hartenberg numbers.
//!
//! A change δ of a number x in `A_i E_i` is equivalent to `E_i` with `vee(A_i⁻¹ ∂A_i/∂x) δ`, and to
//! `E_{i-1}` with `vee(∂A_i/∂x A_i⁻¹) δ`. If one of these twists is the same in all configurations,
//! the number is a linear combination of constant errors and replaces one of them. This is a change
//! of basis; the machine stays the same to first order.

use abbe::identify::{Fit, Model, Unknown};
use abbe_codegen::graph::Graph;
use abbe_spec::{ChainNumber, Spec};
use serde::Serialize;

use super::alternatives::{Alternative, Explanations, Significant};
use super::chain_numbers::{FrameErrors, chain_numbers, constant_errors, error_unit, is_angle, unknowns_of};
use super::terms::{self, ErrorSite, Term};

/// Correlation at and above which a number cannot be distinguished from a magnitude.
const CORRELATED: f64 = 0.9;

/// Number of standard deviations beyond which a value is significant.
const SIGNIFICANT: f64 = 3.0;

/// Identified errors, with numbers of the chain in place of some errors of frames. The machine is
/// the same to first order.
pub(super) struct AsJointErrors {
    /// Numbers of the chain that replace errors of frames.
    pub(super) numbers: Vec<FoundNumber>,
    /// Remaining unknowns: index among the kept unknowns, value and standard deviation.
    pub(super) others: Vec<(usize, f64, f64)>,
    /// Linear forms of the kept unknowns that give the values of both, in the same order.
    pub(super) forms: Vec<Vec<f64>>,
}

/// Identified error of a number of the chain.
#[derive(Clone, Debug, Serialize)]
pub struct JointError {
    /// Error of a frame that it replaces, such as `e_r1`.
    pub in_place_of: String,
    /// Name of the number: `zero of q2`, `reach`, `a of shoulder`.
    pub number: String,
    /// Actual minus nominal value, in `unit`.
    pub value: f64,
    /// Standard deviation of the value, in `unit`.
    pub standard_deviation: f64,
    /// Unit: the length unit, or rad.
    pub unit: &'static str,
    /// Other errors that explain the data as well in place of this one.
    pub alternatives: Vec<Alternative>,
}

impl JointError {
    /// Returns the names of its alternatives: `zero of q5 or 2 more`.
    pub fn others(&self) -> String {
        match &self.alternatives[..] {
            [] => String::new(),
            [other] => other.number.clone(),
            [other, rest @ ..] => format!("{} or {} more", other.number, rest.len()),
        }
    }
}

/// Number of the chain with its identified error.
#[derive(Clone, Debug)]
pub(super) struct FoundNumber {
    /// Name: `zero of q2`.
    pub(super) name: String,
    pub(super) number: ChainNumber,
    /// Errors of frames per unit of the number.
    pub(super) errors: FrameErrors,
    /// Index among the kept unknowns of the one it replaces.
    pub(super) index: usize,
    pub(super) value: f64,
    pub(super) standard_deviation: f64,
    /// Largest absolute correlation with the magnitude of a source.
    pub(super) correlation: f64,
}

impl AsJointErrors {
    pub(super) fn new(spec: &Spec, model: &Model, fit: &Fit) -> Self {
        let mut basis = ExchangedBasis::new(model, fit);
        let mut graph = Graph::with_tables(&spec.tables);
        let mut replaced = Vec::new();
        for (name, number) in chain_numbers(spec) {
            let Some(errors) = constant_errors(&mut graph, spec, number) else { continue };
            replaced.extend(basis.exchange(&errors).map(|index| (index, name, number, errors)));
        }
        let taken = |index: &usize| replaced.iter().any(|(other, ..)| other == index);
        let others = (0..basis.forms.len()).filter(|index| !taken(index));
        let value = |index| {
            let (value, standard_deviation) = basis.value(index);
            (index, value, standard_deviation)
        };
        let others = others.map(value).collect();
        let number = |(index, name, number, errors)| {
            let (value, standard_deviation) = basis.value(index);
            let correlation = basis.correlation(index);
            FoundNumber { name, number, errors, index, value, standard_deviation, correlation }
        };
        let numbers = replaced.into_iter().map(number).collect();
        Self { numbers, others, forms: basis.forms }
    }

    /// Returns the significant errors, with their alternatives.
    ///
    /// A number that the data cannot tell from another has a share of what both explain. It is
    /// significant if what it explains alone, beside the other significant errors, is; its value is
    /// then that without the other.
    pub(super) fn joint_errors(&self, explanations: &Explanations) -> Vec<JointError> {
        // A term that changes with a joint is hard to distinguish from a constant if the joint
        // moves only a little.
        let candidates = || self.numbers.iter().filter(|one| one.correlation < CORRELATED);
        let is_significant = |value: f64, deviation: f64| value.abs() > SIGNIFICANT * deviation;
        let mut all: Vec<FoundNumber> =
            candidates().filter(|one| is_significant(one.value, one.standard_deviation)).cloned().collect();
        let errors: Vec<usize> = self.significant_others(explanations).collect();
        let named = |all: &[FoundNumber]| Significant {
            names: all.iter().map(|one| one.name.clone()).collect(),
            errors: errors.clone(),
        };
        loop {
            let rest = candidates().filter(|one| all.iter().all(|other| other.index != one.index));
            let alone = rest.filter_map(|one| {
                let (value, standard_deviation) = explanations.alone(&one.name, &named(&all))?;
                Some(FoundNumber { value, standard_deviation, ..one.clone() })
            });
            let ratio = |one: &FoundNumber| one.value.abs() / one.standard_deviation;
            let mut alone: Vec<FoundNumber> =
                alone.filter(|one| is_significant(one.value, one.standard_deviation)).collect();
            alone.sort_by(|a, b| ratio(b).total_cmp(&ratio(a)));
            // It must have an alternative, and leave nothing to any of them.
            let significant = named(&all);
            let settles = |one: &FoundNumber| {
                let others = one.joint_error(&significant, explanations).alternatives;
                let with = named(&[&all[..], std::slice::from_ref(one)].concat());
                let is_left = |name: &str| {
                    let beside = explanations.alone(name, &with);
                    beside.is_some_and(|(value, deviation)| is_significant(value, deviation))
                };
                !others.is_empty() && !others.iter().any(|other| is_left(&other.number))
            };
            let Some(most) = alone.into_iter().find(settles) else { break };
            all.push(most);
        }
        let significant = named(&all);
        all.iter().map(|one| one.joint_error(&significant, explanations)).collect()
    }

    /// Returns the indices among the kept unknowns of the other significant errors of the machine.
    fn significant_others(&self, explanations: &Explanations) -> impl Iterator<Item = usize> {
        let is_error = |index: usize| matches!(explanations.kept(index), Unknown::Error(..));
        self.others.iter().filter_map(move |(index, value, deviation)| {
            (is_error(*index) && value.abs() > SIGNIFICANT * deviation).then_some(*index)
        })
    }
}

/// Returns all numbers of the chain as terms of magnitude 1.
pub(super) fn number_terms(spec: &Spec) -> Vec<Term> {
    let term = |(_, number)| Term { site: ErrorSite::from_chain_number(number), basis: terms::Basis::One };
    chain_numbers(spec).into_iter().map(term).collect()
}

impl FoundNumber {
    /// Returns the unit of its value.
    pub(super) fn unit(&self, spec: &Spec) -> &'static str {
        error_unit(spec, is_angle(spec, self.number))
    }

    fn joint_error(&self, significant: &Significant, explanations: &Explanations) -> JointError {
        let Self { name: number, index, value, standard_deviation, .. } = self.clone();
        let in_place_of = explanations.model.name(explanations.kept(index));
        let unit = self.unit(explanations.spec);
        let alternatives = explanations.alternatives(&number, value, standard_deviation, significant);
        JointError { in_place_of, number, value, standard_deviation, unit, alternatives }
    }
}

/// Replacement of kept unknowns by numbers of the chain, one after the other. Every entry of the
/// basis is a linear form of the kept unknowns.
struct ExchangedBasis<'a> {
    model: &'a Model<'a>,
    fit: &'a Fit,
    /// Coefficients of each entry's linear form, by index among the kept unknowns.
    forms: Vec<Vec<f64>>,
    /// Entries that a number may still replace: errors of frames that are not equivalent to an
    /// unknown of base, tool or target.
    free: Vec<bool>,
}

impl<'a> ExchangedBasis<'a> {
    fn new(model: &'a Model<'a>, fit: &'a Fit) -> Self {
        let kept = &fit.identifiable.kept;
        let count = kept.len();
        let forms = (0..count).map(|i| (0..count).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        let mut basis = Self { model, fit, forms, free: vec![true; count] };
        for (k, unknown) in model.unknowns.iter().enumerate() {
            if !matches!(unknown, Unknown::Error(..)) {
                let coordinates = fit.identifiable.kept_coordinates(k);
                let taken = coordinates.iter().map(|factor| factor.abs() > 1e-9);
                basis.free.iter_mut().zip(taken).for_each(|(free, taken)| *free &= !taken);
            }
        }
        basis
    }

    /// Replaces the kept unknown with the largest part in a number. Returns the index of that
    /// unknown, or none if no replacement is possible.
    fn exchange(&mut self, errors: &FrameErrors) -> Option<usize> {
        let mut coordinates = vec![0.0; self.forms.len()];
        for (unknown, error) in unknowns_of(errors) {
            let unknown = self.model.unknowns.iter().position(|one| *one == unknown)?;
            let parts = self.fit.identifiable.kept_coordinates(unknown);
            coordinates.iter_mut().zip(parts).for_each(|(sum, part)| *sum += error * part);
        }
        let now: Vec<f64> = self.forms.iter().map(|form| product(form, &coordinates)).collect();
        // Coefficients in standard deviations of the kept unknowns.
        let weight = |index: usize| now[index].abs() / self.fit.covariance[(index, index)].max(0.0).sqrt();
        let most = (0..now.len()).map(weight).fold(0.0, f64::max);
        let index =
            (0..now.len()).filter(|i| self.free[*i]).max_by(|a, b| weight(*a).total_cmp(&weight(*b)))?;
        // A number must not change the placement of the machine or of what is mounted on its tool.
        let unknown = |i: usize| self.model.unknowns[self.fit.identifiable.kept[i]];
        let moves = (0..now.len()).any(|i| unknown(i).is_placement() && weight(i) > 1e-3 * most);
        // A number must not replace an unknown with only a small part in it.
        if moves || weight(index).is_nan() || weight(index) <= 0.1 * most {
            return None;
        }
        let form: Vec<f64> = self.forms[index].iter().map(|factor| factor / now[index]).collect();
        for (i, other) in self.forms.iter_mut().enumerate() {
            other.iter_mut().zip(&form).for_each(|(factor, new)| *factor -= now[i] * new);
        }
        self.forms[index] = form;
        self.free[index] = false;
        Some(index)
    }

    /// Computes the largest absolute correlation of an entry with the magnitude of a source.
    fn correlation(&self, index: usize) -> f64 {
        let covariance = &self.fit.covariance;
        let (_, deviation) = self.value(index);
        let kept = self.fit.identifiable.kept.iter().enumerate();
        let magnitudes = kept.filter(|(_, k)| matches!(self.model.unknowns[**k], Unknown::Magnitude(_)));
        let correlation = |(other, _): (usize, &usize)| {
            let with: f64 =
                (0..self.forms.len()).map(|j| self.forms[index][j] * covariance[(j, other)]).sum();
            (with / (deviation * covariance[(other, other)].max(0.0).sqrt())).abs()
        };
        magnitudes.map(correlation).fold(0.0, f64::max)
    }

    /// Returns the value and the standard deviation of an entry.
    fn value(&self, index: usize) -> (f64, f64) {
        let form = &self.forms[index];
        let found: Vec<f64> = self.fit.identifiable.kept.iter().map(|k| self.fit.x[*k]).collect();
        let variance = (0..form.len())
            .flat_map(|i| (0..form.len()).map(move |j| (i, j)))
            .map(|(i, j)| form[i] * self.fit.covariance[(i, j)] * form[j])
            .sum::<f64>();
        (product(form, &found), variance.max(0.0).sqrt())
    }
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
