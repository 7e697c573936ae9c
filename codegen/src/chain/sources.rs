//! ε of the sources: what is given, what a located error is at its frame, what gives way under loads.

use super::deviation::frame_twists;
use super::walk::transform;
use crate::expr::{Motion, motion};
use crate::graph::{Frame, Graph, Node, Vector};
use crate::spec::{Beam, Cause, Class, Component, Effect, Source, Spec};

/// One generalized error that a source causes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EffectNode {
    /// The source, among those that are switched on.
    pub source: usize,
    /// The frame, from 0.
    pub frame: usize,
    /// Which of its six errors.
    pub component: Component,
    /// Its value.
    pub value: Node,
}

impl EffectNode {
    /// What it acts on.
    pub fn effect(&self) -> abbe::Effect {
        abbe::Effect::new(self.source, self.frame, self.component)
    }
}

/// The effects of every enabled source, source by source, without those that are always zero.
pub(super) fn effects(graph: &mut Graph, spec: &Spec, frames: &[Frame]) -> Vec<EffectNode> {
    let loads = loads(graph, spec, frames);
    let zero = graph.zero();
    let mut nodes = Vec::new();
    for (source, declared) in spec.enabled_sources().enumerate() {
        // Several effects of one source on one error of one frame are one effect.
        let mut sums = vec![[zero; 6]; frames.len()];
        for effect in &declared.effects {
            let errors = at_frame(graph, effect, &frames[effect.frame], &loads);
            add(graph, &mut sums[effect.frame], errors);
        }
        for deviation in &declared.deviations {
            let error = graph.lower(&deviation.error);
            for twist in frame_twists(graph, spec, deviation.number) {
                let (shift, turn) = (graph.scale(error, twist.velocity), graph.scale(error, twist.rotation));
                add(graph, &mut sums[twist.frame], six(shift, turn));
            }
        }
        if let Some(magnitude) = declared.magnitude {
            let times = graph.constant(magnitude.value);
            sums.as_flattened_mut().iter_mut().for_each(|sum| *sum = graph.mul(times, *sum));
        }
        for (frame, sums) in sums.into_iter().enumerate() {
            for (component, value) in Component::ALL.into_iter().zip(sums) {
                if value != zero {
                    nodes.push(EffectNode { source, frame, component, value });
                }
            }
        }
    }
    nodes
}

fn add(graph: &mut Graph, sums: &mut [Node; 6], errors: [Node; 6]) {
    for (sum, error) in sums.iter_mut().zip(errors) {
        *sum = graph.add(*sum, error);
    }
}

/// ε: the sum of the repeatable sources, six errors per frame.
pub(super) fn generalized_errors(graph: &mut Graph, spec: &Spec, effects: &[EffectNode]) -> Vec<[Node; 6]> {
    let sources: Vec<&Source> = spec.enabled_sources().collect();
    let mut sums = vec![[graph.zero(); 6]; spec.frames.len()];
    for effect in effects.iter().filter(|effect| sources[effect.source].class == Class::Repeatable) {
        let sum = &mut sums[effect.frame][effect.component as usize];
        *sum = graph.add(*sum, effect.value);
    }
    sums
}

/// The six errors of an effect at its frame: `E_i = L E_M L⁻¹`, to first order
///
/// ```text
/// θ_i = R_L θ_M        d_i = R_L d_M + p_L × θ_i
/// ```
fn at_frame(graph: &mut Graph, effect: &Effect, frame: &Frame, loads: &[Force]) -> [Node; 6] {
    let place = transform(graph, &effect.at);
    let there = match &effect.cause {
        Cause::Errors(errors) => {
            let mut six = [graph.zero(); 6];
            for (component, value) in errors {
                six[*component as usize] = graph.lower(value);
            }
            six
        }
        Cause::Beam(beam) => {
            let compliance = beam_compliance(graph, beam);
            give_way(graph, effect, frame, &place, loads, &compliance)
        }
        Cause::Compliance(entries) => {
            let zero = graph.zero();
            let mut lower = |entry: &Option<_>| entry.as_ref().map_or(zero, |entry| graph.lower(entry));
            let compliance = entries.each_ref().map(|row| row.each_ref().map(&mut lower));
            give_way(graph, effect, frame, &place, loads, &compliance)
        }
    };
    if effect.at.is_empty() {
        return there;
    }
    let (shift, turn) = vectors(there);
    let turn = graph.turn(&place.axes, turn);
    let lever = graph.cross(place.position, turn);
    let shift = graph.turn(&place.axes, shift);
    six(graph.add_vectors(shift, lever), turn)
}

/// `ε = C w` at a place on the link of a frame, with the wrench of every load on that frame or behind it.
fn give_way(
    graph: &mut Graph,
    effect: &Effect,
    frame: &Frame,
    place: &Frame,
    loads: &[Force],
    compliance: &[[Node; 6]; 6],
) -> [Node; 6] {
    let there = graph.then(frame, place);
    let mut force = [graph.zero(); 3];
    let mut moment = force;
    for load in loads.iter().filter(|load| load.frame >= effect.frame) {
        force = graph.add_vectors(force, load.force);
        let lever = graph.sub_vectors(load.point, there.position);
        let part = graph.cross(lever, load.force);
        moment = graph.add_vectors(moment, part);
    }
    // Rᵀ v: its components along the axes.
    let local = |graph: &mut Graph, v: Vector| there.axes.map(|axis| graph.dot(axis, v));
    let (force, moment) = (local(graph, force), local(graph, moment));
    let wrench = six(force, moment);
    compliance.map(|row| {
        let products: Vec<Node> = row.iter().zip(wrench).map(|(c, w)| graph.mul(*c, w)).collect();
        products.into_iter().fold(graph.zero(), |sum, product| graph.add(sum, product))
    })
}

/// Euler–Bernoulli: the tip of a clamped beam along a, with b and c the axes that follow it in cyclic order.
///
/// ```text
/// δ_a = F_a L/EA      δ_b = F_b L³/3EI_c + M_c L²/2EI_c      δ_c = F_c L³/3EI_b − M_b L²/2EI_b
/// θ_a = M_a L/GJ      θ_c = F_b L²/2EI_c + M_c L/EI_c        θ_b = M_b L/EI_b − F_c L²/2EI_b
/// ```
fn beam_compliance(graph: &mut Graph, beam: &Beam) -> [[Node; 6]; 6] {
    let index = |kind: Motion, axis: usize| {
        Component::ALL.iter().position(|c| motion(*c) == (kind, axis)).expect("six components")
    };
    let shift = |axis: usize| index(Motion::Translation, axis % 3);
    let turn = |axis: usize| index(Motion::Rotation, axis % 3);
    let length = graph.lower(&beam.length);
    let (a, b, c) = (beam.axis, beam.axis + 1, beam.axis + 2);
    let mut compliance = [[graph.zero(); 6]; 6];
    if let Some(extension) = &beam.extension {
        let stiffness = graph.lower(extension);
        compliance[shift(a)][shift(a)] = graph.div(length, stiffness);
    }
    if let Some(torsion) = &beam.torsion {
        let stiffness = graph.lower(torsion);
        compliance[turn(a)][turn(a)] = graph.div(length, stiffness);
    }
    // Bending about c moves along b; about b it moves along −c.
    for (along, about, stiffness, sign) in [(b, c, &beam.bending[1], 1.0), (c, b, &beam.bending[0], -1.0)] {
        let stiffness = graph.lower(stiffness);
        let angle = graph.div(length, stiffness);
        let (two, three) = (graph.constant(2.0 * sign), graph.constant(3.0));
        let square = graph.mul(angle, length);
        let mixed = graph.div(square, two);
        let cube = graph.mul(square, length);
        compliance[turn(about)][turn(about)] = angle;
        compliance[turn(about)][shift(along)] = mixed;
        compliance[shift(along)][turn(about)] = mixed;
        compliance[shift(along)][shift(along)] = graph.div(cube, three);
    }
    compliance
}

/// A load in `F_0`.
struct Force {
    frame: usize,
    point: Vector,
    force: Vector,
}

fn loads(graph: &mut Graph, spec: &Spec, frames: &[Frame]) -> Vec<Force> {
    let Some(gravity) = &spec.gravity else {
        return Vec::new();
    };
    let gravity = gravity.each_ref().map(|component| graph.lower(component));
    let force = |load: &crate::spec::Load| {
        let frame = &frames[load.frame];
        let point = load.point.each_ref().map(|coordinate| graph.lower(coordinate));
        let offset = graph.turn(&frame.axes, point);
        let mass = graph.lower(&load.mass);
        Force {
            frame: load.frame,
            point: graph.add_vectors(frame.position, offset),
            force: graph.scale(mass, gravity),
        }
    };
    spec.loads.iter().map(force).collect()
}

/// Translation and rotation, x y z, of six values in the order of ε.
pub(super) fn vectors(six: [Node; 6]) -> (Vector, Vector) {
    let (mut shift, mut turn) = ([six[0]; 3], [six[0]; 3]);
    for (component, node) in Component::ALL.into_iter().zip(six) {
        match motion(component) {
            (Motion::Translation, axis) => shift[axis] = node,
            (Motion::Rotation, axis) => turn[axis] = node,
        }
    }
    (shift, turn)
}

/// Six values in the order of ε from two vectors.
fn six(shift: Vector, turn: Vector) -> [Node; 6] {
    Component::ALL.map(|component| match motion(component) {
        (Motion::Translation, axis) => shift[axis],
        (Motion::Rotation, axis) => turn[axis],
    })
}
