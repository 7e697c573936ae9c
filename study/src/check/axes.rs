//! Axes of rotational errors that differ from the axis a reader may expect.
//!
//! `E_i` stands after `A_i`: with `dh = { a = 400, … }` an `e_r` rotates about an axis 400 mm from
//! that of the frame's joint. All axes are at home. The axis of a small motion with rotation ω and
//! translation v passes through `ω × v/|ω|²`.

use std::collections::BTreeMap;

use abbe::analysis::sampling::vectors::{add, cross, dot, norm, subtract};
use abbe::{Component, VariableKind};
use abbe_codegen::chain::{EffectNode, effects, joint_twist, transform};
use abbe_codegen::graph::{Graph, Node};
use abbe_spec::{Cause, Source, Spec, expr::Symbol};

use crate::{closing::value_at_home, number::digits};

/// Tolerance on the cosine between parallel directions.
const SAME: f64 = 1e-9;

type Vector = [f64; 3];

/// Axis in `F_0`.
struct Axis {
    point: Vector,
    direction: Vector,
}

/// Returns a sentence for each frame with a source whose rotation axis is parallel to the frame's
/// joint axis but apart from it, or is the axis of another joint. None if the frames are not a
/// chain.
pub(super) fn notes(spec: &Spec) -> Vec<String> {
    if !spec.is_serial() {
        return Vec::new();
    }
    let plain = plain_errors(spec);
    let (mut graph, nodes) = effects(&plain);
    let turned = by_source_and_frame(spec, &nodes);
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
        // Second attempt: inputs at the upper ends of their ranges, if the nominal inputs cause no
        // rotation.
        let axis = |values: &Vec<f64>| error_axis(&frames[frame], errors, &values[range.clone()]);
        let Some(axis) = both.iter().find_map(axis) else { continue };
        let name = &spec.variables[joint].name;
        let other =
            joints.iter().position(|other| other.as_ref().is_some_and(|other| axis.coincides_with(other)));
        let what = if axis.coincides_with(expected) {
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
            "`{}` at {} rotates about {what}; for an error of the joint itself, write `joint = \
             \"{name}\"`.",
            plain.sources[source].name, spec.frames[frame].name
        ));
    }
    notes
}

/// Groups the errors by source and frame, for frames with a revolute joint of their own.
fn by_source_and_frame(spec: &Spec, nodes: &[EffectNode]) -> BTreeMap<(usize, usize), [Option<Node>; 6]> {
    let mut groups = BTreeMap::new();
    for node in nodes {
        let variable = spec.frames[node.frame].variable.map(|joint| spec.variables[joint].kind);
        if variable == Some(VariableKind::Revolute) {
            let errors = groups.entry((node.source, node.frame)).or_insert([None; 6]);
            errors[node.component as usize] = Some(node.value);
        }
    }
    groups
}

/// Returns the axes and origin of each frame at home, in `F_0`.
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

/// Returns the axis of each joint, located at the frame that declares the joint.
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

/// Returns the spec with all sources enabled, reduced to their errors e_x … e_p at frames.
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

/// Returns the axis of a frame's errors. `values` holds the values of those errors that are given,
/// in order.
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
    /// Creates the axis of a small motion in a frame's axes; returns `None` if it has no rotation.
    fn new([x, y, z, origin]: &[Vector; 4], velocity: Vector, rotation: Vector) -> Option<Self> {
        let square = dot(rotation, rotation);
        if !square.is_normal() {
            return None;
        }
        let in_base =
            |v: Vector| -> Vector { std::array::from_fn(|i| x[i] * v[0] + y[i] * v[1] + z[i] * v[2]) };
        let point = in_base(cross(rotation, velocity).map(|component| component / square));
        let direction = in_base(rotation.map(|component| component / square.sqrt()));
        Some(Self { point: add(*origin, point), direction })
    }

    fn is_parallel(&self, other: &Self) -> bool {
        dot(self.direction, other.direction).abs() > 1.0 - SAME
    }

    /// Returns the distance to a parallel axis.
    fn distance(&self, other: &Self) -> f64 {
        norm(cross(subtract(self.point, other.point), self.direction))
    }

    fn coincides_with(&self, other: &Self) -> bool {
        let size = norm(self.point) + norm(other.point);
        self.is_parallel(other) && self.distance(other) <= 1e-6 * size
    }
}

/// Evaluates nodes at home, with inputs at their nominal values or at the upper ends of their
/// ranges.
fn values(graph: &Graph, spec: &Spec, nodes: &[Node], nominal: bool) -> Vec<f64> {
    graph.evaluate(nodes, |symbol| match symbol {
        Symbol::Input(i) if !nominal => spec.inputs[i].range[1],
        symbol => value_at_home(symbol, spec),
    })
}

fn vector(values: &[f64]) -> Vector {
    std::array::from_fn(|i| values[i])
}
