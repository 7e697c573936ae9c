//! Deflection of beams and compliances under loads.
//!
//! An element carries the loads of the frames behind its own and of its own frame; among them are
//! the forces of loops whose frames it does not carry all, see [`Reaction`]. A beam extends
//! from its end M back to its clamped end. A load of the beam's own frame acts where the load's
//! point projects onto the beam: beyond M it acts at M, before the clamped end not at all.

use abbe_core::Component;
use abbe_spec::{Axes, Beam, Cause, Effect, Function, Load, Motion, Point, Spec, Symbol, motion};

use super::deviation::transform_twists;
use super::tree::{Parts, Reaction, length_slopes};
use super::{six, transform, vectors};
use crate::graph::{Frame, Graph, Node, Six, Vector};

/// Six errors per unit of force and moment, both in the order of ε.
type Compliance = [Six; 6];

/// A beam or compliance on the link of a frame.
pub(super) struct Element<'a> {
    pub(super) effect: &'a Effect,
    /// Pose of M relative to the frame.
    pub(super) place: &'a Frame,
}

/// Loads on the structure, in the axes of one frame B: `F_0`, or that of an element, where each
/// angle occurs in a wrench only once. B is `F_0` if there are loops.
pub(super) struct Loads<'a> {
    spec: &'a Spec,
    /// Poses of all frames relative to B; of those before an element, any.
    frames: &'a [Frame],
    acting: Vec<Acting>,
    weights: Vec<Weight<'a>>,
    /// Forces of the loops.
    reactions: Vec<Reaction>,
}

/// A force and a moment at a point.
#[derive(Clone, Copy)]
struct Acting {
    /// Index of the frame that the point is fixed to.
    frame: usize,
    /// The point relative to that frame.
    point: Vector,
    /// Force in the axes of B.
    force: Vector,
    /// Moment in the axes of B.
    moment: Vector,
}

/// Weight of a beam.
struct Weight<'a> {
    effect: &'a Effect,
    /// Pose of the beam's end M relative to its frame.
    end: Frame,
    axis: usize,
    length: Node,
    /// Force per unit of length, in the axes of B.
    force: Vector,
}

impl<'a> Loads<'a> {
    /// Collects the loads of a spec; `axes` are those of B in `F_0`.
    pub(super) fn new(graph: &mut Graph, spec: &'a Spec, frames: &'a [Frame], axes: &'a [Vector; 3]) -> Self {
        let zero = [graph.zero(); 3];
        let gravity = spec.gravity.as_ref();
        let gravity = gravity.map_or(zero, |gravity| gravity.each_ref().map(|entry| graph.lower(entry)));
        let gravity = local(graph, axes, gravity);
        let view = View { frames, axes };
        let acting = spec.loads.iter().map(|load| acting(graph, spec, load, &view, gravity)).collect();
        let mut weights = Vec::new();
        for effect in spec.enabled_sources().flat_map(|source| &source.effects) {
            let Cause::Beam(beam) = &effect.cause else { continue };
            if let Some(mass) = &beam.mass_per_length {
                let (end, mass) = (transform(graph, &effect.at), graph.lower(mass));
                let (length, force) = (graph.lower(&beam.length), graph.scale(mass, gravity));
                weights.push(Weight { effect, end, axis: beam.axis, length, force });
            }
        }
        let mut loads = Self { spec, frames, acting, weights, reactions: Vec::new() };
        if !spec.loops.is_empty() {
            let passive = (0..spec.passive.len()).map(Symbol::Local);
            let on_passive: Vec<Node> = passive.map(|symbol| loads.on_symbol(graph, symbol)).collect();
            let parts = Parts::new(graph, spec);
            loads.reactions = parts.reactions(graph, &on_passive);
        }
        loads
    }

    /// Returns the forces that close the loops, in N and N·m, one per equation.
    pub(super) fn of_loops(&self, graph: &mut Graph) -> Vec<Node> {
        let (mut forces, length) = (Vec::new(), self.spec.length.in_metres());
        for (closed, reaction) in self.spec.loops.iter().zip(&self.reactions) {
            for (i, force) in reaction.forces.iter().enumerate() {
                let unit = if closed.closure.is_angle(i) { length * length } else { length };
                let unit = graph.constant(unit);
                forces.push(graph.mul(unit, *force));
            }
        }
        forces
    }

    /// Creates a single force at the tool point, in the axes that the frames' poses are given in.
    pub(super) fn at_tool(graph: &mut Graph, spec: &'a Spec, frames: &'a [Frame], force: Vector) -> Self {
        let point = transform(graph, &spec.tool).position;
        let acting = Acting { frame: spec.tool_frame, point, force, moment: [graph.zero(); 3] };
        Self { spec, frames, acting: vec![acting], weights: Vec::new(), reactions: Vec::new() }
    }

    /// Returns the errors `ε = C w` of a compliance, in its axes.
    pub(super) fn give_way(&self, graph: &mut Graph, element: &Element<'_>, compliance: &Compliance) -> Six {
        let there = graph.then(&self.frames[element.effect.frame], element.place);
        let mut carried = self.carried(graph, element);
        for weight in self.weights.iter().filter(|weight| weight.effect.frame == element.effect.frame) {
            // Only the part of the beam beyond the compliance loads it.
            let before = graph.sub_vectors(element.place.position, weight.end.position);
            let along = graph.dot(weight.end.axes[weight.axis], before);
            let beyond = back(graph, along, weight.length);
            carried.push(weight.of_last(graph, beyond));
        }
        let wrench = self.wrench(graph, &there.axes, there.position, &carried);
        product(graph, compliance, wrench)
    }

    /// Returns the deflection of a beam's end M relative to its clamped end, in the axes of M.
    ///
    /// A load at a distance ℓ before the end bends the beam up to that point; the rest stays
    /// straight and rotates:
    ///
    /// ```text
    /// (δ, θ) = C(L − ℓ) w        δ_M = δ + θ × ℓ a        θ_M = θ
    /// ```
    pub(super) fn bend(&self, graph: &mut Graph, element: &Element<'_>, beam: &Beam) -> Six {
        let there = graph.then(&self.frames[element.effect.frame], element.place);
        let length = graph.lower(&beam.length);
        let axis = element.place.axes[beam.axis];
        let mut carried = self.carried(graph, element);
        for weight in self.weights.iter().filter(|weight| weight.effect.frame == element.effect.frame) {
            if !std::ptr::eq(weight.effect, element.effect) {
                carried.push(weight.of_last(graph, weight.length));
            }
        }
        let (mut beyond, mut within) = (Vec::new(), Vec::new());
        for load in carried {
            let lever = graph.sub_vectors(load.point, element.place.position);
            let along = graph.dot(axis, lever);
            let behind = load.frame != element.effect.frame;
            let back = if behind { graph.zero() } else { back(graph, along, length) };
            if back == graph.zero() { beyond.push(load) } else { within.push((back, load)) }
        }
        let compliance = beam_compliance(graph, beam, length);
        let wrench = self.wrench(graph, &there.axes, there.position, &beyond);
        let mut sum = product(graph, &compliance, wrench);
        for (back, load) in within {
            let offset = graph.scale(back, there.axes[beam.axis]);
            let at = graph.sub_vectors(there.position, offset);
            let wrench = self.wrench(graph, &there.axes, at, &[load]);
            let up_to_there = graph.sub(length, back);
            let compliance = beam_compliance(graph, beam, up_to_there);
            let (shift, turn) = vectors(product(graph, &compliance, wrench));
            let mut rest = [graph.zero(); 3];
            rest[beam.axis] = back;
            let shift = graph.add_cross(shift, turn, rest);
            sum = add(graph, sum, six(shift, turn));
        }
        if let Some(weight) = self.weights.iter().find(|weight| std::ptr::eq(weight.effect, element.effect)) {
            let force = local(graph, &there.axes, weight.force);
            let under_own_weight = own_weight(graph, beam, length, force);
            sum = add(graph, sum, under_own_weight);
        }
        sum
    }

    /// Returns the moment of the loads about a joint, or the force along it: their power per unit
    /// of the joint's speed, with the twists `(v, ω)` of the frames whose transform has the joint,
    /// the wrenches `(f, m)` of all loads at and behind these, at the origins of the frames, and
    /// the lengths l of legs, whose forces are λ:
    ///
    /// ```text
    /// Σ_i  v_i · f_i + ω_i · m_i  −  Σ_k  λ_k ∂l_k/∂q
    /// ```
    pub(super) fn on_symbol(&self, graph: &mut Graph, symbol: Symbol) -> Node {
        let mut sum = graph.zero();
        let at_rest = [[graph.zero(); 3]; 2];
        let twists = transform_twists(graph, self.spec, symbol);
        for twist in twists.iter().filter(|twist| [twist.velocity, twist.rotation] != at_rest) {
            let mut carried = self.at_or_behind(graph, twist.frame);
            let weights = self.weights.iter();
            for weight in weights.filter(|weight| self.spec.carries(twist.frame, weight.effect.frame)) {
                carried.push(weight.of_last(graph, weight.length));
            }
            let Frame { axes, position } = self.frames[twist.frame];
            let (force, moment) = vectors(self.wrench(graph, &axes, position, &carried));
            for (velocity, load) in [(twist.velocity, force), (twist.rotation, moment)] {
                let power = graph.dot(velocity, load);
                sum = graph.add(sum, power);
            }
        }
        for (reaction, slope) in self.reactions.iter().zip(length_slopes(graph, self.spec, symbol)) {
            sum = graph.sub_product(sum, reaction.forces[0], slope);
        }
        sum
    }

    /// Returns the loads at a frame and the frames behind it.
    fn at_or_behind(&self, graph: &mut Graph, frame: usize) -> Vec<Acting> {
        let (carries, point) = (|other: usize| self.spec.carries(frame, other), [graph.zero(); 3]);
        let mut carried: Vec<Acting> =
            self.acting.iter().filter(|load| carries(load.frame)).copied().collect();
        for Reaction { wrenches, .. } in &self.reactions {
            let here = |frame: &Option<usize>| frame.is_some_and(carries);
            // The wrenches of a loop that is carried as a whole add up to zero.
            if !wrenches.iter().all(|(frame, _)| here(frame)) {
                for (frame, [force, moment]) in wrenches.iter().copied().filter(|(frame, _)| here(frame)) {
                    carried.extend(frame.map(|frame| Acting { frame, point, force, moment }));
                }
            }
        }
        carried
    }

    /// Returns the loads at and behind the element's frame, and the weights of all beams of frames
    /// behind it.
    fn carried(&self, graph: &mut Graph, element: &Element<'_>) -> Vec<Acting> {
        let frame = element.effect.frame;
        let mut carried = self.at_or_behind(graph, frame);
        let behind = |weight: &&Weight<'_>| {
            weight.effect.frame != frame && self.spec.carries(frame, weight.effect.frame)
        };
        carried.extend(self.weights.iter().filter(behind).map(|weight| weight.of_last(graph, weight.length)));
        carried
    }

    /// Returns the force and moment of loads about a point, in the given axes and the order of ε.
    fn wrench(&self, graph: &mut Graph, axes: &[Vector; 3], about: Vector, loads: &[Acting]) -> Six {
        let mut force = [graph.zero(); 3];
        let mut moment = force;
        for load in loads {
            let frame = &self.frames[load.frame];
            let offset = graph.turn(&frame.axes, load.point);
            let point = graph.add_vectors(frame.position, offset);
            force = graph.add_vectors(force, load.force);
            let lever = graph.sub_vectors(point, about);
            moment = graph.add_cross(moment, lever, load.force);
            moment = graph.add_vectors(moment, load.moment);
        }
        six(local(graph, axes, force), local(graph, axes, moment))
    }
}

/// Poses relative to B, and the axes of B in `F_0`.
struct View<'a> {
    frames: &'a [Frame],
    axes: &'a [Vector; 3],
}

fn acting(graph: &mut Graph, spec: &Spec, load: &Load, view: &View<'_>, gravity: Vector) -> Acting {
    let zero = [graph.zero(); 3];
    let point = match &load.point {
        Point::Here(point) => point.each_ref().map(|coordinate| graph.lower(coordinate)),
        Point::Tool => transform(graph, &spec.tool).position,
    };
    let mut in_view = |vector: &Option<[_; 3]>| {
        let vector = vector.as_ref().map_or(zero, |vector| vector.each_ref().map(|entry| graph.lower(entry)));
        match load.axes {
            Axes::Frame => graph.turn(&view.frames[load.frame].axes, vector),
            Axes::Base => local(graph, view.axes, vector),
        }
    };
    let (force, moment) = (in_view(&load.force), in_view(&load.moment));
    let weight = match &load.mass {
        Some(mass) => {
            let mass = graph.lower(mass);
            graph.scale(mass, gravity)
        }
        None => zero,
    };
    Acting { frame: load.frame, point, force: graph.add_vectors(weight, force), moment }
}

impl Weight<'_> {
    /// Returns the weight of the beam's last part of this length, at the middle of that part.
    fn of_last(&self, graph: &mut Graph, length: Node) -> Acting {
        let two = graph.constant(2.0);
        let half = graph.div(length, two);
        let offset = graph.scale(half, self.end.axes[self.axis]);
        Acting {
            frame: self.effect.frame,
            point: graph.sub_vectors(self.end.position, offset),
            force: graph.scale(length, self.force),
            moment: [graph.zero(); 3],
        }
    }
}

/// Returns the distance of a point before the end of a beam, clamped to its length:
/// `min(max(−along, 0), length)`.
fn back(graph: &mut Graph, along: Node, length: Node) -> Node {
    let minus = graph.neg(along);
    let back = match graph.value(minus) {
        Some(value) => graph.constant(value.max(0.0)),
        None => {
            let (size, two) = (graph.call(Function::Abs, minus), graph.constant(2.0));
            let twice = graph.add(minus, size);
            graph.div(twice, two)
        }
    };
    if back == graph.zero() {
        return back;
    }
    if let (Some(back), Some(length)) = (graph.value(back), graph.value(length)) {
        return graph.constant(back.min(length));
    }
    // min(a, b) = (a + b − |a − b|)/2
    let (sum, difference) = (graph.add(back, length), graph.sub(back, length));
    let (size, two) = (graph.call(Function::Abs, difference), graph.constant(2.0));
    let twice = graph.sub(sum, size);
    graph.div(twice, two)
}

/// Returns the components along axes: `Rᵀ v`.
fn local(graph: &mut Graph, axes: &[Vector; 3], v: Vector) -> Vector {
    axes.map(|axis| graph.dot(axis, v))
}

fn add(graph: &mut Graph, a: Six, b: Six) -> Six {
    std::array::from_fn(|i| graph.add(a[i], b[i]))
}

/// Returns `C w`.
fn product(graph: &mut Graph, compliance: &Compliance, wrench: Six) -> Six {
    compliance.map(|row| graph.products(&row, &wrench))
}

/// Returns the index in ε of a motion along or about an axis. Axis numbers wrap at 3.
fn index(kind: Motion, axis: usize) -> usize {
    Component::ALL.iter().position(|c| motion(*c) == (kind, axis % 3)).expect("six components")
}

/// Euler–Bernoulli compliance of the end of a clamped beam along a. The axes b and c follow a in
/// cyclic order.
///
/// ```text
/// δ_a = F_a L/EA      δ_b = F_b L³/3EI_c + M_c L²/2EI_c      δ_c = F_c L³/3EI_b − M_b L²/2EI_b
/// θ_a = M_a L/GJ      θ_c = F_b L²/2EI_c + M_c L/EI_c        θ_b = M_b L/EI_b − F_c L²/2EI_b
/// ```
fn beam_compliance(graph: &mut Graph, beam: &Beam, length: Node) -> Compliance {
    let shift = |axis: usize| index(Motion::Translation, axis);
    let turn = |axis: usize| index(Motion::Rotation, axis);
    let (a, b, c) = (beam.axis, beam.axis + 1, beam.axis + 2);
    let mut compliance = [[graph.zero(); 6]; 6];
    for (stiffness, along) in [(&beam.extension, shift(a)), (&beam.torsion, turn(a))] {
        if let Some(stiffness) = stiffness {
            let stiffness = graph.lower(stiffness);
            compliance[along][along] = graph.div(length, stiffness);
        }
    }
    // Bending about c displaces along b; bending about b along −c.
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

/// Returns the deflection of the end under a force w per unit of length, `∫ C(x) w dx`:
///
/// ```text
/// δ_a = w_a L²/2EA      δ_b = w_b L⁴/8EI_c      δ_c = w_c L⁴/8EI_b      θ_c = w_b L³/6EI_c      θ_b = −w_c L³/6EI_b
/// ```
fn own_weight(graph: &mut Graph, beam: &Beam, length: Node, force: Vector) -> Six {
    let mut errors = [graph.zero(); 6];
    let (a, b, c) = (beam.axis, beam.axis + 1, beam.axis + 2);
    let power = |graph: &mut Graph, exponent: f64, divisor: f64| {
        let (power, divisor) = (graph.power(length, exponent), graph.constant(divisor));
        graph.div(power, divisor)
    };
    if let Some(extension) = &beam.extension {
        let (stiffness, square) = (graph.lower(extension), power(graph, 2.0, 2.0));
        let per_length = graph.div(force[a], stiffness);
        errors[index(Motion::Translation, a)] = graph.mul(per_length, square);
    }
    for (along, about, stiffness, sign) in [(b, c, &beam.bending[1], 1.0), (c, b, &beam.bending[0], -1.0)] {
        let stiffness = graph.lower(stiffness);
        let per_length = graph.div(force[along % 3], stiffness);
        let (fourth, third) = (power(graph, 4.0, 8.0), power(graph, 3.0, 6.0 * sign));
        errors[index(Motion::Translation, along)] = graph.mul(per_length, fourth);
        errors[index(Motion::Rotation, about)] = graph.mul(per_length, third);
    }
    errors
}
