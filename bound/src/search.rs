//! Branch and bound: bisects the box with the largest upper bound first.
//!
//! Queue of the boxes of a search.
//!
//! Limits and progress of a search.
//!
//! Names that move within a range: joints, parameters and inputs.

use std::collections::BTreeMap;

use abbe_spec::expr::Symbol;
use rayon::prelude::*;

use crate::corners::Corners;
use crate::local_search::{ascend, highest};
use crate::problem::{Point, Problem};
use crate::search_box::{SearchBox, Workspace};
use crate::unknowns::Buffers;

/// Number of boxes bisected in a round, for any number of threads.
const ROUND: usize = 64;
/// Values are taken as 0 below this fraction of the bound of the first box, or below the second
/// number.
const NOTHING: [f64; 2] = [1e-9, 1e-150];

/// Certified enclosure of the largest value: between `found` and `certified`.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// Value at `at`, rounded down.
    pub found: f64,
    /// Upper bound of all values; infinite if none is known.
    pub certified: f64,
    /// Value of each name at the found maximum.
    pub at: Vec<f64>,
    /// Number of boxes examined.
    pub boxes: usize,
    /// `true` if the gap was reached.
    pub complete: bool,
    /// Centre of a box in which the value may be infinite, if there is one.
    pub unbounded: Option<Vec<f64>>,
}

/// A maximization problem and its termination criteria.
pub(crate) struct Search {
    pub(crate) problem: Problem,
    /// `true` if the value is the square of the quantity to be bounded.
    pub(crate) squared: bool,
    pub(crate) effort: Effort,
}

impl Search {
    pub(crate) fn run<const N: usize>(&self, watch: &mut Watch<'_>) -> Bound {
        let mut best = highest::<N>(&self.problem);
        let whole = SearchBox {
            low: self.problem.domain.iter().map(|range| range[0]).collect(),
            high: self.problem.domain.iter().map(|range| range[1]).collect(),
            most: f64::INFINITY,
            split: 0,
            known: None,
        };
        let (centres, halves) = whole.centres();
        let first = self.problem.value_within(&mut Buffers::<N>::default(), &centres, &halves, &mut None);
        let allowed = self.size(first.range()[1]);
        let nothing = if allowed.is_finite() { (NOTHING[0] * allowed).max(NOTHING[1]) } else { NOTHING[1] };
        let (mut waiting, mut boxes, mut left) = (Queue::default(), 0, f64::NEG_INFINITY);
        let mut open = vec![whole];
        let samples = self.problem.corners.as_ref().map_or(1, Corners::samples);
        let most_boxes = self.effort.boxes.min(self.effort.samples / samples);
        let complete = loop {
            let looked: Vec<(Option<SearchBox>, Point)> = open
                .into_par_iter()
                .map_init(
                    || Workspace::<N>::new(&self.problem),
                    |workspace, search_box| workspace.look(search_box, best.value),
                )
                .collect();
            for (search_box, point) in looked {
                boxes += 1;
                if point.value > best.value {
                    best = ascend::<N>(&self.problem, point);
                }
                if let Some(search_box) = search_box {
                    waiting.push(-search_box.most, search_box);
                }
            }
            let most = waiting.first().map_or(f64::NEG_INFINITY, |first: &SearchBox| first.most);
            let (found, certified) = (self.size(best.value), self.certified(most.max(left).max(best.value)));
            let enough = (found + (self.effort.gap * found).max(nothing)).max(self.effort.nothing);
            if certified <= enough {
                break true;
            }
            if boxes >= most_boxes || !watch(&Progress { found, certified, boxes }) {
                break false;
            }
            open = Vec::with_capacity(2 * ROUND);
            while open.len() < 2 * ROUND
                && let Some(search_box) = waiting.pop()
            {
                let is_point = search_box.low == search_box.high;
                // A point cannot be bisected; a box whose bound does not exceed the found value is
                // discarded.
                if is_point || self.problem.domain.is_empty() {
                    left = left.max(search_box.most);
                } else if search_box.most > best.value {
                    open.extend(search_box.halves());
                }
            }
            if open.is_empty() {
                let certified = self.certified(left.max(best.value));
                break certified <= enough;
            }
        };
        let top = waiting.first();
        let most = top.map_or(f64::NEG_INFINITY, |top| top.most);
        let unbounded = top.filter(|top| top.most.is_infinite()).map(|top| top.centres().0);
        Bound {
            found: self.rounded_down(best.value),
            certified: self.certified(most.max(left).max(best.value)),
            at: best.at,
            boxes,
            complete,
            unbounded,
        }
    }

    /// Returns an upper bound of the quantity from that of the value.
    fn size(&self, value: f64) -> f64 {
        match self.squared {
            _ if value.is_nan() => f64::INFINITY,
            true if value > 0.0 => value.sqrt().next_up(),
            _ => value.max(0.0),
        }
    }

    fn certified(&self, value: f64) -> f64 {
        self.size(value).min(self.effort.at_most)
    }

    fn rounded_down(&self, value: f64) -> f64 {
        match self.squared {
            true if value > 0.0 => value.sqrt().next_down(),
            _ => value.max(0.0),
        }
    }
}

/// Items by a bound: that with the least bound comes first, among equal bounds the oldest.
pub(crate) struct Queue<T> {
    items: BTreeMap<(i64, usize), T>,
    pushed: usize,
}

impl<T> Default for Queue<T> {
    fn default() -> Self {
        Self { items: BTreeMap::new(), pushed: 0 }
    }
}

impl<T> Queue<T> {
    pub(crate) fn push(&mut self, bound: f64, item: T) {
        self.pushed += 1;
        // Integers in the total order of the numbers, as `f64::total_cmp` compares them.
        let bits = bound.to_bits() as i64;
        self.items.insert((bits ^ (((bits >> 63) as u64) >> 1) as i64, self.pushed), item);
    }

    pub(crate) fn first(&self) -> Option<&T> {
        self.items.first_key_value().map(|(_, item)| item)
    }

    pub(crate) fn pop(&mut self) -> Option<T> {
        self.items.pop_first().map(|(_, item)| item)
    }
}

/// Termination criteria of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Relative gap between the certified and the found value at which the search ends.
    pub gap: f64,
    /// Number of boxes after which the search ends.
    pub boxes: usize,
    /// Number of evaluations of quadratic parts after which the search ends; a box takes up to six
    /// for each combination of its angles.
    pub samples: usize,
    /// Known upper bound of the largest value; infinite if there is none.
    pub at_most: f64,
    /// Value below which the search ends, because so little does not matter.
    pub nothing: f64,
}

impl Effort {
    /// A gap of 1 %, and 300,000 boxes.
    pub const DEFAULT: Self =
        Self { gap: 0.01, boxes: 300_000, samples: usize::MAX, at_most: f64::INFINITY, nothing: 0.0 };
}

impl Default for Effort {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Caller of a search, which ends where this returns `false`.
pub type Watch<'w> = dyn FnMut(&Progress) -> bool + 'w;

/// Progress of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Largest value found so far.
    pub found: f64,
    /// Certified upper bound so far.
    pub certified: f64,
    /// Number of boxes examined.
    pub boxes: usize,
}

/// Maximum number of moving names that a node may depend on; no bound is proved for more.
pub const MOST_MOVING: usize = 32;

/// A name that moves within a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving {
    /// The symbol.
    pub symbol: Symbol,
    /// Range of the name: finite, lower end first.
    pub range: [f64; 2],
    /// Value of the name if the node does not depend on it.
    pub home: f64,
    /// Value at which the search starts.
    pub start: f64,
}

impl Moving {
    /// Returns the value of the name if the node does not depend on it, within its range.
    pub(crate) fn still(&self) -> f64 {
        self.home.clamp(self.range[0], self.range[1])
    }
}

/// Returns the value of a symbol that does not move; others than names are `fixed`.
pub(crate) fn still(moving: &[Moving], fixed: &dyn Fn(Symbol) -> f64, symbol: Symbol) -> f64 {
    moving.iter().find(|name| name.symbol == symbol).map_or_else(|| fixed(symbol), Moving::still)
}

/// Returns the value of each name; `at` has those of the active ones.
pub(crate) fn of_all(moving: &[Moving], is_active: impl Fn(&Moving) -> bool, at: &[f64]) -> Vec<f64> {
    let mut found = at.iter().copied();
    let value = |name: &Moving| is_active(name).then(|| found.next()).flatten().unwrap_or(name.still());
    moving.iter().map(value).collect()
}
