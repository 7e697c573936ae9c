//! From box to box: the one that may hold most is halved first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use super::cell::{Cell, Point, Workspace};
use super::corners::Corners;
use super::tape::Tape;
use super::{Bound, Effort, Progress};

/// How many boxes are halved in a round, whatever the number of threads.
const ROUND: usize = 64;
/// What is this much less than the first look allowed is nothing, and so is what is less than the second number.
const NOTHING: [f64; 2] = [1e-9, 1e-150];

/// What is sought, and where.
pub(super) struct Search {
    /// The value.
    pub(super) value: Tape,
    /// How it is convex in the names, if it is.
    pub(super) corners: Option<Corners>,
    /// The value, and its slope along each name.
    pub(super) all: Tape,
    /// Where each name can be.
    pub(super) domain: Vec<[f64; 2]>,
    /// Where it begins.
    pub(super) start: Vec<f64>,
    /// Whether the value is the square of what is asked for.
    pub(super) squared: bool,
    pub(super) effort: Effort,
}

/// A box that waits, with its number: of equals the first comes first.
struct Waiting {
    cell: Cell,
    number: usize,
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        self.cell.most.total_cmp(&other.cell.most).then(other.number.cmp(&self.number))
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
    pub(super) fn run<const N: usize>(&self, watch: &mut dyn FnMut(&Progress) -> bool) -> Bound {
        let mut best = self.first::<N>();
        let whole = Cell {
            low: self.domain.iter().map(|range| range[0]).collect(),
            high: self.domain.iter().map(|range| range[1]).collect(),
            most: f64::INFINITY,
            split: 0,
        };
        let first = self.value.evaluate(
            &mut Vec::<super::form::Form<N>>::new(),
            &whole.centres().0,
            &whole.centres().1,
        );
        let allowed = self.size(first.0[0].range()[1]);
        let nothing = if allowed.is_finite() { (NOTHING[0] * allowed).max(NOTHING[1]) } else { NOTHING[1] };
        let (mut waiting, mut boxes, mut left) = (BinaryHeap::new(), 0, f64::NEG_INFINITY);
        let mut open = vec![whole];
        let complete = loop {
            let looked: Vec<(Option<Cell>, Point)> = open
                .into_par_iter()
                .map_init(Workspace::<N>::default, |workspace, cell| self.look(cell, best.value, workspace))
                .collect();
            for (cell, point) in looked {
                boxes += 1;
                if point.value > best.value {
                    best = self.climb::<N>(point);
                }
                if let Some(cell) = cell {
                    waiting.push(Waiting { cell, number: boxes });
                }
            }
            let most = waiting.peek().map_or(f64::NEG_INFINITY, |waiting: &Waiting| waiting.cell.most);
            let (found, certified) = (self.size(best.value), self.certified(most.max(left).max(best.value)));
            if certified <= found + (self.effort.gap * found).max(nothing) {
                break true;
            }
            if boxes >= self.effort.boxes || !watch(&Progress { found, certified, boxes }) {
                break false;
            }
            open = Vec::with_capacity(2 * ROUND);
            while open.len() < 2 * ROUND
                && let Some(Waiting { cell, .. }) = waiting.pop()
            {
                let is_point = cell.low == cell.high;
                // What cannot be halved stays as it is; what holds no more than was found is done with.
                if is_point || self.domain.is_empty() {
                    left = left.max(cell.most);
                } else if cell.most > best.value {
                    open.extend(cell.halves());
                }
            }
            if open.is_empty() {
                let certified = self.certified(left.max(best.value));
                break certified <= found + (self.effort.gap * found).max(nothing);
            }
        };
        let most = waiting.peek().map_or(f64::NEG_INFINITY, |waiting| waiting.cell.most);
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
