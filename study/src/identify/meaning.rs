//! The findings in the words of the spec: joints' zeros, parameters and Denavit-Hartenberg numbers in place of errors of
//! frames, as far as these act alike.
//!
//! In `A_i E_i` a change δ of a number of `A_i` is `E_i` with `vee(A_i⁻¹ ∂A_i/∂x) δ`, and as well `E_{i-1}` with
//! `vee(∂A_i/∂x A_i⁻¹) δ`. Where one of these is the same in all configurations, the number is a combination of constant
//! errors, and takes the place of one of them: a change of basis that leaves the machine what it is.

use abbe::Component;
use abbe::identify::{Fit, Model, Unknown};
use abbe_codegen::chain::{FrameTwist, frame_twists, transform};
use abbe_codegen::expr::{Dimension, Motion, Symbol};
use abbe_codegen::graph::{Frame, Graph, Node};
use abbe_codegen::spec::{ChainNumber, DhNumber, Spec, VariableKind};

use super::report::Meaning;
use crate::number::digits;

/// In how many configurations an error must be the same.
const SAMPLES: usize = 5;

/// Beyond how many standard deviations something counts as found.
const FOUND: f64 = 3.0;

/// What was found of the numbers of the chain.
pub(super) fn meanings(spec: &Spec, model: &Model, fit: &Fit) -> Vec<Meaning> {
    let mut basis = Basis::new(model, fit);
    let mut graph = Graph::with_tables(&spec.tables);
    let mut meanings = Vec::new();
    for (name, number) in numbers(spec) {
        let Some((frame, errors)) = constant_errors(&mut graph, spec, number) else { continue };
        meanings.extend(basis.exchange(frame, errors).map(|place| (place, name, number)));
    }
    let meaning = |(place, number, of): (usize, String, ChainNumber)| {
        let (value, standard_deviation) = basis.value(place);
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
        Meaning { in_place_of, number, value, standard_deviation, sentence }
    };
    let found = |meaning: &Meaning| meaning.value.abs() > FOUND * meaning.standard_deviation;
    meanings.into_iter().map(meaning).filter(found).collect()
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
        for (k, unknown) in model.unknowns.iter().enumerate() {
            if !matches!(unknown, Unknown::Error(..)) {
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
            let parts = self.kept_coordinates(unknown);
            coordinates.iter_mut().zip(parts).for_each(|(sum, part)| *sum += error * part);
        }
        let now: Vec<f64> = self.forms.iter().map(|form| product(form, &coordinates)).collect();
        // In standard deviations of the kept unknowns.
        let says = |place: usize| now[place].abs() / self.fit.covariance[(place, place)].max(0.0).sqrt();
        let most = (0..now.len()).map(says).fold(0.0, f64::max);
        let place = (0..now.len()).filter(|i| self.free[*i]).max_by(|a, b| says(*a).total_cmp(&says(*b)))?;
        if says(place).is_nan() || says(place) <= 1e-6 * most {
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
