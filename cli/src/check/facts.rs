//! What a spec says, in the order of the file.

use abbe_codegen::chain::Model;
use abbe_codegen::program::{Operations, functions};
use abbe_codegen::spec::{Class, Distribution, Effect, Orientation, Spec, VariableKind};
use serde::Serialize;

/// What a spec says, and how many operations its functions take.
#[derive(Serialize)]
pub(super) struct Facts<'a> {
    name: &'a str,
    title: &'a str,
    pub(super) spec: &'a str,
    length: &'static str,
    pub(super) orientation: &'static str,
    frames: Vec<Frame<'a>>,
    variables: Vec<Variable<'a>>,
    parameters: Vec<Value<'a>>,
    inputs: Vec<Value<'a>>,
    pub(super) sources: Vec<Source<'a>>,
    pub(super) operations: Vec<Function>,
}

#[derive(Serialize)]
struct Frame<'a> {
    name: &'a str,
    variable: Option<&'a str>,
}

#[derive(Serialize)]
struct Variable<'a> {
    name: &'a str,
    kind: &'static str,
    limits: [Option<f64>; 2],
    home: f64,
}

/// A parameter or an input.
#[derive(Serialize)]
struct Value<'a> {
    name: &'a str,
    nominal: f64,
    unit: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<[Option<f64>; 2]>,
}

#[derive(Serialize)]
pub(super) struct Source<'a> {
    pub(super) name: &'a str,
    pub(super) class: &'static str,
    pub(super) effects: usize,
    pub(super) enabled: bool,
}

/// The operations of one function of the generated code.
#[derive(Serialize)]
pub(super) struct Function {
    pub(super) function: &'static str,
    mul: usize,
    add: usize,
    neg: usize,
    div: usize,
    sincos: usize,
    sqrt: usize,
    other: usize,
    #[serde(skip)]
    pub(super) operations: Operations,
}

impl<'a> Facts<'a> {
    pub(super) fn new(spec: &'a Spec, origin: &'a str) -> Self {
        let variable = |i: usize| spec.variables[i].name.as_str();
        let frames = spec.frames.iter();
        let variables = spec.variables.iter().map(|variable| Variable {
            name: &variable.name,
            kind: kind(variable.kind),
            limits: variable.limits.map(finite),
            home: variable.home,
        });
        let parameters = spec.parameters.iter();
        let inputs = spec.inputs.iter().map(|input| Value {
            name: &input.name,
            nominal: input.value,
            unit: &input.unit,
            range: Some(input.range.map(finite)),
        });
        let sources = spec.sources.iter().map(|source| Source {
            name: &source.name,
            class: class(source.class),
            effects: source.effects.iter().map(Effect::error_count).sum(),
            enabled: source.enabled,
        });
        Self {
            name: &spec.name,
            title: &spec.title,
            spec: origin,
            length: spec.length.symbol(),
            orientation: match spec.orientation {
                Orientation::RotationVector => "rotation-vector",
                Orientation::EulerYzx => "euler-yzx",
            },
            frames: frames
                .map(|frame| Frame { name: &frame.name, variable: frame.variable.map(variable) })
                .collect(),
            variables: variables.collect(),
            parameters: parameters
                .map(|p| Value { name: &p.name, nominal: p.value, unit: &p.unit, range: None })
                .collect(),
            inputs: inputs.collect(),
            sources: sources.collect(),
            operations: operations(spec),
        }
    }
}

pub(super) fn kind(kind: VariableKind) -> &'static str {
    match kind {
        VariableKind::Revolute => "revolute",
        VariableKind::Prismatic => "prismatic",
    }
}

fn class(class: Class) -> &'static str {
    match class {
        Class::Repeatable => "repeatable",
        Class::Random(Distribution::Uniform) => "random, uniform",
        Class::Random(Distribution::Normal) => "random, normal",
    }
}

/// JSON has no infinity: where there is no limit stands null.
fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn operations(spec: &Spec) -> Vec<Function> {
    let counted = functions(&Model::new(spec)).into_iter().map(|(kind, program)| {
        let operations = program.operations();
        let Operations { mul, add, neg, div, sincos, sqrt, other } = operations;
        Function { function: kind.name(), mul, add, neg, div, sincos, sqrt, other, operations }
    });
    counted.collect()
}
