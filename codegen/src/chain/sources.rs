//! ε of the sources: given errors, located errors converted to their frame, and deflections under
//! loads.

use std::collections::{BTreeMap, BTreeSet};

use abbe_core::{Class, Component};
use abbe_spec::{
    Cause, ChainNumber, Deviation, DeviationCause, Effect, Identified, Source, Spec, Symbol, Uncertain,
};

use super::{Element, FrameTwist, Loads, frame_twists, six, transform, vectors, walk::walk};
use crate::graph::{Frame, Graph, Node, Six};

/// One generalized error that a source causes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EffectNode {
    /// Index of the source among the enabled ones.
    pub source: usize,
    /// Index of the frame, from 0.
    pub frame: usize,
    /// Component of the six errors.
    pub component: Component,
    /// Value of the error.
    pub value: Node,
}

impl EffectNode {
    /// Returns the source, frame and component of the error.
    pub fn effect(&self) -> abbe_core::Effect {
        abbe_core::Effect::new(self.source, self.frame, self.component)
    }
}

/// Errors of the enabled sources at the places where they occur, for the exact chain.
#[derive(Clone, Debug, Default)]
pub(super) struct Causes {
    /// Errors at frames and elsewhere on their links, in the order of the file.
    pub(super) errors: Vec<PlacedErrors>,
    /// Deviations of numbers of the chain.
    pub(super) deviations: Vec<DeviationNode>,
}

impl Causes {
    /// Iterates over all errors mutably.
    pub(super) fn errors_mut(&mut self) -> impl Iterator<Item = &mut Node> {
        let of_numbers = self.deviations.iter_mut().map(|deviation| &mut deviation.error);
        self.errors.iter_mut().flat_map(|placed| &mut placed.errors).chain(of_numbers)
    }
}

/// Six errors at a place on a link.
#[derive(Clone, Debug)]
pub(super) struct PlacedErrors {
    /// Index of the source among the enabled ones.
    pub(super) source: usize,
    /// Index of the frame, from 0.
    pub(super) frame: usize,
    /// Pose L of the place relative to the frame; `None` for the frame itself.
    pub(super) place: Option<Frame>,
    /// Pose of the place relative to `F_0`, for errors of `F_0`.
    pub(super) of_base: Option<Frame>,
    /// The errors in the axes of the place.
    pub(super) errors: Six,
}

/// Deviation of a number of the chain.
#[derive(Clone, Debug)]
pub struct DeviationNode {
    /// Index of the source among the enabled ones.
    pub source: usize,
    /// The number that deviates.
    pub number: ChainNumber,
    /// Actual minus nominal value, times the magnitude of the source.
    pub error: Node,
}

/// Returns the effects of every enabled source, with a graph of their own.
pub fn effects(spec: &Spec) -> (Graph, Vec<EffectNode>) {
    let (graph, effects, _) = effects_and_causes(spec);
    (graph, effects)
}

/// Returns the deviations of numbers of the chain by every enabled source, with a graph of their
/// own.
pub fn deviations(spec: &Spec) -> (Graph, Vec<DeviationNode>) {
    let (graph, _, causes) = effects_and_causes(spec);
    (graph, causes.deviations)
}

/// Returns the effects and their causes, with a graph of their own. Deflections are computed in the
/// axes of their frame, so that they are affine in the sine and cosine of each angle.
pub(super) fn effects_and_causes(spec: &Spec) -> (Graph, Vec<EffectNode>, Causes) {
    let mut graph = Graph::with_tables(&spec.tables);
    let g = &mut graph;
    let identity = g.identity();
    let frames = poses(g, spec, 0);
    if !spec.loops.is_empty() {
        let loads = Loads::new(g, spec, &frames, &identity.axes);
        let (effects, causes) = effects_in(g, spec, |_| &loads);
        return (graph, effects, causes);
    }
    let effects = spec.enabled_sources().flat_map(|source| &source.effects);
    let mut elastic: BTreeSet<usize> =
        effects.filter(|effect| effect.cause.is_elastic()).map(|effect| effect.frame).collect();
    let joints = spec.enabled_sources().flat_map(|source| &source.deviations);
    for joint in joints.filter(|deviation| deviation.is_elastic()) {
        elastic.extend(frame_twists(g, spec, joint.number).first().map(|twist| twist.frame));
    }
    // From each frame with an elastic element, the poses of the frames behind it.
    let seen: BTreeMap<usize, Vec<Frame>> = elastic
        .into_iter()
        .map(|frame| (frame, [vec![identity; frame + 1], poses(g, spec, frame + 1)].concat()))
        .collect();
    let loads: BTreeMap<usize, Loads<'_>> =
        seen.iter().map(|(frame, seen)| (*frame, Loads::new(g, spec, seen, &frames[*frame].axes))).collect();
    let (effects, causes) = effects_in(g, spec, |frame| &loads[&frame]);
    (graph, effects, causes)
}

/// Returns the poses of a frame (from 0) and those behind it, relative to the frame before it.
fn poses(graph: &mut Graph, spec: &Spec, first: usize) -> Vec<Frame> {
    let identity = graph.identity();
    let mut poses: Vec<Frame> = Vec::new();
    for frame in spec.frames.iter().skip(first) {
        let before = frame.parent.and_then(|parent| parent.checked_sub(first)).map(|parent| poses[parent]);
        poses.push(walk(graph, before.unwrap_or(identity), &frame.factors, &mut Vec::new()));
    }
    poses
}

/// Returns the effects of every enabled source, source by source, without those that are always
/// zero, and their causes; `loads` gives those in the axes chosen for the elements of a frame.
pub(super) fn effects_in<'a>(
    graph: &mut Graph,
    spec: &Spec,
    loads: impl Fn(usize) -> &'a Loads<'a>,
) -> (Vec<EffectNode>, Causes) {
    let zero = graph.zero();
    let mut all: Vec<Vec<Six>> = Vec::new();
    let mut causes = Causes::default();
    for (source, declared) in spec.enabled_sources().enumerate() {
        // Several effects of one source on one error of one frame are added to one effect.
        let mut sums = vec![[zero; 6]; spec.frames.len()];
        let times = times(graph, declared);
        for effect in &declared.effects {
            let place = transform(graph, &effect.at);
            let there = at_place(graph, effect, &place, &loads);
            let place = (!effect.at.is_empty()).then_some(place);
            let errors = place.as_ref().map_or(there, |place| at_frame(graph, place, there));
            add(graph, &mut sums[effect.frame], errors);
            let errors = there.map(|error| graph.mul(times, error));
            let of_base =
                effect.is_of_base.then(|| transform(graph, &effect.at[spec.frames[0].factors.len()..]));
            causes.errors.push(PlacedErrors { source, frame: effect.frame, place, of_base, errors });
        }
        for deviation in &declared.deviations {
            let twists = frame_twists(graph, spec, deviation.number);
            let error = deviation_error(graph, deviation, &twists, &loads);
            let whole = graph.mul(times, error);
            causes.deviations.push(DeviationNode { source, number: deviation.number, error: whole });
            add_deviation(graph, &mut sums, &twists, error);
        }
        sums.as_flattened_mut().iter_mut().for_each(|sum| *sum = graph.mul(times, *sum));
        all.push(sums);
    }
    for (source, declared) in spec.enabled_sources().enumerate() {
        if declared.propagated.is_empty() {
            continue;
        }
        let propagated = propagated(graph, spec, declared, &all);
        for (frame, errors) in propagated.into_iter().enumerate().filter(|(_, errors)| *errors != [zero; 6]) {
            causes.errors.push(PlacedErrors { source, frame, place: None, of_base: None, errors });
            add(graph, &mut all[source][frame], errors);
        }
    }
    let mut nodes = Vec::new();
    for (source, frames) in all.into_iter().enumerate() {
        for (frame, sums) in frames.into_iter().enumerate() {
            for (component, value) in Component::ALL.into_iter().zip(sums) {
                if value != zero {
                    nodes.push(EffectNode { source, frame, component, value });
                }
            }
        }
    }
    (nodes, causes)
}

/// Returns the errors of each frame by the uncertain quantities x of a source with their factors σ,
/// where `all` has the errors of each enabled source:
///
/// ```text
/// Σ_x σ ∂ε/∂x        ε: sum of the repeatable sources
/// ```
fn propagated(graph: &mut Graph, spec: &Spec, source: &Source, all: &[Vec<Six>]) -> Vec<Six> {
    let mut sums = vec![[graph.zero(); 6]; spec.frames.len()];
    for (uncertain, factor) in &source.propagated {
        let factor = graph.constant(source.scale * factor);
        let mut unscaled = vec![[graph.zero(); 6]; spec.frames.len()];
        match uncertain {
            Uncertain::Input(input) => {
                let sources = spec.enabled_sources().zip(all);
                for (_, errors) in sources.filter(|(source, _)| source.class == Class::Repeatable) {
                    for (sum, errors) in unscaled.iter_mut().zip(errors) {
                        add(graph, sum, *errors);
                    }
                }
                let slopes = graph.diff_all(unscaled.as_flattened(), Symbol::Input(*input));
                unscaled.as_flattened_mut().copy_from_slice(&slopes);
            }
            // The errors of a source are proportional to its magnitude.
            Uncertain::Identified(Identified::Magnitude(of)) => {
                if let Some(of) = spec.enabled_index(*of) {
                    unscaled.clone_from(&all[of]);
                }
            }
            Uncertain::Identified(Identified::Joint(joint)) => {
                for twist in frame_twists(graph, spec, ChainNumber::Joint(*joint)) {
                    add(graph, &mut unscaled[twist.frame], six(twist.velocity, twist.rotation));
                }
            }
            Uncertain::Identified(Identified::Error(frame, component)) => {
                unscaled[*frame][*component as usize] = graph.constant(1.0);
            }
            // E_0 A_i = A_i E_i with E_i = L E_0 L⁻¹, L = A_i⁻¹, for every frame i that hangs on F_0.
            Uncertain::Identified(Identified::Base(component)) => {
                let mut there = [graph.zero(); 6];
                there[*component as usize] = graph.constant(1.0);
                for (i, frame) in spec.frames.iter().enumerate().filter(|(_, frame)| frame.parent.is_none()) {
                    let first = transform(graph, &frame.factors);
                    let place = graph.inverse(&first);
                    unscaled[i] = at_frame(graph, &place, there);
                }
            }
        }
        for (sum, errors) in sums.iter_mut().zip(unscaled) {
            let scaled = errors.map(|error| graph.mul(factor, error));
            add(graph, sum, scaled);
        }
    }
    sums
}

/// Returns the factor of all errors of a source.
fn times(graph: &mut Graph, source: &Source) -> Node {
    match source.tuned_by {
        Some(input) => graph.symbol(Symbol::Input(input)),
        None => graph.constant(source.factor()),
    }
}

/// Returns the errors of the enabled repeatable beams and compliances under loads, six per frame.
pub(super) fn elastic_errors(graph: &mut Graph, spec: &Spec, loads: &Loads<'_>) -> Vec<Six> {
    let mut sums = vec![[graph.zero(); 6]; spec.frames.len()];
    for source in spec.enabled_sources().filter(|source| source.class == Class::Repeatable) {
        let times = times(graph, source);
        for effect in source.effects.iter().filter(|effect| effect.cause.is_elastic()) {
            let place = transform(graph, &effect.at);
            let there = at_place(graph, effect, &place, |_| loads).map(|error| graph.mul(times, error));
            let errors = at_frame(graph, &place, there);
            add(graph, &mut sums[effect.frame], errors);
        }
        for deviation in source.deviations.iter().filter(|deviation| deviation.is_elastic()) {
            let twists = frame_twists(graph, spec, deviation.number);
            let error = deviation_error(graph, deviation, &twists, |_| loads);
            let error = graph.mul(times, error);
            add_deviation(graph, &mut sums, &twists, error);
        }
    }
    sums
}

/// Returns actual minus nominal value of a number of the chain, given its twists.
fn deviation_error<'a>(
    graph: &mut Graph,
    deviation: &Deviation,
    twists: &[FrameTwist],
    loads: impl Fn(usize) -> &'a Loads<'a>,
) -> Node {
    match (&deviation.cause, twists.first()) {
        (DeviationCause::Error(error), _) => graph.lower(error),
        (DeviationCause::Stiffness(stiffness), Some(first)) => {
            let load = match deviation.number {
                ChainNumber::Joint(joint) => loads(first.frame).on_symbol(graph, Symbol::Variable(joint)),
                _ => graph.zero(),
            };
            let stiffness = graph.lower(stiffness);
            graph.div(load, stiffness)
        }
        (DeviationCause::Stiffness(_), None) => graph.zero(),
    }
}

/// Adds the errors that a deviation causes at the frames with these twists.
fn add_deviation(graph: &mut Graph, sums: &mut [Six], twists: &[FrameTwist], error: Node) {
    for twist in twists {
        let (shift, turn) = (graph.scale(error, twist.velocity), graph.scale(error, twist.rotation));
        add(graph, &mut sums[twist.frame], six(shift, turn));
    }
}

fn add(graph: &mut Graph, sums: &mut Six, errors: Six) {
    for (sum, error) in sums.iter_mut().zip(errors) {
        *sum = graph.add(*sum, error);
    }
}

/// Returns ε, the sum of the repeatable sources, six errors per frame.
pub(super) fn generalized_errors(graph: &mut Graph, spec: &Spec, effects: &[EffectNode]) -> Vec<Six> {
    let sources: Vec<&Source> = spec.enabled_sources().collect();
    let mut sums = vec![[graph.zero(); 6]; spec.frames.len()];
    for effect in effects.iter().filter(|effect| sources[effect.source].class == Class::Repeatable) {
        let sum = &mut sums[effect.frame][effect.component as usize];
        *sum = graph.add(*sum, effect.value);
    }
    sums
}

/// Converts six errors at a place to errors of its frame: `E_i = L E_M L⁻¹`, to first order
///
/// ```text
/// θ_i = R_L θ_M        d_i = R_L d_M + p_L × θ_i
/// ```
fn at_frame(graph: &mut Graph, place: &Frame, there: Six) -> Six {
    let (shift, turn) = vectors(there);
    let turn = graph.turn(&place.axes, turn);
    let lever = graph.cross(place.position, turn);
    let shift = graph.turn(&place.axes, shift);
    six(graph.add_vectors(shift, lever), turn)
}

/// Returns the six errors of an effect at its place M, in the axes of M.
fn at_place<'a>(
    graph: &mut Graph,
    effect: &Effect,
    place: &Frame,
    loads: impl Fn(usize) -> &'a Loads<'a>,
) -> Six {
    match &effect.cause {
        Cause::Errors(errors) => {
            let mut six = [graph.zero(); 6];
            for (component, value) in errors {
                six[*component as usize] = graph.lower(value);
            }
            six
        }
        Cause::Beam(beam) => loads(effect.frame).bend(graph, &Element { effect, place }, beam),
        Cause::Compliance(entries) => {
            let zero = graph.zero();
            let mut lower = |entry: &Option<_>| entry.as_ref().map_or(zero, |entry| graph.lower(entry));
            let compliance = entries.each_ref().map(|row| row.each_ref().map(&mut lower));
            loads(effect.frame).give_way(graph, &Element { effect, place }, &compliance)
        }
    }
}
