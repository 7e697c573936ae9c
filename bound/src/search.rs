//! From box to box: the one that may hold most is halved first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use crate::affine::Affine;
use crate::effort::{Effort, Progress};
use crate::local_search::{ascend, highest};
use crate::problem::{Point, Problem};
use crate::search_box::{SearchBox, Workspace};

/// How many boxes are halved in a round, whatever the number of threads.
const ROUND: usize = 64;
/// What is this much less than the first look allowed is nothing, and so is what is less than the second number.
const NOTHING: [f64; 2] = [1e-9, 1e-150];

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

/// What is sought, and for how long.
pub(crate) struct Search {
    pub(crate) problem: Problem,
    /// Whether the value is the square of what is asked for.
    pub(crate) squared: bool,
    pub(crate) effort: Effort,
}

/// A box that waits, with its number: of equals the first comes first.
struct Waiting {
    search_box: SearchBox,
    number: usize,
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        self.search_box.most.total_cmp(&other.search_box.most).then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

impl Search {
    pub(crate) fn run<const N: usize>(&self, watch: &mut dyn FnMut(&Progress) -> bool) -> Bound {
        let mut best = highest::<N>(&self.problem);
        let whole = SearchBox {
            low: self.problem.domain.iter().map(|range| range[0]).collect(),
            high: self.problem.domain.iter().map(|range| range[1]).collect(),
            most: f64::INFINITY,
            split: 0,
        };
        let first =
            self.problem.value.evaluate(&mut Vec::<Affine<N>>::new(), &whole.centres().0, &whole.centres().1);
        let allowed = self.size(first.0[0].range()[1]);
        let nothing = if allowed.is_finite() { (NOTHING[0] * allowed).max(NOTHING[1]) } else { NOTHING[1] };
        let (mut waiting, mut boxes, mut left) = (BinaryHeap::new(), 0, f64::NEG_INFINITY);
        let mut open = vec![whole];
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
                    waiting.push(Waiting { search_box, number: boxes });
                }
            }
            let most = waiting.peek().map_or(f64::NEG_INFINITY, |waiting: &Waiting| waiting.search_box.most);
            let (found, certified) = (self.size(best.value), self.certified(most.max(left).max(best.value)));
            if certified <= found + (self.effort.gap * found).max(nothing) {
                break true;
            }
            if boxes >= self.effort.boxes || !watch(&Progress { found, certified, boxes }) {
                break false;
            }
            open = Vec::with_capacity(2 * ROUND);
            while open.len() < 2 * ROUND
                && let Some(Waiting { search_box, .. }) = waiting.pop()
            {
                let is_point = search_box.low == search_box.high;
                // What cannot be halved stays as it is; what holds no more than was found is done with.
                if is_point || self.problem.domain.is_empty() {
                    left = left.max(search_box.most);
                } else if search_box.most > best.value {
                    open.extend(search_box.halves());
                }
            }
            if open.is_empty() {
                let certified = self.certified(left.max(best.value));
                break certified <= found + (self.effort.gap * found).max(nothing);
            }
        };
        let most = waiting.peek().map_or(f64::NEG_INFINITY, |waiting| waiting.search_box.most);
        Bound {
            found: self.rounded_down(best.value),
            certified: self.certified(most.max(left).max(best.value)),
            at: best.at,
            boxes,
            complete,
        }
    }

    /// What is asked for, of a value: no less than it is.
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
