//! Content of a spec, in the order of the file.

use abbe::{Class, SumLimit};
use abbe_codegen::chain::effects;
use abbe_codegen::program::{Operations, Routine, Routines};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use serde::Serialize;

use crate::number;

/// Content of a spec, and operation counts of its functions.
#[derive(Clone, Debug, Serialize)]
pub struct Facts {
    /// Name of the manipulator.
    pub name: String,
    /// Title of the manipulator.
    pub title: String,
    /// Path of the spec, or name of a shipped manipulator.
    pub spec: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Convention of rows 4–6: `rotation-vector`, `euler-yzx` or `iec-61217`.
    pub orientation: &'static str,
    /// Frames, base to tip.
    pub frames: Vec<Frame>,
    /// Joint variables, in the order of the frames.
    pub variables: Vec<Variable>,
    /// Limits of sums of joint variables; absent without any.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<Limit>,
    /// Structural parameters.
    pub parameters: Vec<NominalValue>,
    /// Inputs.
    pub inputs: Vec<NominalValue>,
    /// Error sources, disabled ones included.
    pub sources: Vec<Source>,
    /// Operation counts of the generated functions.
    pub operations: Vec<FunctionOperations>,
}

/// Frame of the chain.
#[derive(Clone, Debug, Serialize)]
pub struct Frame {
    /// Name of the frame.
    pub name: String,
    /// Name of its joint variable; `None` for a frame without a drive.
    pub variable: Option<String>,
    /// Name of its passive variable; absent if it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passive: Option<String>,
    /// Name of the frame that it hangs on, `base` for `F_0`; absent if all frames are a chain.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parent: Option<String>,
}

/// Joint variable, in the length unit or rad.
#[derive(Clone, Debug, Serialize)]
pub struct Variable {
    /// Name of the variable.
    pub name: String,
    /// Kind of the joint: `revolute` or `prismatic`.
    pub kind: &'static str,
    /// Lower and upper limit; `None` where there is no limit.
    pub limits: [Option<f64>; 2],
    /// Value at home.
    pub home: f64,
}

/// Limits of a sum of joint variables, in the length unit or rad.
#[derive(Clone, Debug, Serialize)]
pub struct Limit {
    /// Sum, as the spec writes it.
    pub sum: String,
    /// Smallest and largest sum, without the constants in it.
    pub limits: [f64; 2],
}

/// Structural parameter or input.
#[derive(Clone, Debug, Serialize)]
pub struct NominalValue {
    /// Name of the parameter or input.
    pub name: String,
    /// Nominal value, in `unit`.
    pub nominal: f64,
    /// Coherent unit; empty for a plain number.
    pub unit: String,
    /// Range of an input, in `unit`, with `None` for a missing end. Parameters have no range.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[Option<f64>; 2]>,
    /// Values of an input that are used, in `unit`; absent if it may have any in its range.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub levels: Vec<f64>,
}

/// Error source.
#[derive(Clone, Debug, Serialize)]
pub struct Source {
    /// Name of the source.
    pub name: String,
    /// Class of the source: `repeatable`, or `tolerance` or `random` with its distribution.
    pub class: String,
    /// Element of the chain that the source acts on.
    pub at: String,
    /// Number of generalized errors that the source causes.
    pub effects: usize,
    /// Indicates that the source is switched on.
    pub enabled: bool,
}

/// Operation counts of one generated function.
#[derive(Clone, Debug, Serialize)]
pub struct FunctionOperations {
    /// Name of the function.
    pub function: &'static str,
    /// Operations, by kind.
    #[serde(flatten)]
    pub operations: Operations,
}

impl Facts {
    pub(super) fn new(interpreter: &Interpreter, origin: &str) -> Self {
        let spec = interpreter.spec();
        let frames = spec.frames.iter().map(|frame| Frame {
            name: frame.name.clone(),
            variable: frame.variable.map(|i| spec.variables[i].name.clone()),
            passive: frame.passive.map(|i| spec.passive[i].name.clone()),
            parent: (!spec.is_serial())
                .then(|| frame.parent.map_or("base".to_owned(), |i| spec.frames[i].name.clone())),
        });
        let variables = spec.variables.iter().map(|variable| Variable {
            name: variable.name.clone(),
            kind: variable.kind.either("revolute", "prismatic"),
            limits: variable.limits.map(finite),
            home: variable.home,
        });
        let limit = |limit: &SumLimit| Limit { sum: limit.sum.to_string(), limits: limit.range };
        let parameters = spec.parameters.iter().map(|parameter| NominalValue {
            name: parameter.name.clone(),
            nominal: parameter.value,
            unit: parameter.unit.clone(),
            range: None,
            levels: Vec::new(),
        });
        let inputs = spec.inputs.iter().map(|input| NominalValue {
            name: input.name.clone(),
            nominal: input.value,
            unit: input.unit.clone(),
            range: Some(input.range.map(finite)),
            levels: input.levels.clone(),
        });
        let all = spec.sources.iter().map(|source| abbe_spec::Source { enabled: true, ..source.clone() });
        let (_, effects) = effects(&Spec { sources: all.collect(), ..Spec::clone(spec) });
        let mut counts = vec![0; spec.sources.len()];
        effects.iter().for_each(|effect| counts[spec.whole(effect.source)] += 1);
        let sources = spec.sources.iter().zip(counts).enumerate().filter(|(k, _)| spec.whole(*k) == *k);
        let sources = sources.map(|(_, (source, effects))| Source {
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
            orientation: spec.orientation.name(),
            frames: frames.collect(),
            variables: variables.collect(),
            limits: spec.sum_limits.iter().map(limit).collect(),
            parameters: parameters.collect(),
            inputs: inputs.collect(),
            sources: sources.collect(),
            operations: operations(interpreter.routines()),
        }
    }
}

fn class(class: Class) -> String {
    let (name, distribution) = number::class(class);
    distribution.map_or_else(|| name.to_owned(), |distribution| format!("{name}, {distribution}"))
}

/// Maps an infinite limit to `None`, since JSON has no infinity.
fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn operations(routines: &Routines) -> Vec<FunctionOperations> {
    let functions = routines.list.iter().filter(|routine| routine.function.is_some());
    let counted = |one: &Routine| FunctionOperations { function: one.name, operations: one.operations };
    functions.map(counted).collect()
}
