//! Platforms on legs: distances between joints of the tool's body and of the base, each with a
//! drive of its own.
//!
//! The pose gives the place p of the joint on the platform. With that of the other joint, b, the
//! length l of the leg gives its drive q:
//!
//! ```text
//! leg that extends, l = l_0 + l_1 q         q = (|p − b| − l_0) / l_1
//! slide along d, b = b_0 + q d, w = p − b_0  |w − q d| = l:  q = w·d ± √((w·d)² − w² + l²)
//! crank about n, b = c + R(q) u, w = p − c   w² + u² − l² − 2 w·u_∥ − 2 w·u_⊥ cos q − 2 w·(n × u) sin q = 0
//! ```
//!
//! Further legs of the same drive, as the second rod of a delta's arm, are conditions.

use abbe_core::VariableKind;
use abbe_spec::{Closure, Elementary, Expression, Factor, Function, Motion, Spec, Symbol};

use super::{Angle, Joint, Line, Partial, Probes, Rounding, at_zero, line, linear, reject};
use crate::chain::lower_pairs;
use crate::graph::{Frame, Graph, Node, Vector};

/// Relative difference of places and directions that count as equal: targets have rounding errors,
/// in single precision as well.
const CLOSED: f64 = 1e-6;
/// Freedoms of a body in space.
const FREEDOMS: usize = 6;

/// Leg whose joint on the platform is where the target has it.
struct Leg {
    drive: usize,
    length: Node,
    on_platform: Vector,
    /// The other joint with all drives at zero.
    on_base: Vector,
    /// Axis of the drive, if it moves that joint.
    line: Option<Line>,
}

/// Returns all solutions; `None` if the loops are other than such legs, or if passive joints have
/// limits or permit other motions than those of [`reached`].
pub(super) fn solve(g: &mut Graph, spec: &Spec, target: Frame, free: &[Angle]) -> Option<Vec<Partial>> {
    let path = spec.path(Some(spec.tool_frame));
    let of = |frames: &[usize]| -> Vec<&Factor> {
        frames.iter().flat_map(|frame| &spec.frames[*frame].factors).collect()
    };
    let last = path.iter().rposition(|frame| !joints(&of(&[*frame])).is_empty())?;
    let (moving, body) = path.split_at(last + 1);
    let is_limited = spec.passive.iter().any(|joint| joint.limits.iter().any(|limit| limit.is_finite()));
    let tool: Vec<&Factor> = of(body).into_iter().chain(&spec.tool).collect();
    if is_limited || !joints(&tool).is_empty() {
        return None;
    }
    let tool = at_zeros(g, &tool);
    let back = g.inverse(&tool);
    let (mut probes, mut places, mut legs) = (Probes::new(spec), Vec::new(), Vec::new());
    for closed in &spec.loops {
        let Closure::Distance(length) = &closed.closure else { return None };
        let [first, second] = closed.frames.map(|end| spec.path(end));
        let (rest, end) = match (first.strip_prefix(moving), second.strip_prefix(moving)) {
            (Some(rest), None) => (of(rest), &second),
            (None, Some(rest)) => (of(rest), &first),
            _ => return None,
        };
        let (on_base, line) = base_joint(g, spec, end)?;
        let drive = match (&joints_of([length])[..], line) {
            ([Symbol::Variable(drive)], None) => *drive,
            ([], Some((drive, _))) => drive,
            _ => return None,
        };
        if !joints(&rest).is_empty() {
            return None;
        }
        let joint = at_zeros(g, &rest);
        let joint = g.then(&back, &joint);
        let on_platform = g.then(&target, &joint).position;
        let length = g.lower(length);
        places.extend(joint.position.into_iter().chain(on_base));
        places.push(driven(g, length, drive, 0.0));
        legs.push(Leg { drive, length, on_platform, on_base, line: line.map(|(_, line)| line) });
    }
    probes.measure(g, &places);
    let moving = of(moving);
    let exists = reached(g, spec, &moving, &tool, &target, &probes)?;
    let mut partials = vec![Partial { joints: Vec::new(), exists }];
    for (drive, variable) in spec.variables.iter().enumerate() {
        let own: Vec<&Leg> = legs.iter().filter(|leg| leg.drive == drive).collect();
        let (first, others) = own.split_first()?;
        if first.line.is_none() && variable.kind == VariableKind::Revolute {
            return None;
        }
        let mut options = first.joints(g, free[drive], probes.size)?;
        for (joint, exists) in &mut options {
            exists.extend(others.iter().map(|leg| leg.closes(g, joint, probes.size)));
        }
        let with = |partial: &Partial, (joint, exists): &(Joint, Vec<Node>)| Partial {
            joints: [&partial.joints[..], &[*joint]].concat(),
            exists: [&partial.exists[..], exists].concat(),
        };
        let all = partials.iter().flat_map(|partial| options.iter().map(|option| with(partial, option)));
        partials = all.collect();
    }
    Some(partials)
}

impl Leg {
    /// Returns the values of the drive, and what must not be negative; `None` if its length is not
    /// linear.
    fn joints(&self, g: &mut Graph, free: Angle, size: f64) -> Option<Vec<(Joint, Vec<Node>)>> {
        let Some(line) = &self.line else {
            let slope = g.diff(self.length, Symbol::Variable(self.drive));
            if g.symbols(&[slope]).contains(&Symbol::Variable(self.drive)) {
                return None;
            }
            let (distance, least) = (self.distance(g, self.on_base), driven(g, self.length, self.drive, 0.0));
            let way = g.sub(distance, least);
            return Some(vec![(Joint::Slide(g.div(way, slope)), Vec::new())]);
        };
        let square = g.mul(self.length, self.length);
        if line.kind == VariableKind::Prismatic {
            let w = g.sub_vectors(self.on_platform, self.on_base);
            let (height, ww) = (g.dot(line.along, w), g.dot(w, w));
            let (hh, beyond) = (g.mul(height, height), g.sub(square, ww));
            let (rest, zero) = (g.add(hh, beyond), g.zero());
            let (least, slack) = (g.max(rest, zero), g.constant(Rounding::Cosine.size(g) * size * size));
            let (half, exists) = (g.sqrt(least), g.add(rest, slack));
            let ends = [g.sub(height, half), g.add(height, half)];
            return Some(ends.map(|end| (Joint::Slide(end), vec![exists])).to_vec());
        }
        let (w, u) = (g.sub_vectors(self.on_platform, line.at), g.sub_vectors(self.on_base, line.at));
        let flat = reject(g, line.along, u);
        let (along, beyond) = (g.sub_vectors(u, flat), g.cross(line.along, u));
        let [ww, uu, wa, wf, wb] =
            [(w, w), (u, u), (w, along), (w, flat), (w, beyond)].map(|(a, b)| g.dot(a, b));
        let [wa, wf, wb] = [wa, wf, wb].map(|part| g.add(part, part));
        let k = g.add(ww, uu);
        let k = g.sub(k, square);
        let (k, c, s) = (g.sub(k, wa), g.neg(wf), g.neg(wb));
        let roots = linear(g, [k, c, s], free, size * size);
        Some(roots.map(|root| (Joint::Turn(root), Vec::new())).to_vec())
    }

    /// Returns what is not negative if the leg has its length at a value of the drive.
    fn closes(&self, g: &mut Graph, joint: &Joint, size: f64) -> Node {
        let (end, length) = match (joint, &self.line) {
            (Joint::Turn(root), Some(line)) => {
                let away = g.sub_vectors(self.on_base, line.at);
                let turned = root.angle.turn(g, line.along, away);
                (g.add_vectors(line.at, turned), self.length)
            }
            (Joint::Slide(way), Some(line)) => (g.add_scaled(self.on_base, *way, line.along), self.length),
            (Joint::Slide(way), None) => {
                let symbol = Symbol::Variable(self.drive);
                let length = g.substitute(&[self.length], |given| (given == symbol).then_some(*way))[0];
                (self.on_base, length)
            }
            (Joint::Turn(_), None) => return g.constant(-1.0),
        };
        let distance = self.distance(g, end);
        let open = g.sub(distance, length);
        near_zero(g, open, size)
    }

    /// Returns the distance of the joint on the platform from a place.
    fn distance(&self, g: &mut Graph, place: Vector) -> Node {
        let way = g.sub_vectors(self.on_platform, place);
        g.norm(way)
    }
}

/// Returns what is not negative where passive joints reach the target: six of them every pose,
/// others rotations about one direction n, or none, and translations in a plane, across n if there
/// is one, or in space. Returns `None` for other motions.
///
/// With the tool at `R_0, p_0` if all joints are at zero, and m across the plane:
///
/// ```text
/// R R_0ᵀ n = n, or R = R_0        m · (p − p_0) = 0
/// ```
fn reached(
    g: &mut Graph,
    spec: &Spec,
    moving: &[&Factor],
    body: &Frame,
    target: &Frame,
    probes: &Probes,
) -> Option<Vec<Node>> {
    let (mut at, mut turns, mut slides) = (g.identity(), Vec::new(), Vec::new());
    for factor in moving {
        if !joints(&[factor]).is_empty() {
            let (motion, along) = match factor {
                Factor::Elementary(Elementary { motion, axis, .. }) => (motion, at.axes[*axis]),
                Factor::About { motion, axis, .. } => {
                    let local = axis.map(|component| g.constant(component));
                    (motion, g.turn(&at.axes, local))
                }
                Factor::Matrix(_) => return None,
            };
            if *motion == Motion::Rotation { &mut turns } else { &mut slides }.push(along);
        }
        at = at_zero(g, at, factor);
    }
    let count = turns.len() + slides.len();
    if count != spec.passive.len() || joints(moving).iter().any(|joint| matches!(joint, Symbol::Variable(_)))
    {
        return None;
    }
    if count == FREEDOMS {
        return Some(Vec::new());
    }
    let zero = g.then(&at, body);
    let all_zero = |g: &mut Graph, nodes: &[Node]| probes.are_zero(g, nodes, 1.0);
    let mut differences = Vec::new();
    let normal = if let Some(axis) = turns.first() {
        let crosses: Vec<Node> = turns.iter().flat_map(|other| g.cross(*axis, *other)).collect();
        let heights: Vec<Node> = slides.iter().map(|slide| g.dot(*axis, *slide)).collect();
        let is_plane = count == 3 && all_zero(g, &heights);
        if !all_zero(g, &crosses) || !is_plane && count != 4 {
            return None;
        }
        let local = zero.axes.map(|column| g.dot(column, *axis));
        let image = g.turn(&target.axes, local);
        differences.extend(g.sub_vectors(image, *axis));
        is_plane.then_some(*axis)
    } else {
        let axes = zero.axes.iter().flatten().zip(target.axes.iter().flatten());
        differences.extend(axes.map(|(a, b)| g.sub(*a, *b)));
        match slides[..] {
            [first, second] => Some(g.cross(first, second)),
            [_, _, _] => None,
            _ => return None,
        }
    };
    let mut exists: Vec<Node> = differences.into_iter().map(|node| near_zero(g, node, 1.0)).collect();
    if let Some(normal) = normal {
        let away = g.sub_vectors(target.position, zero.position);
        let height = g.dot(normal, away);
        exists.push(near_zero(g, height, probes.size));
    }
    Some(exists)
}

/// Returns what is not negative if a node of a size is 0 but for rounding errors.
fn near_zero(g: &mut Graph, node: Node, size: f64) -> Node {
    let (least, size) = (g.call(Function::Abs, node), g.constant(CLOSED * size));
    g.sub(size, least)
}

/// Returns the place of a joint on the base, and its drive, a lower pair. Returns `None` if more
/// moves it.
fn base_joint(g: &mut Graph, spec: &Spec, path: &[usize]) -> Option<(Vector, Option<(usize, Line)>)> {
    let (mut at, mut found) = (g.identity(), None);
    let is_pair = lower_pairs(spec);
    for frame in path {
        for factor in &spec.frames[*frame].factors {
            match joints(&[factor])[..] {
                [] => {}
                [Symbol::Variable(own)] if is_pair[*frame] && found.is_none() => {
                    found = Some((own, line(g, &at, factor, own, spec.variables[own].kind)));
                }
                _ => return None,
            }
            at = at_zero(g, at, factor);
        }
    }
    Some((at.position, found))
}

/// Returns the pose behind factors with all joints at zero.
fn at_zeros(g: &mut Graph, factors: &[&Factor]) -> Frame {
    let identity = g.identity();
    factors.iter().fold(identity, |at, factor| at_zero(g, at, factor))
}

/// Returns a node with a drive at a value.
fn driven(g: &mut Graph, node: Node, drive: usize, value: f64) -> Node {
    let value = g.constant(value);
    g.substitute(&[node], |symbol| (symbol == Symbol::Variable(drive)).then_some(value))[0]
}

/// Returns the joint variables and passive variables of factors, each once.
fn joints(factors: &[&Factor]) -> Vec<Symbol> {
    joints_of(factors.iter().flat_map(|factor| factor.expressions()))
}

/// Returns the joint variables and passive variables of expressions, each once.
fn joints_of<'e>(expressions: impl IntoIterator<Item = &'e Expression>) -> Vec<Symbol> {
    let symbols = expressions.into_iter().flat_map(Expression::symbols);
    let mut found: Vec<Symbol> = symbols.filter(|symbol| symbol.is_joint()).collect();
    found.sort_unstable();
    found.dedup();
    found
}
