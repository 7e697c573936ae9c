//! The errors as those of joints: zeros, parameters and Denavit-Hartenberg numbers in place of errors of frames, as far as these act
//! alike.
//!
//! In `A_i E_i` a change δ of a number of `A_i` is `E_i` with `vee(A_i⁻¹ ∂A_i/∂x) δ`, and as well `E_{i-1}` with
//! `vee(∂A_i/∂x A_i⁻¹) δ`. Where one of these is the same in all configurations, the number is a combination of constant
//! errors, and takes the place of one of them: a change of basis that leaves the machine what it is.

use abbe::identify::{Failure, Fit, Model, Observation, Unknown};
use abbe::{Component, VariableKind};
use abbe_codegen::chain::{FrameTwist, frame_twists, transform};
use abbe_codegen::graph::{Frame, Graph, Node};
use abbe_spec::expr::{Dimension, Motion, Symbol};
use abbe_spec::{ChainNumber, DhNumber, Spec};
use serde::Serialize;

use super::setup::Setup;
use super::solve::Solved;
use super::terms::{self, ErrorSite, Term};
use crate::number::digits;

/// In how many configurations an error must be the same.
const SAMPLES: usize = 5;

/// The most rows at which machines are compared.
const ROWS: usize = 1000;

/// From which correlation on two numbers cannot be told apart.
const CORRELATED: f64 = 0.9;

/// Beyond how many standard deviations something counts as found.
const FOUND: f64 = 3.0;

/// The found errors, with numbers of the chain in place of some errors of frames: the same machine to first order.
pub(super) struct AsJointErrors {
    /// The numbers.
    pub(super) numbers: Vec<FoundNumber>,
    /// What the other unknowns are beside them, by place among the kept ones: value and standard deviation.
    pub(super) others: Vec<(usize, f64, f64)>,
    /// The covariance of all of them, by place among the kept unknowns.
    pub(super) covariance: Vec<Vec<f64>>,
}

/// The error of a number of the chain.
#[derive(Clone, Debug, Serialize)]
pub struct JointError {
    /// The error of a frame that it takes the place of, such as `e_r1`.
    pub in_place_of: String,
    /// The number: `zero of q2`, `reach`, `a of shoulder`.
    pub number: String,
    /// By how much it is off: the length unit, or rad.
    pub value: f64,
    /// How well that is known.
    pub standard_deviation: f64,
    /// All this as a sentence.
    pub sentence: String,
}

/// A number of the chain.
#[derive(Clone, Debug)]
pub(super) struct FoundNumber {
    /// What it is called: `zero of q2`.
    pub(super) name: String,
    pub(super) number: ChainNumber,
    /// The kept unknown in whose place it stands.
    pub(super) place: usize,
    pub(super) value: f64,
    pub(super) standard_deviation: f64,
    /// The largest of its correlations with magnitudes of sources, without its sign.
    pub(super) correlation: f64,
}

impl AsJointErrors {
    pub(super) fn new(spec: &Spec, model: &Model, fit: &Fit) -> Self {
        let mut basis = Basis::new(model, fit);
        let mut graph = Graph::with_tables(&spec.tables);
        let mut places = Vec::new();
        for (name, number) in numbers(spec) {
            let Some((frame, errors)) = constant_errors(&mut graph, spec, number) else { continue };
            places.extend(basis.exchange(frame, errors).map(|place| (place, name, number)));
        }
        let taken = |place: &usize| places.iter().any(|(other, ..)| other == place);
        let others = (0..basis.forms.len()).filter(|place| !taken(place));
        let value = |place| {
            let (value, standard_deviation) = basis.value(place);
            (place, value, standard_deviation)
        };
        let others = others.map(value).collect();
        let number = |(place, name, number)| {
            let (value, standard_deviation) = basis.value(place);
            let correlation = basis.correlation(place);
            FoundNumber { name, number, place, value, standard_deviation, correlation }
        };
        let numbers = places.into_iter().map(number).collect();
        Self { numbers, others, covariance: basis.covariance() }
    }

    /// Whatever is found, as sentences.
    ///
    /// A term that changes with a joint is hardly told from a constant where the joint moves a little: of numbers that are
    /// correlated with the magnitude of a source nothing is said.
    pub(super) fn joint_errors(&self, spec: &Spec, model: &Model, fit: &Fit) -> Vec<JointError> {
        let found = |one: &&FoundNumber| {
            one.value.abs() > FOUND * one.standard_deviation && one.correlation < CORRELATED
        };
        self.numbers.iter().filter(found).map(|one| one.joint_error(spec, model, fit)).collect()
    }
}

/// All numbers of the chain as terms of magnitude 1.
pub(super) fn number_terms(spec: &Spec) -> Vec<Term> {
    let term = |(_, number)| Term { place: ErrorSite::of_number(number), basis: terms::Basis::One };
    numbers(spec).into_iter().map(term).collect()
}

impl AsJointErrors {
    /// How far apart the points of rows are by this and by the fit, root mean square: of second order. Of many rows some tell
    /// it. The last sources of the manipulator are the [`number_terms`].
    pub(super) fn difference(
        &self,
        spec: &Spec,
        setup: &Setup,
        solved: &Solved,
        rows: &[Observation],
    ) -> Result<f64, Failure> {
        let Solved { model, fit, .. } = solved;
        let terms = number_terms(spec);
        let first = setup.description.sources.len() - terms.len();
        let other =
            |(place, value, _): &(usize, f64, f64)| (model.unknowns[fit.identifiable.kept[*place]], *value);
        let number = |one: &FoundNumber| {
            let place = ErrorSite::of_number(one.number);
            let index = terms.iter().position(|term| term.place == place);
            (Unknown::Magnitude(first + index.unwrap_or_default()), one.value)
        };
        let all = self.others.iter().map(other).chain(self.numbers.iter().map(number));
        let (unknowns, x): (Vec<Unknown>, Vec<f64>) = all.unzip();
        let written = setup.real.with(unknowns);
        let (mut room, mut room_of_fit) = (written.room(), model.room());
        let (mut squares, mut points) = (0.0, 0);
        for row in rows.iter().step_by(rows.len().div_ceil(ROWS)) {
            let here = written.deviations(&mut room, row, &x)?;
            for (a, b) in here.iter().zip(model.deviations(&mut room_of_fit, row, &fit.x)?) {
                squares += (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>();
                points += 1;
            }
        }
        Ok((squares / f64::from(points.max(1))).sqrt())
    }
}

impl FoundNumber {
    fn joint_error(&self, spec: &Spec, model: &Model, fit: &Fit) -> JointError {
        let Self { name: number, number: of, place, value, standard_deviation, .. } = self.clone();
        let in_place_of = model.name(model.unknowns[fit.identifiable.kept[place]]);
        let (factor, unit) = if is_angle(spec, of) { (1e3, "mrad") } else { (1.0, spec.length.symbol()) };
        let size = format!(
            "{} ± {} {unit}",
            digits(value.abs() * factor, 3),
            digits(standard_deviation * factor, 2)
        );
        let sentence = match (of, value < 0.0) {
            (ChainNumber::Joint(_), true) => format!("the {number} is off by -{size} ({in_place_of})"),
            (ChainNumber::Joint(_), false) => format!("the {number} is off by {size} ({in_place_of})"),
            (_, true) => format!("{number} is {size} less than nominal ({in_place_of})"),
            (_, false) => format!("{number} is {size} more than nominal ({in_place_of})"),
        };
        JointError { in_place_of, number, value, standard_deviation, sentence }
    }
}

fn is_angle(spec: &Spec, number: ChainNumber) -> bool {
    match number {
        ChainNumber::Joint(joint) => spec.variables[joint].kind == VariableKind::Revolute,
        ChainNumber::Parameter(parameter) => spec.parameters[parameter].dimension == Dimension::NONE,
        ChainNumber::DenavitHartenberg { number, .. } => number.motion().0 == Motion::Rotation,
    }
}

/// What the kept unknowns are replaced by, step by step: every one a linear form of what was found of them.
struct Basis<'a> {
    model: &'a Model<'a>,
    fit: &'a Fit,
    /// By place among the kept unknowns.
    forms: Vec<Vec<f64>>,
    /// The places that may still be given to a number: errors of frames that no unknown base, tool or target acts as.
    free: Vec<bool>,
}

impl<'a> Basis<'a> {
    fn new(model: &'a Model<'a>, fit: &'a Fit) -> Self {
        let kept = &fit.identifiable.kept;
        let count = kept.len();
        let forms = (0..count).map(|i| (0..count).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        let mut basis = Self { model, fit, forms, free: vec![true; count] };
        // A direction of an instrument that is held as it is expected takes no place.
        let held = |k: usize| fit.identifiable.inexact.contains(&k);
        let is_free = |k: usize, unknown: &Unknown| matches!(unknown, Unknown::Fixture(..)) && held(k);
        for (k, unknown) in model.unknowns.iter().enumerate() {
            if !matches!(unknown, Unknown::Error(..)) && !is_free(k, unknown) {
                let coordinates = basis.kept_coordinates(k);
                let taken = coordinates.iter().map(|factor| factor.abs() > 1e-9);
                basis.free.iter_mut().zip(taken).for_each(|(free, taken)| *free &= !taken);
            }
        }
        basis
    }

    /// What an unknown acts as, by place among the kept ones.
    fn kept_coordinates(&self, unknown: usize) -> Vec<f64> {
        let identifiable = &self.fit.identifiable;
        let held = identifiable.held.iter().find(|(held, _)| *held == unknown);
        let factor = |kept: &usize| match held {
            Some((_, acts_as)) => acts_as.iter().find(|(k, _)| k == kept).map_or(0.0, |(_, factor)| *factor),
            None => f64::from(u8::from(*kept == unknown)),
        };
        identifiable.kept.iter().map(factor).collect()
    }

    /// Puts a number in the place of the kept unknown that says most of it; that place, if there is any.
    fn exchange(&mut self, frame: usize, errors: [f64; 6]) -> Option<usize> {
        let mut coordinates = vec![0.0; self.forms.len()];
        for (component, error) in Component::ALL.into_iter().zip(errors).filter(|(_, error)| *error != 0.0) {
            let unknown = self.model.unknowns.iter().position(|u| *u == Unknown::Error(frame, component))?;
            if self.fit.identifiable.inexact.contains(&unknown) {
                return None;
            }
            let parts = self.kept_coordinates(unknown);
            coordinates.iter_mut().zip(parts).for_each(|(sum, part)| *sum += error * part);
        }
        let now: Vec<f64> = self.forms.iter().map(|form| product(form, &coordinates)).collect();
        // In standard deviations of the kept unknowns.
        let says = |place: usize| now[place].abs() / self.fit.covariance[(place, place)].max(0.0).sqrt();
        let most = (0..now.len()).map(says).fold(0.0, f64::max);
        let place = (0..now.len()).filter(|i| self.free[*i]).max_by(|a, b| says(*a).total_cmp(&says(*b)))?;
        // Where the machine stands and what is mounted on it stays what it is.
        let unknown = |i: usize| self.model.unknowns[self.fit.identifiable.kept[i]];
        let moves = (0..now.len()).any(|i| unknown(i).is_placement() && says(i) > 1e-3 * most);
        // A number is not found from what hardly belongs to it.
        if moves || says(place).is_nan() || says(place) <= 0.1 * most {
            return None;
        }
        let form: Vec<f64> = self.forms[place].iter().map(|factor| factor / now[place]).collect();
        for (i, other) in self.forms.iter_mut().enumerate() {
            other.iter_mut().zip(&form).for_each(|(factor, new)| *factor -= now[i] * new);
        }
        self.forms[place] = form;
        self.free[place] = false;
        Some(place)
    }

    /// The largest correlation of what stands at a place with the magnitude of a source, without its sign.
    fn correlation(&self, place: usize) -> f64 {
        let covariance = &self.fit.covariance;
        let (_, deviation) = self.value(place);
        let kept = self.fit.identifiable.kept.iter().enumerate();
        let magnitudes = kept.filter(|(_, k)| matches!(self.model.unknowns[**k], Unknown::Magnitude(_)));
        let correlation = |(other, _): (usize, &usize)| {
            let with: f64 =
                (0..self.forms.len()).map(|j| self.forms[place][j] * covariance[(j, other)]).sum();
            (with / (deviation * covariance[(other, other)].max(0.0).sqrt())).abs()
        };
        magnitudes.map(correlation).fold(0.0, f64::max)
    }

    /// `F C Fᵀ` with the forms as the rows of F.
    fn covariance(&self) -> Vec<Vec<f64>> {
        let count = self.forms.len();
        let half: Vec<Vec<f64>> = self
            .forms
            .iter()
            .map(|form| {
                (0..count).map(|j| (0..count).map(|i| form[i] * self.fit.covariance[(i, j)]).sum()).collect()
            })
            .collect();
        half.iter().map(|row| self.forms.iter().map(|form| product(row, form)).collect()).collect()
    }

    /// Value and standard deviation.
    fn value(&self, place: usize) -> (f64, f64) {
        let form = &self.forms[place];
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

/// A number of the chain that acts as constant errors of one frame.
pub(crate) struct ChainError {
    /// `zero of q2`, `upper_arm`.
    pub(crate) name: String,
    /// Whether it is an angle, or a pure number.
    pub(crate) is_angle: bool,
    /// The frame, from 0.
    pub(crate) frame: usize,
    /// Its six errors per unit of the number.
    pub(crate) errors: [f64; 6],
}

/// All of them: joints first.
pub(crate) fn chain_errors(spec: &Spec) -> Vec<ChainError> {
    let mut graph = Graph::with_tables(&spec.tables);
    let all = numbers(spec).into_iter().filter_map(|(name, number)| {
        let (frame, errors) = constant_errors(&mut graph, spec, number)?;
        Some(ChainError { name, is_angle: is_angle(spec, number), frame, errors })
    });
    all.collect()
}

/// Every number of the chain and its name: joints first, then what the spec names itself.
fn numbers(spec: &Spec) -> Vec<(String, ChainNumber)> {
    let joints = spec.variables.iter().enumerate();
    let joints = joints.map(|(i, joint)| (format!("zero of {}", joint.name), ChainNumber::Joint(i)));
    let parameters = spec.parameters.iter().enumerate();
    let parameters = parameters.map(|(i, parameter)| (parameter.name.clone(), ChainNumber::Parameter(i)));
    let frames = spec.frames.iter().enumerate().filter(|(_, frame)| frame.convention.is_some());
    let of_frames = frames.flat_map(|(i, frame)| {
        let name = &frame.name;
        DhNumber::ALL.map(|number| {
            (format!("{} of {name}", number.name()), ChainNumber::DenavitHartenberg { frame: i, number })
        })
    });
    joints.chain(parameters).chain(of_frames).collect()
}

/// The frame and its six errors per unit of a number, if these are the same in all configurations.
fn constant_errors(graph: &mut Graph, spec: &Spec, number: ChainNumber) -> Option<(usize, [f64; 6])> {
    let twists = frame_twists(graph, spec, number);
    let [FrameTwist { frame, velocity, rotation }] = twists[..] else { return None };
    if let Some(errors) = constant(graph, spec, velocity, rotation) {
        return Some((frame, errors));
    }
    // Ad(A): ω' = R ω, v' = R v + p × ω'.
    let before = frame.checked_sub(1)?;
    let Frame { axes, position } = transform(graph, &spec.frames[frame].factors);
    let turned = graph.turn(&axes, rotation);
    let (moved, swing) = (graph.turn(&axes, velocity), graph.cross(position, turned));
    let moved = graph.add_vectors(moved, swing);
    Some((before, constant(graph, spec, moved, turned)?))
}

fn constant(graph: &Graph, spec: &Spec, velocity: [Node; 3], rotation: [Node; 3]) -> Option<[f64; 6]> {
    let nodes = Component::ALL.map(|component| match component.is_rotation() {
        true => rotation[component.axis()],
        false => velocity[component.axis()],
    });
    let at = |sample: usize| {
        graph.evaluate(&nodes, |symbol| match symbol {
            Symbol::Variable(i) => spec.variables[i].home + (1.3 * (sample * (i + 2)) as f64).sin(),
            Symbol::Parameter(i) => spec.parameters[i].value,
            Symbol::Input(_) | Symbol::Error(_) | Symbol::Local(_) | Symbol::Magnitude(_) => f64::NAN,
        })
    };
    let first = at(0);
    let largest = first.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let same = |(a, b): (&f64, f64)| (a - b).abs() <= 1e-12 * largest;
    let constant = (1..SAMPLES).all(|sample| first.iter().zip(at(sample)).all(same));
    let errors: [f64; 6] = first.try_into().ok()?;
    constant.then_some(errors.map(|value| if value.abs() > 1e-12 * largest { value } else { 0.0 }))
}
