//! The largest value of a node over a box.
//!
//! Bounds of sums of errors from the maximum of each part: not tight, but fast for any number of
//! joints.

use abbe_codegen::chain::{DIRECTION, Implicit, Magnitude, PerFrameMagnitudes};
use abbe_codegen::graph::{Graph, Node};
use abbe_spec::expr::Symbol;

use crate::convex::Convex;
use crate::corners::Corners;
use crate::search::{Bound, Effort, MOST_MOVING, Moving, Search, Watch, of_all, still};
use crate::{Problem, Tape, Unknowns, period};

/// Bounds the largest value of a nonnegative node over the box of the moving names, with all other
/// symbols `fixed`, and over all directions of a sum of errors.
///
/// The bound holds for the node in real arithmetic, with the constants of the graph taken as exact.
/// `watch` receives the progress after every round and ends the search by returning `false`. The
/// order of boxes is deterministic: it depends neither on threads nor on time.
pub fn largest(
    graph: &mut Graph,
    magnitude: &Magnitude,
    implicit: &[Implicit],
    moving: &[Moving],
    fixed: &dyn Fn(Symbol) -> f64,
    effort: &Effort,
    watch: &mut Watch<'_>,
) -> Bound {
    let node = magnitude.node;
    if graph.value(node) == Some(0.0) {
        let at = moving.iter().map(Moving::still).collect();
        return Bound { found: 0.0, certified: 0.0, at, boxes: 0, complete: true, unbounded: None };
    }
    let depends = Implicit::symbols(graph, &[node], implicit);
    let has_unknowns = implicit
        .iter()
        .flat_map(|implicit| &implicit.sets)
        .any(|(unknowns, _)| unknowns.iter().any(|unknown| depends.contains(unknown)));
    // The way from home to a box moves a name that stands still elsewhere, too.
    let moves = |name: &Moving| name.range[0] < name.range[1] || has_unknowns && name.range[0] != name.home;
    let is_active = |name: &Moving| depends.contains(&name.symbol) && moves(name);
    let direction = DIRECTION.map(|(symbol, range)| Moving { symbol, range, home: 0.0, start: 0.0 });
    let active: Vec<Moving> = moving.iter().copied().chain(direction).filter(is_active).collect();
    let mut symbols: Vec<Symbol> = active.iter().map(|name| name.symbol).collect();
    let still = |symbol: Symbol| still(moving, fixed, symbol);
    let mut unknowns = None;
    let mut all = vec![node];
    if has_unknowns {
        let names: Vec<(Symbol, f64)> = active.iter().map(|name| (name.symbol, name.home)).collect();
        let (found, inputs) = Unknowns::new(graph, implicit, &names, &depends, still);
        (unknowns, symbols) = (Some(found), inputs);
    } else {
        all.extend(symbols.iter().map(|symbol| graph.diff(node, *symbol)));
    }
    let domain =
        active.iter().map(|name| match !has_unknowns && period::is_angle(graph, node, name.symbol) {
            true => period::once_around(name.range),
            false => name.range,
        });
    let domain: Vec<[f64; 2]> = domain.collect();
    // Each of several nodes has a bound of its own.
    let values = match has_unknowns && !magnitude.largest_of.is_empty() {
        true => &magnitude.largest_of[..],
        false => &[node],
    };
    let value = Tape::new(graph, values, &symbols, still);
    let mut slopes = Tape::new(graph, &all, &symbols, still);
    slopes.slopes_jump = value.steps.iter().any(|step| value.is_jumping_slope(step));
    let start = active.iter().zip(&domain).map(|(name, [low, high])| name.start.clamp(*low, *high)).collect();
    let parts: Vec<Node> = std::iter::once(node).chain(magnitude.parts.iter().copied()).collect();
    let parts = Tape::new(graph, &parts, &symbols, still);
    let corners = match &unknowns {
        None => Convex::new(&parts, active.len()).and_then(Corners::new),
        Some(_) => None,
    };
    let search = Search {
        problem: Problem { value, corners, all: slopes, domain, start, unknowns },
        squared: magnitude.squared,
        effort: *effort,
    };
    // At least as many slopes as names; each size is compiled separately.
    let bound = match active.len() {
        0..=2 => search.run::<2>(watch),
        3..=4 => search.run::<4>(watch),
        5..=6 => search.run::<6>(watch),
        7..=8 => search.run::<8>(watch),
        9..=16 => search.run::<16>(watch),
        _ => search.run::<MOST_MOVING>(watch),
    };
    let whole = |at: &[f64]| of_all(moving, is_active, at);
    Bound { at: whole(&bound.at), unbounded: bound.unbounded.as_deref().map(whole), ..bound }
}

/// Effort for one part. Parts depend on few names and converge fast.
const EFFORT: Effort = Effort { gap: 1e-3, boxes: 2000, ..Effort::DEFAULT };

/// Upper bounds of the norm of the position error and of the rotation error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Position: repeatable sources, random sources, and their sum.
    pub position: [f64; 3],
    /// Rotation in rad: repeatable sources, random sources, and their sum.
    pub rotation: [f64; 3],
}

/// Bounds the sums of errors from the maximum of each part, over the box of the moving names with
/// all others `fixed`. A bound is infinite if one of its parts is.
///
/// ```text
/// ‖δ‖ ≤ Σ_i ‖d_i‖ + ‖θ_i‖ Σ_{k > i} ‖t_k‖        ‖θ‖ ≤ Σ_i ‖θ_i‖
/// ```
pub fn limits(
    graph: &mut Graph,
    apart: &PerFrameMagnitudes,
    moving: &[Moving],
    fixed: &dyn Fn(Symbol) -> f64,
) -> Limits {
    let mut size = |magnitude: &Magnitude| {
        largest(graph, magnitude, &[], moving, fixed, &EFFORT, &mut |_| true).certified
    };
    // Maximum distance of the tool point from each frame, last frame first.
    let mut reach = 0.0;
    let mut levers: Vec<f64> = Vec::with_capacity(apart.links.len());
    for link in apart.links.iter().rev() {
        reach = (reach + size(link)).next_up();
        levers.push(reach);
    }
    levers.reverse();
    let mut sums = |errors: &[[Magnitude; 2]]| {
        let mut sums = [0.0_f64; 2];
        for ([shift, turn], lever) in errors.iter().zip(&levers) {
            let [shift, turn] = [shift, turn].map(&mut size);
            // Without rotation the lever does not matter, even an infinite one.
            let swing = if turn == 0.0 { 0.0 } else { (turn * lever).next_up() };
            sums = [(sums[0] + (shift + swing).next_up()).next_up(), (sums[1] + turn).next_up()];
        }
        sums
    };
    let repeatable = sums(&apart.repeatable);
    let mut random = [0.0_f64; 2];
    for source in &apart.random {
        let own = sums(source);
        random = std::array::from_fn(|i| (random[i] + own[i]).next_up());
    }
    let of = |i: usize| [repeatable[i], random[i], (repeatable[i] + random[i]).next_up()];
    Limits { position: of(0), rotation: of(1) }
}
