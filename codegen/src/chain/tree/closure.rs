//! Equations of a loop, and their rates.
//!
//! With the frames a and b of a loop, c the frame that b hangs on, and `d = p_a − p_b`:
//!
//! ```text
//! position    R_cᵀ d                         R_cᵀ (v_a − v_b − ω_c × d)
//! rotation    vee(R_cᵀ W R_c), W = R_a R_bᵀ  R_cᵀ ((tr W I − W)(ω_a − ω_c) − (tr W I − Wᵀ)(ω_b − ω_c)) / 2
//! distance    |d| − l                        d · (v_a − v_b) / |d| − l̇
//! ```
//!
//! `vee` takes the vector of the antisymmetric part. The rates of the rotation follow from `[ω] W +
//! Wᵀ [ω] = [(tr W I − W) ω]`.
//!
//! Errors of the lengths of legs and struts are errors of the frames at their ends.

use abbe_spec::{Closure, Loop, Spec, Symbol};

use super::view::{Motion, View};
use crate::chain::FrameTwist;
use crate::graph::{Frame, Graph, Node, Vector, in_programs, transposed};

/// Frames of a loop.
#[derive(Clone, Copy)]
pub(super) struct Ends {
    first: Option<usize>,
    second: Option<usize>,
    /// The frame in whose axes coordinates are given.
    axes: Option<usize>,
}

impl Ends {
    /// Returns the frames of a loop. The axes of a distance are those of its second frame: they
    /// have no influence.
    pub(super) fn new(spec: &Spec, closed: &Loop) -> Self {
        let [first, second] = closed.frames;
        let axes = match closed.closure {
            Closure::Coordinates(_) => second.and_then(|second| spec.frames[second].parent),
            Closure::Distance(_) => second,
        };
        Self { first, second, axes }
    }

    /// Returns `true` if a frame is one of them.
    pub(super) fn contains(self, frame: usize) -> bool {
        [self.first, self.second, self.axes].contains(&Some(frame))
    }

    /// Returns the last frame that carries all of them; `None` for `F_0`.
    pub(super) fn root(self, spec: &Spec) -> Option<usize> {
        let paths = [self.first, self.second, self.axes].map(|frame| spec.path(frame));
        paths[0].iter().rev().find(|frame: &&usize| paths.iter().all(|path| path.contains(frame))).copied()
    }
}

/// Returns the equations of a loop, which are zero where it closes, from the poses of its frames.
pub(super) fn residual(
    graph: &mut Graph,
    ends: Ends,
    closure: &Closure,
    length: Option<Node>,
    pose: impl Fn(Option<usize>) -> Frame,
) -> Vec<Node> {
    let [a, b, c] = [ends.first, ends.second, ends.axes].map(pose);
    let difference = graph.sub_vectors(a.position, b.position);
    match (closure, length) {
        (Closure::Coordinates(coordinates), _) => {
            let mut rows = c.axes.map(|axis| graph.dot(axis, difference)).to_vec();
            if coordinates.iter().any(|coordinate| *coordinate >= 3) {
                // Entry (i, j) of W is the sum over the columns of a and b.
                let relative = relative(graph, &a, &b);
                let antisymmetric: Vector = std::array::from_fn(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    graph.sub(relative[j][k], relative[k][j])
                });
                let half = graph.constant(0.5);
                let vector = graph.scale(half, antisymmetric);
                rows.extend(c.axes.map(|axis| graph.dot(axis, vector)));
            }
            coordinates.iter().map(|coordinate| rows[*coordinate]).collect()
        }
        (Closure::Distance(_), length) => {
            let distance = graph.norm(difference);
            let length = length.unwrap_or(graph.zero());
            vec![graph.sub(distance, length)]
        }
    }
}

/// Returns numbers that are positive unless a rotation closes upside down. Where `n_k sin θ = 0`
/// closes equation k of a turn by θ about n,
///
/// ```text
/// tr W − c_k · W c_k = 1 + cos θ        if n_k = 0, which is right
///                    = −2 n_k²          if θ = 180°
/// ```
pub(super) fn upright(
    graph: &mut Graph,
    ends: Ends,
    closure: &Closure,
    pose: impl Fn(Option<usize>) -> Frame,
) -> Vec<Node> {
    let Closure::Coordinates(coordinates) = closure else { return Vec::new() };
    let [a, b, c] = [ends.first, ends.second, ends.axes].map(pose);
    let turns = coordinates.iter().filter_map(|coordinate| coordinate.checked_sub(3));
    let relative = relative(graph, &a, &b);
    let about = |k: usize| {
        let rest = traced(graph, &relative, c.axes[k]);
        graph.dot(c.axes[k], rest)
    };
    turns.map(about).collect()
}

/// Returns the rates of the equations under motions of frames; `length` is the rate of the length.
pub(super) fn rate(
    graph: &mut Graph,
    view: &View<'_>,
    ends: Ends,
    closure: &Closure,
    motions: &[Motion],
    length: Node,
) -> Vec<Node> {
    let all = [ends.first, ends.second, ends.axes];
    // What moves the loop as a whole does not change it.
    let changes = |motion: &&Motion| all.iter().any(|frame| !view.moves(motion.frame, *frame));
    let motions: Vec<&Motion> = motions.iter().filter(changes).collect();
    let [a, b, c] = all.map(|frame| *view.pose(frame));
    let [at_a, at_b, at_c] = all.map(|frame| view.twist(graph, motions.iter().copied(), frame));
    let difference = graph.sub_vectors(a.position, b.position);
    let velocity = graph.sub_vectors(at_a[0], at_b[0]);
    match closure {
        Closure::Coordinates(coordinates) => {
            let swing = graph.cross(at_c[1], difference);
            let velocity = graph.sub_vectors(velocity, swing);
            let mut rows = c.axes.map(|axis| graph.dot(axis, velocity)).to_vec();
            if coordinates.iter().any(|coordinate| *coordinate >= 3) {
                let columns = relative(graph, &a, &b);
                let turns = [at_a, at_b].map(|twist| graph.sub_vectors(twist[1], at_c[1]));
                let first = traced(graph, &columns, turns[0]);
                let second = traced(graph, &transposed(&columns), turns[1]);
                let (half, change) = (graph.constant(0.5), graph.sub_vectors(first, second));
                let change = graph.scale(half, change);
                rows.extend(c.axes.map(|axis| graph.dot(axis, change)));
            }
            coordinates.iter().map(|coordinate| rows[*coordinate]).collect()
        }
        Closure::Distance(_) => {
            let distance = graph.norm(difference);
            let along = graph.dot(difference, velocity);
            let change = graph.div(along, distance);
            vec![graph.sub(change, length)]
        }
    }
}

/// Forces and moments `(f, m)` on the frames a, b and c of a loop, at their origins; `None` is
/// `F_0`.
pub(crate) type Wrenches = [(Option<usize>, [Vector; 2]); 3];

/// Returns the wrenches whose power is that of forces λ of the equations, `λ · φ̇`:
///
/// ```text
/// f_a = −f_b = R_c λ       m_a = (tr W I − Wᵀ) R_c λ / 2       m_b = −(tr W I − W) R_c λ / 2
/// f_c = 0                  m_c = −m_a − m_b − d × f_a
/// ```
///
/// For a distance `f_a = λ d / |d|`, without moments.
pub(super) fn wrenches(
    graph: &mut Graph,
    ends: Ends,
    closure: &Closure,
    forces: &[Node],
    pose: impl Fn(Option<usize>) -> Frame,
) -> Wrenches {
    let [a, b, c] = [ends.first, ends.second, ends.axes].map(pose);
    let (difference, zero) = (graph.sub_vectors(a.position, b.position), [graph.zero(); 3]);
    let (force, moments) = match closure {
        Closure::Coordinates(coordinates) => {
            let mut all = [graph.zero(); 6];
            coordinates.iter().zip(forces).for_each(|(coordinate, force)| all[*coordinate] = *force);
            let half = graph.constant(0.5);
            let [force, moment] = [0, 3].map(|i| graph.turn(&c.axes, [all[i], all[i + 1], all[i + 2]]));
            let moment = graph.scale(half, moment);
            let columns = relative(graph, &a, &b);
            let [at_a, minus_b] =
                [transposed(&columns), columns].map(|matrix| traced(graph, &matrix, moment));
            let rest = graph.add_cross(at_a, difference, force);
            (force, [at_a, graph.neg_vector(minus_b), graph.sub_vectors(minus_b, rest)])
        }
        Closure::Distance(_) => {
            let distance = graph.norm(difference);
            let per_length = graph.div(forces[0], distance);
            (graph.scale(per_length, difference), [zero; 3])
        }
    };
    let back = graph.neg_vector(force);
    [(ends.first, [force, moments[0]]), (ends.second, [back, moments[1]]), (ends.axes, [zero, moments[2]])]
}

/// Returns the columns of `W = R_a R_bᵀ`.
fn relative(graph: &mut Graph, a: &Frame, b: &Frame) -> [Vector; 3] {
    std::array::from_fn(|column| {
        let row = b.axes.map(|axis| axis[column]);
        graph.turn(&a.axes, row)
    })
}

/// Returns `(tr W I − W) ω`.
fn traced(graph: &mut Graph, columns: &[Vector; 3], omega: Vector) -> Vector {
    let sum = graph.add(columns[0][0], columns[1][1]);
    let trace = graph.add(sum, columns[2][2]);
    let (whole, part) = (graph.scale(trace, omega), graph.turn(columns, omega));
    graph.sub_vectors(whole, part)
}

/// Adds the twists that are equivalent to the change of lengths per unit of a symbol. A leg from b
/// to a that is longer by `δl` has the effect of its end a, displaced against the direction `u =
/// (p_a − p_b) / |p_a − p_b|`, or of its end b, displaced along it:
///
/// ```text
/// δp_a = −u δl        δp_b = u δl
/// ```
pub(crate) fn add_lengths(graph: &mut Graph, spec: &Spec, symbol: Symbol, twists: &mut [FrameTwist]) {
    for (closed, slope) in spec.loops.iter().zip(length_slopes(graph, spec, symbol)) {
        let Some((end, sign)) = spec.own_end(closed).filter(|_| slope != graph.zero()) else { continue };
        let ends = Ends::new(spec, closed);
        let view = View::new(graph, spec, ends.root(spec));
        let [a, b] = closed.frames.map(|frame| *view.pose(frame));
        let difference = graph.sub_vectors(a.position, b.position);
        let distance = graph.norm(difference);
        let signed = graph.constant(sign);
        let change = graph.mul(signed, slope);
        let per_length = graph.div(change, distance);
        let shift = graph.scale(per_length, difference);
        let shift = view.pose(Some(end)).axes.map(|axis| graph.dot(axis, shift));
        twists[end].velocity = graph.add_vectors(twists[end].velocity, shift);
    }
}

/// Returns the change of the length of each loop per unit of a symbol; zero without a length.
pub(crate) fn length_slopes(graph: &mut Graph, spec: &Spec, symbol: Symbol) -> Vec<Node> {
    let slope = |closed: &Loop| match closed.closure.length() {
        Some(length) => {
            let length = graph.lower(length);
            graph.diff(length, in_programs(symbol))
        }
        None => graph.zero(),
    };
    spec.loops.iter().map(slope).collect()
}
