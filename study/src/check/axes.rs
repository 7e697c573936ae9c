//! What the rotations that sources give at frames turn about, where a reader may expect another axis.
//!
//! `E_i` stands after `A_i`: with `dh = { a = 400, … }` an `e_r` turns about an axis 400 mm from that of the frame's own
//! joint. All of it at home; with rotation ω and translation v the axis of a small motion goes through `ω × v/|ω|²`.

use std::collections::BTreeMap;

use abbe::{Component, VariableKind};
use abbe_codegen::chain::{EffectNode, effects, joint_twist, transform};
use abbe_codegen::graph::{Graph, Node};
use abbe_spec::expr::Symbol;
use abbe_spec::{Cause, Source, Spec};

use crate::number::digits;

/// How far directions and lines may differ, relative to what they are made of, and still be the same.
const SAME: f64 = 1e-9;

type Vector = [f64; 3];

/// An axis in `F_0`.
struct Axis {
    point: Vector,
    direction: Vector,
}

/// A sentence for every frame at which a source turns about another axis than that of the frame's joint, but parallel to
/// it, or about the axis of another joint.
pub(super) fn notes(spec: &Spec) -> Vec<String> {
    let plain = plain_errors(spec);
    let (mut graph, nodes) = effects(&plain);
    let turned = by_place(spec, &nodes);
    if turned.is_empty() {
        return Vec::new();
    }
    let frames = frames(&mut graph, spec);
    let joints = joint_axes(&mut graph, spec, &frames);
    let nodes: Vec<Node> = turned.values().flatten().flatten().copied().collect();
    let both = [true, false].map(|nominal| values(&graph, spec, &nodes, nominal));
    let mut first = 0;
    let mut notes = Vec::new();
    for ((source, frame), errors) in turned {
        let range = first..first + errors.iter().flatten().count();
        first = range.end;
        let Some(joint) = spec.frames[frame].variable else { continue };
        let Some(expected) = &joints[joint] else { continue };
        // With inputs at the upper ends of their ranges where those at their nominal values turn nothing.
        let axis = |values: &Vec<f64>| error_axis(&frames[frame], errors, &values[range.clone()]);
        let Some(axis) = both.iter().find_map(axis) else { continue };
        let name = &spec.variables[joint].name;
        let other = joints.iter().position(|other| other.as_ref().is_some_and(|other| axis.is(other)));
        let what = if axis.is(expected) {
            continue;
        } else if axis.is_parallel(expected) {
            let distance = digits(axis.distance(expected), 4);
            format!("an axis {distance} {} from that of {name}", spec.length.symbol())
        } else if let Some(other) = other {
            format!("the axis of {}, not of {name}", spec.variables[other].name)
        } else {
            continue;
        };
        notes.push(format!(
            "`{}` at {} turns about {what}; if the joint's own error is meant, write `joint = \"{name}\"`.",
            plain.sources[source].name, spec.frames[frame].name
        ));
    }
    notes
}

/// The errors of a source at a frame, in order of both: those at frames with a revolute joint of their own.
fn by_place(spec: &Spec, nodes: &[EffectNode]) -> BTreeMap<(usize, usize), [Option<Node>; 6]> {
    let mut places = BTreeMap::new();
    for node in nodes {
        let variable = spec.frames[node.frame].variable.map(|joint| spec.variables[joint].kind);
        if variable == Some(VariableKind::Revolute) {
            let errors = places.entry((node.source, node.frame)).or_insert([None; 6]);
            errors[node.component as usize] = Some(node.value);
        }
    }
    places
}

/// Axes and origin of every frame at home.
fn frames(graph: &mut Graph, spec: &Spec) -> Vec<[Vector; 4]> {
    let mut pose = graph.identity();
    let mut nodes = Vec::with_capacity(12 * spec.frames.len());
    for frame in &spec.frames {
        let local = transform(graph, &frame.factors);
        pose = graph.then(&pose, &local);
        nodes.extend(pose.axes.as_flattened());
        nodes.extend(pose.position);
    }
    let numbers = values(graph, spec, &nodes, true);
    numbers.chunks_exact(12).map(|twelve| std::array::from_fn(|i| vector(&twelve[3 * i..]))).collect()
}

/// The axis of every joint, at the frame that declares it.
fn joint_axes(graph: &mut Graph, spec: &Spec, frames: &[[Vector; 4]]) -> Vec<Option<Axis>> {
    let nodes = (0..spec.variables.len()).flat_map(|joint| {
        let twist = joint_twist(graph, spec, joint);
        [twist.velocity, twist.rotation].concat()
    });
    let nodes: Vec<Node> = nodes.collect();
    let numbers = values(graph, spec, &nodes, true);
    let twists = numbers.chunks_exact(6).zip(&spec.variables);
    twists.map(|(six, joint)| Axis::new(&frames[joint.frame], vector(six), vector(&six[3..]))).collect()
}

/// The spec with all its sources, and of these only what they say of frames as errors e_x … e_p.
fn plain_errors(spec: &Spec) -> Spec {
    let plain = |source: &Source| {
        let errors = source.effects.iter().filter(|effect| matches!(effect.cause, Cause::Errors(_)));
        Source {
            enabled: true,
            magnitude: None,
            effects: errors.cloned().collect(),
            deviations: Vec::new(),
            ..source.clone()
        }
    };
    Spec { sources: spec.sources.iter().map(plain).collect(), ..spec.clone() }
}

/// The axis of the errors of a frame, from their values one after the other.
fn error_axis(frame: &[Vector; 4], errors: [Option<Node>; 6], values: &[f64]) -> Option<Axis> {
    let (mut velocity, mut rotation) = ([0.0; 3], [0.0; 3]);
    let given = Component::ALL.into_iter().zip(errors).filter(|(_, error)| error.is_some());
    for ((component, _), value) in given.zip(values) {
        let part = if component.is_rotation() { &mut rotation } else { &mut velocity };
        part[component.axis()] = *value;
    }
    Axis::new(frame, velocity, rotation)
}

impl Axis {
    /// Of a small motion in the axes of a frame; none if it does not turn.
    fn new([x, y, z, origin]: &[Vector; 4], velocity: Vector, rotation: Vector) -> Option<Self> {
        let square = dot(rotation, rotation);
        if !square.is_normal() {
            return None;
        }
        let in_base =
            |v: Vector| -> Vector { std::array::from_fn(|i| x[i] * v[0] + y[i] * v[1] + z[i] * v[2]) };
        let point = in_base(cross(rotation, velocity).map(|component| component / square));
        Some(Self {
            point: std::array::from_fn(|i| origin[i] + point[i]),
            direction: in_base(rotation.map(|component| component / square.sqrt())),
        })
    }

    fn is_parallel(&self, other: &Self) -> bool {
        dot(self.direction, other.direction).abs() > 1.0 - SAME
    }

    /// Between this axis and one that is parallel to it.
    fn distance(&self, other: &Self) -> f64 {
        let between = cross(self.lever(other), self.direction);
        dot(between, between).sqrt()
    }

    fn lever(&self, other: &Self) -> Vector {
        std::array::from_fn(|i| self.point[i] - other.point[i])
    }

    fn is(&self, other: &Self) -> bool {
        let size = dot(self.point, self.point).sqrt() + dot(other.point, other.point).sqrt();
        self.is_parallel(other) && self.distance(other) <= 1e-6 * size
    }
}

/// At home, with inputs at their nominal values or the upper ends of their ranges.
fn values(graph: &Graph, spec: &Spec, nodes: &[Node], nominal: bool) -> Vec<f64> {
    graph.evaluate(nodes, |symbol| match symbol {
        Symbol::Variable(i) => spec.variables[i].home,
        Symbol::Parameter(i) => spec.parameters[i].value,
        Symbol::Input(i) if nominal => spec.inputs[i].value,
        Symbol::Input(i) => spec.inputs[i].range[1],
        Symbol::Error(_) | Symbol::Local(_) | Symbol::Magnitude(_) => f64::NAN,
    })
}

fn vector(values: &[f64]) -> Vector {
    std::array::from_fn(|i| values[i])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}
