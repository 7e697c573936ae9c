//! ε of the sources: what is given, what a located error is at its frame, what gives way under loads.

use abbe_core::{Class, Component};
use abbe_spec::expr::Symbol;
use abbe_spec::{Cause, ChainNumber, Effect, Source, Spec};

use super::deviation::frame_twists;
use super::elastic::{Element, Loads};
use super::six::{six, vectors};
use super::walk::{transform, walk};
use crate::graph::{Frame, Graph, Node};

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
    pub fn effect(&self) -> abbe_core::Effect {
        abbe_core::Effect::new(self.source, self.frame, self.component)
    }
}

/// What the enabled sources cause where they cause it: for the exact chain.
#[derive(Clone, Debug, Default)]
pub(super) struct Causes {
    /// Errors at frames and at places on their links, in the order of the file.
    pub(super) errors: Vec<PlacedErrors>,
    /// Numbers of the chain that are off.
    pub(super) deviations: Vec<DeviationNode>,
}

impl Causes {
    /// Every error.
    pub(super) fn errors_mut(&mut self) -> impl Iterator<Item = &mut Node> {
        let of_numbers = self.deviations.iter_mut().map(|deviation| &mut deviation.error);
        self.errors.iter_mut().flat_map(|placed| &mut placed.errors).chain(of_numbers)
    }
}

/// Six errors at a place.
#[derive(Clone, Debug)]
pub(super) struct PlacedErrors {
    /// The source, among those that are switched on.
    pub(super) source: usize,
    /// The frame, from 0.
    pub(super) frame: usize,
    /// The place L on its link; none if it is the frame itself.
    pub(super) place: Option<Frame>,
    /// In the axes of the place.
    pub(super) errors: [Node; 6],
}

/// How much more a number of the chain is.
#[derive(Clone, Debug)]
pub(super) struct DeviationNode {
    /// The source, among those that are switched on.
    pub(super) source: usize,
    /// Which number.
    pub(super) number: ChainNumber,
    /// How much more.
    pub(super) error: Node,
}

/// The effects of every enabled source by themselves, and the graph they are in.
pub fn effects(spec: &Spec) -> (Graph, Vec<EffectNode>) {
    let (graph, effects, _) = effects_and_causes(spec);
    (graph, effects)
}

/// The same, and what causes them.
pub(super) fn effects_and_causes(spec: &Spec) -> (Graph, Vec<EffectNode>, Causes) {
    let mut graph = Graph::with_tables(&spec.tables);
    let mut at = graph.identity();
    let mut frames = Vec::new();
    for frame in &spec.frames {
        at = walk(&mut graph, at, &frame.factors, &mut Vec::new());
        frames.push(at);
    }
    let (effects, causes) = effects_in(&mut graph, spec, &frames);
    (graph, effects, causes)
}

/// The effects of every enabled source, source by source, without those that are always zero, and what causes them.
pub(super) fn effects_in(graph: &mut Graph, spec: &Spec, frames: &[Frame]) -> (Vec<EffectNode>, Causes) {
    let loads = Loads::new(graph, spec, frames);
    let zero = graph.zero();
    let mut nodes = Vec::new();
    let mut causes = Causes::default();
    for (source, declared) in spec.enabled_sources().enumerate() {
        // Several effects of one source on one error of one frame are one effect.
        let mut sums = vec![[zero; 6]; frames.len()];
        let times = times(graph, declared);
        for effect in &declared.effects {
            let place = transform(graph, &effect.at);
            let there = at_place(graph, effect, &place, &loads);
            let place = (!effect.at.is_empty()).then_some(place);
            let errors = place.as_ref().map_or(there, |place| at_frame(graph, place, there));
            add(graph, &mut sums[effect.frame], errors);
            let errors = there.map(|error| graph.mul(times, error));
            causes.errors.push(PlacedErrors { source, frame: effect.frame, place, errors });
        }
        for deviation in &declared.deviations {
            let error = graph.lower(&deviation.error);
            let whole = graph.mul(times, error);
            causes.deviations.push(DeviationNode { source, number: deviation.number, error: whole });
            for twist in frame_twists(graph, spec, deviation.number) {
                let (shift, turn) = (graph.scale(error, twist.velocity), graph.scale(error, twist.rotation));
                add(graph, &mut sums[twist.frame], six(shift, turn));
            }
        }
        sums.as_flattened_mut().iter_mut().for_each(|sum| *sum = graph.mul(times, *sum));
        for (frame, sums) in sums.into_iter().enumerate() {
            for (component, value) in Component::ALL.into_iter().zip(sums) {
                if value != zero {
                    nodes.push(EffectNode { source, frame, component, value });
                }
            }
        }
    }
    (nodes, causes)
}

/// What the errors of a source are multiplied by.
fn times(graph: &mut Graph, source: &Source) -> Node {
    match source.tuned_by {
        Some(input) => graph.symbol(Symbol::Input(input)),
        None => graph.constant(source.magnitude.map_or(1.0, |magnitude| magnitude.value)),
    }
}

/// What the enabled repeatable beams and compliances do under loads, six errors per frame.
pub(super) fn elastic_errors(graph: &mut Graph, spec: &Spec, loads: &Loads) -> Vec<[Node; 6]> {
    let mut sums = vec![[graph.zero(); 6]; spec.frames.len()];
    for source in spec.enabled_sources().filter(|source| source.class == Class::Repeatable) {
        let times = times(graph, source);
        for effect in source.effects.iter().filter(|effect| effect.cause.is_elastic()) {
            let place = transform(graph, &effect.at);
            let there = at_place(graph, effect, &place, loads).map(|error| graph.mul(times, error));
            let errors = at_frame(graph, &place, there);
            add(graph, &mut sums[effect.frame], errors);
        }
    }
    sums
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

/// Six errors at a place as errors of its frame: `E_i = L E_M L⁻¹`, to first order
///
/// ```text
/// θ_i = R_L θ_M        d_i = R_L d_M + p_L × θ_i
/// ```
fn at_frame(graph: &mut Graph, place: &Frame, there: [Node; 6]) -> [Node; 6] {
    let (shift, turn) = vectors(there);
    let turn = graph.turn(&place.axes, turn);
    let lever = graph.cross(place.position, turn);
    let shift = graph.turn(&place.axes, shift);
    six(graph.add_vectors(shift, lever), turn)
}

/// The six errors of an effect at its place M, in the axes of that.
fn at_place(graph: &mut Graph, effect: &Effect, place: &Frame, loads: &Loads) -> [Node; 6] {
    match &effect.cause {
        Cause::Errors(errors) => {
            let mut six = [graph.zero(); 6];
            for (component, value) in errors {
                six[*component as usize] = graph.lower(value);
            }
            six
        }
        Cause::Beam(beam) => loads.bend(graph, &Element { effect, place }, beam),
        Cause::Compliance(entries) => {
            let zero = graph.zero();
            let mut lower = |entry: &Option<_>| entry.as_ref().map_or(zero, |entry| graph.lower(entry));
            let compliance = entries.each_ref().map(|row| row.each_ref().map(&mut lower));
            loads.give_way(graph, &Element { effect, place }, &compliance)
        }
    }
}
