//! Pose, error Jacobian, generalized errors and their displacement at one configuration.

use abbe_spec::option::Q;
use std::sync::Arc;

use abbe::analysis::sampling;
use abbe::{Class, Component, Description, Error, Manipulator, Pose, Quantity, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_spec::degrees::check_angle_text;
use abbe_spec::diagnostic::Span;
use abbe_spec::expr::Dimension;
use abbe_spec::value::parse_value;
use abbe_spec::{Diagnostic, Document, Spec, Variable};
use serde::Serialize;

use crate::{Machine, Notes, Result, finite, number, open_loops};

/// Job of `abbe jacobian`: evaluates `J_e` and `ε` at one configuration.
#[derive(Clone)]
pub struct Jacobian {
    /// Machine to evaluate.
    pub machine: Machine,
    /// Joint variables in order, in the length unit or rad; `None` for home.
    pub q: Option<Vec<f64>>,
}

/// Pose, error Jacobian and generalized errors at one configuration. Lengths are in the spec's
/// unit, angles in rad, vectors in `F_0`.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the manipulator.
    pub name: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Convention of rows 4–6: `rotation-vector`, `euler-yzx` or `iec-61217`.
    pub orientation: &'static str,
    /// Joint variables of the configuration.
    pub q: Vec<f64>,
    /// Nominal pose `A_T` of the tool, a homogeneous matrix, row by row.
    pub pose: [[f64; 4]; 4],
    /// Names of the rows of `J_e`.
    pub rows: [&'static str; 6],
    /// Names of the columns of `J_e`: `e_x1 … e_p1`, then those of frame 2, …
    pub columns: Vec<String>,
    /// Error Jacobian `J_e`, 6 × 6n, row by row, in products of the units of rows and columns.
    pub error_jacobian: [Vec<f64>; 6],
    /// Generalized errors `ε`, the sum of the repeatable sources, in the order of the columns.
    pub generalized_errors: Vec<f64>,
    /// Error of the tool to first order, `ΔX = J_e ε`, in the order of the rows: the length unit,
    /// then rad.
    pub displacement: [f64; 6],
    /// Pose of the tool with the repeatable errors, by the exact chain with finite rotations: a
    /// homogeneous matrix, row by row.
    pub real_pose: [[f64; 4]; 4],
    /// Forces that close the loops under the loads, to first order, one per equation.
    pub leg_forces: Vec<LegForce>,
    /// The spec, for names and units.
    #[serde(skip)]
    pub spec: Arc<Spec>,
}

/// Force that closes a loop.
#[derive(Clone, Debug, Serialize)]
pub struct LegForce {
    /// Name of the loop.
    pub name: String,
    /// `distance`, or the coordinate along or about which it acts: `x`, `y`, `z`, `rx`, `ry`, `rz`.
    pub closes: &'static str,
    /// Force in N, or moment in N·m, on the first frame of the loop; positive if a leg presses its
    /// ends apart.
    pub force: f64,
}

impl Jacobian {
    /// Evaluates the configuration. Notes each variable that is outside its limits.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let spec = &self.machine.spec;
        let interpreter = Interpreter::new(Arc::clone(spec));
        let description = interpreter.description();
        let q = self.q.clone().unwrap_or_else(|| sampling::home(description));
        for (variable, value) in spec.variables.iter().zip(&q) {
            note_beyond_limits(variable, *value, spec, notes);
        }
        for limit in spec.sum_limits.iter().filter(|limit| !limit.permits(&q)) {
            notes.note(&number::beyond_sum_limit(limit, limit.value(&q), spec.length));
        }
        let s = sampling::nominal_parameters(description);
        let u = sampling::nominal_inputs(description);
        let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
        let mut errors = vec![[0.0; 6]; description.frames.len()];
        let mut forces = vec![0.0; spec.passive.len()];
        let poses = interpreter
            .error_jacobian(&q, &s, &mut columns)
            .and_then(|_| interpreter.generalized_errors(&q, &s, &u, &mut errors))
            .and_then(|()| interpreter.leg_forces(&q, &s, &u, &mut forces))
            // The pose computed beside J_e may differ in its last bits; use the one of `pose`.
            .and_then(|()| Ok([interpreter.pose(&q, &s)?, interpreter.real_pose(&q, &s, &u)?]))
            .map_err(|error| {
                let error = first_effect(&interpreter, [&q, &s, &u], error);
                let at = number::variables(&q, spec);
                open_loops::not_evaluated(&self.machine.origin, &at, &error, description, (spec, &q, &s))
            })?;
        let leg_forces = leg_forces(spec, &forces);
        let report = Report::new(description, Arc::clone(spec), q, &poses, &columns, &errors);
        finite(&self.machine.origin, Report { leg_forces, ..report })
    }
}

impl Report {
    fn new(
        description: &Description,
        spec: Arc<Spec>,
        q: Vec<f64>,
        [pose, real_pose]: &[Pose; 2],
        columns: &[[f64; 6]],
        errors: &[[f64; 6]],
    ) -> Self {
        // Adding 0 turns −0 into 0.
        let row = |i: usize| columns.iter().map(|column| column[i] + 0.0).collect();
        let matrix = |pose: &Pose| pose.rows().map(|row| row.map(|entry| entry + 0.0));
        let errors = errors.as_flattened();
        let terms = |i: usize| columns.iter().zip(errors).map(move |(column, error)| column[i] * error);
        Self {
            name: description.name.to_string(),
            length: description.length.symbol(),
            orientation: description.orientation.name(),
            q,
            pose: matrix(pose),
            rows: description.orientation.rows(),
            columns: column_names(description.frames.len()),
            error_jacobian: std::array::from_fn(row),
            generalized_errors: errors.iter().map(|error| error + 0.0).collect(),
            displacement: std::array::from_fn(|i| terms(i).sum::<f64>() + 0.0),
            real_pose: matrix(real_pose),
            leg_forces: Vec::new(),
            spec,
        }
    }
}

/// Names the forces of the loops.
fn leg_forces(spec: &Spec, forces: &[f64]) -> Vec<LegForce> {
    let equations = spec.loops.iter().flat_map(|closed| {
        (0..closed.closure.equations()).map(|i| (closed.name.clone(), closed.closure.coordinate(i)))
    });
    // Adding 0 turns −0 into 0.
    equations
        .zip(forces)
        .map(|((name, closes), force)| LegForce { name, closes, force: force + 0.0 })
        .collect()
}

/// Returns the names of the columns of `J_e` for this number of frames: `e_x1 … e_p1`, then those
/// of frame 2, …
pub fn column_names(frames: usize) -> Vec<String> {
    let names = (1..=frames).flat_map(|i| Component::ALL.map(|component| format!("{}{i}", component.name())));
    names.collect()
}

/// Returns the error of the effect that makes a generalized error not finite, if it is the first
/// such effect; otherwise the given error.
fn first_effect(interpreter: &Interpreter, [q, s, u]: [&[f64]; 3], error: Error) -> Error {
    let description = interpreter.description();
    let mut effects = vec![0.0; description.effects.len()];
    match (error, interpreter.effects(q, s, u, &mut effects)) {
        (
            Error::NotFinite { quantity: Quantity::Errors, index },
            Err(first @ Error::NotFinite { quantity: Quantity::Effects, index: effect }),
        ) => {
            let effect = &description.effects[effect];
            let causes = 6 * effect.frame + effect.component.index() == index;
            if causes && description.sources[effect.source].class == Class::Repeatable {
                first
            } else {
                error
            }
        }
        _ => error,
    }
}

fn note_beyond_limits(variable: &Variable, value: f64, spec: &Spec, notes: &mut dyn Notes) {
    let [lower, upper] = variable.limits;
    if !(lower..=upper).contains(&value) {
        let show = |value| number::of_variable(value, variable.kind, spec.length);
        let (name, value) = (&variable.name, show(value));
        notes.note(&format!("{name} = {value} is outside its limits {} … {}", show(lower), show(upper)));
    }
}

/// Parses the values of `--q`, one per variable: `500,0.2m,0,-90deg,pi/180,0`.
pub fn read_joint_variables(text: &str, spec: &Spec) -> Result<Vec<f64>> {
    let document = Document::new(Q, text);
    let spans = value_spans(text);
    if spans.len() != spec.variables.len() {
        let names = spec.variables.iter().map(|variable| variable.name.as_str()).collect::<Vec<_>>();
        let message = format!("expected {} joint variables, found {}", names.len(), spans.len());
        let help =
            if names.is_empty() { format!("omit {Q}") } else { format!("the order is {}", names.join(",")) };
        document.mistake(Diagnostic::new(0..text.len(), message).help(help));
        return document.finish(None);
    }
    let mut q = Vec::new();
    for (variable, span) in spec.variables.iter().zip(spans) {
        let dimension = variable.kind.either(Dimension::NONE, Dimension::LENGTH);
        let what = format!("the value of `{}`", variable.name);
        if variable.kind == VariableKind::Revolute
            && check_angle_text(&text[span.clone()], &what, span.clone(), &document)
        {
            continue;
        }
        q.extend(parse_value(&document, span, spec.length, dimension, &what));
    }
    document.finish(Some(q))
}

/// Returns the spans between commas outside parentheses.
fn value_spans(text: &str) -> Vec<Span> {
    if text.trim().is_empty() {
        return Vec::new();
    }
    let (mut spans, mut start, mut depth) = (Vec::new(), 0, 0_usize);
    for (i, character) in text.char_indices() {
        match character {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                spans.push(start..i);
                start = i + 1;
            }
            _ => {}
        }
    }
    spans.push(start..text.len());
    spans
}
