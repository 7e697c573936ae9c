//! The largest value of a node over a box.

use abbe_codegen::chain::{DIRECTION, Magnitude};
use abbe_codegen::graph::{Graph, Node};
use abbe_spec::expr::Symbol;

use crate::convex::Convex;
use crate::corners::Corners;
use crate::effort::{Effort, Progress};
use crate::moving::{MOST_MOVING, Moving};
use crate::period;
use crate::problem::Problem;
use crate::search::{Bound, Search};
use crate::tape::Tape;

/// Bounds the largest value of a nonnegative node over the box of the moving names, with all other
/// symbols `fixed`, and over all directions of a sum of errors.
///
/// The bound holds for the node in real arithmetic, with the constants of the graph taken as exact.
/// `watch` receives the progress after every round and ends the search by returning `false`. The
/// order of boxes is deterministic: it depends neither on threads nor on time.
pub fn largest(
    graph: &mut Graph,
    magnitude: &Magnitude,
    moving: &[Moving],
    fixed: &dyn Fn(Symbol) -> f64,
    effort: &Effort,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Bound {
    let node = magnitude.node;
    if graph.value(node) == Some(0.0) {
        let at = moving.iter().map(|name| name.home.clamp(name.range[0], name.range[1])).collect();
        return Bound { found: 0.0, certified: 0.0, at, boxes: 0, complete: true };
    }
    let depends = graph.symbols(&[node]);
    let is_active = |name: &Moving| depends.contains(&name.symbol) && name.range[0] < name.range[1];
    let direction = DIRECTION.map(|(symbol, range)| Moving { symbol, range, home: 0.0, start: 0.0 });
    let active: Vec<Moving> = moving.iter().copied().chain(direction).filter(is_active).collect();
    let symbols: Vec<Symbol> = active.iter().map(|name| name.symbol).collect();
    let slopes: Vec<Node> = symbols.iter().map(|symbol| graph.diff(node, *symbol)).collect();
    let still = |symbol: Symbol| {
        let name = moving.iter().find(|name| name.symbol == symbol);
        name.map_or_else(|| fixed(symbol), |name| name.home.clamp(name.range[0], name.range[1]))
    };
    let all: Vec<Node> = std::iter::once(node).chain(slopes).collect();
    let domain = active.iter().map(|name| match period::is_angle(graph, node, name.symbol) {
        true => period::once_around(name.range),
        false => name.range,
    });
    let domain: Vec<[f64; 2]> = domain.collect();
    let value = Tape::new(graph, &[node], &symbols, still);
    let mut slopes = Tape::new(graph, &all, &symbols, still);
    slopes.sides_jump = value.has_sides();
    let start = active.iter().zip(&domain).map(|(name, [low, high])| name.start.clamp(*low, *high)).collect();
    let parts: Vec<Node> = std::iter::once(node).chain(magnitude.parts.iter().copied()).collect();
    let parts = Tape::new(graph, &parts, &symbols, still);
    let corners = Convex::new(&parts, active.len()).and_then(Corners::new);
    let search = Search {
        problem: Problem { value, corners, all: slopes, domain, start },
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
    let mut found = bound.at.iter();
    let at = moving.iter().map(|name| {
        let own = if is_active(name) { found.next().copied() } else { None };
        own.unwrap_or_else(|| still(name.symbol))
    });
    Bound { at: at.collect(), ..bound }
}
