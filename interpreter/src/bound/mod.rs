//! The largest value of a node that is never negative, over a box of joints and inputs, with a proof: branch and bound.
//!
//! `tape` are the operations of a graph, one after the other. Two ways lead from them to what is known within one box (`cell`):
//!
//! - a norm that is `convex` in the sine and cosine of each angle is largest at `corners`, where `vertex` has its numbers;
//! - of anything else, and close to a maximum, there are affine forms: `form` is a number while names move within their ranges, all
//!   roundings covered, `functions` and `tables` what is done to it, and `growth` how much slopes let a value grow.
//!
//! `search` goes from box to box, the one that may hold most first, from where a `climb` led; `period` says whether a joint comes round. `apart`
//! is what sums cannot exceed because of their parts, and `singular` the least or the largest singular value of a matrix.
//!
//! ```
//! use abbe_codegen::chain::Magnitude;
//! use abbe_spec::expr::Symbol;
//! use abbe_codegen::graph::Graph;
//! use abbe_interpreter::bound::{Effort, Moving, largest};
//!
//! // x (1 − x) is at most 1/4.
//! let mut graph = Graph::new();
//! let x = graph.symbol(Symbol::Variable(0));
//! let one = graph.constant(1.0);
//! let rest = graph.sub(one, x);
//! let node = graph.mul(x, rest);
//! let size = Magnitude { node, squared: false, parts: Vec::new() };
//! let x = Moving { symbol: Symbol::Variable(0), range: [0.0, 1.0], home: 0.0, start: 0.0 };
//! let bound = largest(&mut graph, &size, &[x], |_| 0.0, &Effort::default(), &mut |_| true);
//! assert!(bound.complete && bound.found <= 0.25 && bound.certified >= 0.25);
//! assert!(bound.certified <= 1.01 * bound.found);
//! ```

mod apart;
mod cell;
mod climb;
mod convex;
mod corners;
mod form;
mod functions;
mod growth;
mod period;
mod search;
mod singular;
mod tables;
mod tape;
mod vertex;

use abbe_codegen::chain::Magnitude;
use abbe_codegen::graph::{Graph, Node};
use abbe_spec::expr::Symbol;

pub use apart::{Limits, limits};
use convex::Convex;
use corners::Corners;
use search::Search;
pub use singular::{Extreme, Singular, singular_value};
use tape::Tape;

/// How many names may move: of a node that more of them move nothing is proved.
pub const MOST_MOVING: usize = 32;

/// A name that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving {
    /// Which.
    pub symbol: Symbol,
    /// From where to where; both finite, in this order.
    pub range: [f64; 2],
    /// Where it is if it does not matter.
    pub home: f64,
    /// Where the search begins, before it looks elsewhere.
    pub start: f64,
}

/// How much is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Ends when the certified value exceeds the found one by no more than this share of it.
    pub gap: f64,
    /// Ends after so many boxes.
    pub boxes: usize,
    /// What is known to be no less than the largest value; infinite if nothing is.
    pub at_most: f64,
}

impl Default for Effort {
    /// 1 %, and 300,000 boxes.
    fn default() -> Self {
        Self { gap: 0.01, boxes: 300_000, at_most: f64::INFINITY }
    }
}

/// What is proved of the largest value: it is no less than `found`, and no more than `certified`.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// The value at `at`, rounded down.
    pub found: f64,
    /// What no value exceeds; infinite if nothing is known.
    pub certified: f64,
    /// The value of each name where `found` is.
    pub at: Vec<f64>,
    /// How many boxes were looked at.
    pub boxes: usize,
    /// Whether the gap was reached.
    pub complete: bool,
}

/// What is proved so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Found.
    pub found: f64,
    /// Certified.
    pub certified: f64,
    /// How many boxes were looked at.
    pub boxes: usize,
}

/// The largest value of a node that is never negative over the box in which some names move, all others being as `fixed` says.
///
/// The value is that in real numbers of the node with the numbers of the graph, which are taken for exact. `watch` is told
/// after every round how far it is, and ends the search by `false`. Which boxes are looked at depends on nothing else than
/// what is asked: neither on threads nor on time.
pub fn largest(
    graph: &mut Graph,
    magnitude: &Magnitude,
    moving: &[Moving],
    fixed: impl Fn(Symbol) -> f64,
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
    let active: Vec<Moving> = moving.iter().copied().filter(is_active).collect();
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
    let search =
        Search { value, corners, all: slopes, domain, start, squared: magnitude.squared, effort: *effort };
    // As many slopes as there are names, or a few more: each number is compiled by itself.
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
