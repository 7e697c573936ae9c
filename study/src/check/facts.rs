//! What a spec says, in the order of the file.

use abbe::{Class, Distribution, Orientation, VariableKind};
use abbe_codegen::chain::effects;
use abbe_codegen::program::{Operations, Routines};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use serde::Serialize;

/// What a spec says, and how many operations its functions take.
#[derive(Clone, Debug, Serialize)]
pub struct Facts {
    /// The manipulator.
    pub name: String,
    /// Its name for people.
    pub title: String,
    /// The spec's file, or the shipped name.
    pub spec: String,
    /// The unit of every length.
    pub length: &'static str,
    /// What rows 4–6 are: `rotation-vector` or `euler-yzx`.
    pub orientation: &'static str,
    /// Base to tip.
    pub frames: Vec<Frame>,
    /// The joint variables, in the order of the frames.
    pub variables: Vec<Variable>,
    /// The structural parameters.
    pub parameters: Vec<Value>,
    /// The inputs.
    pub inputs: Vec<Value>,
    /// The sources, those that are switched off among them.
    pub sources: Vec<Source>,
    /// What the functions of the generated code take.
    pub operations: Vec<Function>,
}

/// A frame.
#[derive(Clone, Debug, Serialize)]
pub struct Frame {
    /// Its name.
    pub name: String,
    /// Its variable; a fixed frame has none.
    pub variable: Option<String>,
}

/// A joint variable, in the length unit or rad.
#[derive(Clone, Debug, Serialize)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// `revolute` or `prismatic`.
    pub kind: &'static str,
    /// Lower and upper limit, if there are any.
    pub limits: [Option<f64>; 2],
    /// Its value at home.
    pub home: f64,
}

/// A parameter or an input.
#[derive(Clone, Debug, Serialize)]
pub struct Value {
    /// Its name.
    pub name: String,
    /// Its nominal value.
    pub nominal: f64,
    /// Its coherent unit.
    pub unit: String,
    /// The range of an input: no end where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[Option<f64>; 2]>,
}

/// An error source.
#[derive(Clone, Debug, Serialize)]
pub struct Source {
    /// Its name.
    pub name: String,
    /// `repeatable`, or `random` with its distribution.
    pub class: &'static str,
    /// What it is an error of.
    pub at: String,
    /// How many generalized errors it causes.
    pub effects: usize,
    /// Whether it takes part.
    pub enabled: bool,
}

/// The operations of one function of the generated code.
#[derive(Clone, Debug, Serialize)]
pub struct Function {
    /// Its name.
    pub function: &'static str,
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Changes of sign.
    pub neg: usize,
    /// Divisions.
    pub div: usize,
    /// Sines and cosines of one angle.
    pub sincos: usize,
    /// Square roots.
    pub sqrt: usize,
    /// All others.
    pub other: usize,
    /// The same, as they are displayed.
    #[serde(skip)]
    pub operations: Operations,
}

impl Facts {
    pub(super) fn new(interpreter: &Interpreter, origin: &str) -> Self {
        let spec = interpreter.spec();
        let frames = spec.frames.iter().map(|frame| Frame {
            name: frame.name.clone(),
            variable: frame.variable.map(|i| spec.variables[i].name.clone()),
        });
        let variables = spec.variables.iter().map(|variable| Variable {
            name: variable.name.clone(),
            kind: kind(variable.kind),
            limits: variable.limits.map(finite),
            home: variable.home,
        });
        let parameters = spec.parameters.iter().map(|parameter| Value {
            name: parameter.name.clone(),
            nominal: parameter.value,
            unit: parameter.unit.clone(),
            range: None,
        });
        let inputs = spec.inputs.iter().map(|input| Value {
            name: input.name.clone(),
            nominal: input.value,
            unit: input.unit.clone(),
            range: Some(input.range.map(finite)),
        });
        let all = spec.sources.iter().map(|source| abbe_spec::Source { enabled: true, ..source.clone() });
        let (_, effects) = effects(&Spec { sources: all.collect(), ..Spec::clone(spec) });
        let mut counts = vec![0; spec.sources.len()];
        effects.iter().for_each(|effect| counts[effect.source] += 1);
        let sources = spec.sources.iter().zip(counts).map(|(source, effects)| Source {
            name: source.name.clone(),
            class: class(source.class),
            at: spec.place(source),
            effects,
            enabled: source.enabled,
        });
        Self {
            name: spec.name.clone(),
            title: spec.title.clone(),
            spec: origin.to_owned(),
            length: spec.length.symbol(),
            orientation: match spec.orientation {
                Orientation::RotationVector => "rotation-vector",
                Orientation::EulerYzx => "euler-yzx",
            },
            frames: frames.collect(),
            variables: variables.collect(),
            parameters: parameters.collect(),
            inputs: inputs.collect(),
            sources: sources.collect(),
            operations: operations(interpreter.routines()),
        }
    }
}

fn kind(kind: VariableKind) -> &'static str {
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
        Class::Random(Distribution::Triangular) => "random, triangular",
        Class::Random(Distribution::Arcsine) => "random, arcsine",
    }
}

/// JSON has no infinity: where there is no limit stands null.
fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn operations(routines: &Routines) -> Vec<Function> {
    let functions = routines.list.iter().filter(|routine| routine.function.is_some());
    let counted = functions.map(|routine| {
        let operations = routine.operations;
        let Operations { mul, add, neg, div, sincos, sqrt, other } = operations;
        Function { function: routine.name, mul, add, neg, div, sincos, sqrt, other, operations }
    });
    counted.collect()
}
