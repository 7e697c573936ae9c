//! What the rotations that sources give at frames turn about, where a reader may expect another axis.
//!
//! `E_i` stands after `A_i`: with `dh = { a = 400, … }` an `e_r` turns about an axis 400 mm from that of the frame's own
//! joint. All of it at home; with rotation ω and translation v the axis of a small motion goes through `ω × v/|ω|²`.

use abbe_codegen::chain::{effects, frame_twists, transform};
use abbe_codegen::expr::Symbol;
use abbe_codegen::graph::{Frame, Graph, Node};
use abbe_codegen::spec::{Cause, ChainNumber, Component, Source, Spec, VariableKind};

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
    let g = &mut graph;
    let mut pose = g.identity();
    let mut frames = Vec::new();
    for frame in &spec.frames {
        let local = transform(g, &frame.factors);
        pose = g.then(&pose, &local);
        frames.push(numbers(g, spec, &pose, true));
    }
    let joints: Vec<Option<Axis>> =
        (0..spec.variables.len()).map(|joint| joint_axis(g, spec, &frames, joint)).collect();
    let mut notes = Vec::new();
    for (source, declared) in plain.sources.iter().enumerate() {
        for (frame, own) in spec.frames.iter().enumerate() {
            let Some(joint) = own.variable.filter(|&j| spec.variables[j].kind == VariableKind::Revolute)
            else {
                continue;
            };
            let Some(expected) = &joints[joint] else { continue };
            let mut errors = [None; 6];
            for node in nodes.iter().filter(|node| (node.source, node.frame) == (source, frame)) {
                errors[node.component as usize] = Some(node.value);
            }
            let Some(axis) = error_axis(g, spec, &frames[frame], errors) else { continue };
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
                declared.name, own.name
            ));
        }
    }
    notes
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

/// The axis of a joint, at the first frame that it turns.
fn joint_axis(graph: &mut Graph, spec: &Spec, frames: &[[Vector; 4]], joint: usize) -> Option<Axis> {
    let twists = frame_twists(graph, spec, ChainNumber::Joint(joint));
    let twist = twists.iter().find(|twist| twist.frame == spec.variables[joint].frame)?;
    let evaluated = values(graph, spec, &[twist.velocity, twist.rotation].concat(), true);
    Axis::new(&frames[twist.frame], vector(&evaluated[..3]), vector(&evaluated[3..]))
}

/// The axis of the errors of a frame, with inputs at the upper ends of their ranges where those at their nominal values
/// turn nothing.
fn error_axis(graph: &Graph, spec: &Spec, frame: &[Vector; 4], errors: [Option<Node>; 6]) -> Option<Axis> {
    [true, false].into_iter().find_map(|nominal| {
        let (mut velocity, mut rotation) = ([0.0; 3], [0.0; 3]);
        for (component, node) in Component::ALL.into_iter().zip(errors) {
            let Some(node) = node else { continue };
            let value = values(graph, spec, &[node], nominal)[0];
            let part = if component.is_rotation() { &mut rotation } else { &mut velocity };
            part[component.axis()] = value;
        }
        Axis::new(frame, velocity, rotation)
    })
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

/// Axes and origin of a frame at home.
fn numbers(graph: &Graph, spec: &Spec, frame: &Frame, nominal: bool) -> [Vector; 4] {
    let nodes = [&frame.axes[..], &[frame.position]].concat().concat();
    let evaluated = values(graph, spec, &nodes, nominal);
    std::array::from_fn(|column| vector(&evaluated[3 * column..3 * column + 3]))
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
