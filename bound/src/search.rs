//! Branch and bound: bisects the box with the largest upper bound first.

use rayon::prelude::*;

use crate::corners::Corners;
use crate::effort::{Effort, Progress, Watch};
use crate::local_search::{ascend, highest};
use crate::problem::{Point, Problem};
use crate::queue::Queue;
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
