//! What is known of the node within one box.

use std::cmp::Ordering;

use crate::affine::{Affine, UNIT, above};
use crate::corners::{Corners, Numbers};
use crate::problem::{Point, Problem};
use crate::slopes::SlopeBound;

/// A box that may hold the largest value.
#[derive(Clone, Debug)]
pub(crate) struct SearchBox {
    pub(crate) low: Vec<f64>,
    pub(crate) high: Vec<f64>,
    /// What no value within exceeds.
    pub(crate) most: f64,
    /// The name that is to be halved.
    pub(crate) split: usize,
}

/// Boxes that are no wider are looked at by their slopes, too, rad: close to a maximum these confine it.
const NARROW: f64 = 0.1;

/// How often a box that became smaller is looked at again at once.
const PASSES: usize = 4;

/// A name whose quarter moves the value by this share of what its whole range does says nothing by its slope.
const SATURATED: f64 = 0.95;

/// Looks at boxes, and keeps its numbers from one to the next.
pub(crate) struct Workspace<'a, const N: usize> {
    problem: &'a Problem,
    registers: Vec<Affine<N>>,
    points: Vec<Affine<0>>,
    corners: Numbers,
}

impl<'a, const N: usize> Workspace<'a, N> {
    pub(crate) fn new(problem: &'a Problem) -> Self {
        Self { problem, registers: Vec::new(), points: Vec::new(), corners: Numbers::default() }
    }

    /// Looks at a box: nothing of it is left if it holds no more than was found.
    pub(crate) fn look(&mut self, search_box: SearchBox, found: f64) -> (Option<SearchBox>, Point) {
        match &self.problem.corners {
            Some(corners) => self.look_at_corners(corners, search_box, found),
            None => self.look_at_slopes(search_box),
        }
    }

    /// The corner with the largest value bounds the box. Where it is outside, a name is halved that takes it there.
    fn look_at_corners(
        &mut self,
        corners: &Corners,
        mut search_box: SearchBox,
        found: f64,
    ) -> (Option<SearchBox>, Point) {
        let is_too_long =
            |name: usize| corners.is_too_long(name, [search_box.low[name], search_box.high[name]]);
        if let Some(name) = search_box.widest(is_too_long) {
            search_box.split = name;
            return (Some(search_box), Point::NONE);
        }
        let Some(corner) = corners.largest(&mut self.corners, &search_box.low, &search_box.high) else {
            return self.look_at_slopes(search_box);
        };
        search_box.most = search_box.most.min(corner.most);
        if search_box.most <= found {
            return (None, Point::NONE);
        }
        let split = search_box.widest(|name| corner.is_outside(name)).or_else(|| search_box.widest(|_| true));
        search_box.split = split.unwrap_or(0);
        let at = corner.nearest(&search_box.low, &search_box.high);
        let value = self.problem.value_at(&mut self.points, &at)[0];
        let point = if value.is_finite() { Point { value, at } } else { Point::NONE };
        if search_box.high[search_box.split] - search_box.low[search_box.split] > NARROW {
            return (Some(search_box), point);
        }
        let (search_box, centre) = self.look_at_slopes(search_box);
        (search_box, if centre.value > point.value { centre } else { point })
    }

    /// What of a box cannot hold the largest value is taken away:
    ///
    /// - Where the value grows with a name everywhere, it is largest at the upper end of that name: of a box that is not at the
    ///   end of the domain, nothing is left.
    /// - Where a name is not at an end of the domain, its slope must be 0: names are confined to where it can be.
    fn look_at_slopes(&mut self, mut search_box: SearchBox) -> (Option<SearchBox>, Point) {
        let mut point = Point::NONE;
        for pass in 1.. {
            let (centres, halves) = search_box.centres();
            let (forms, jumps) = self.problem.all.evaluate(&mut self.registers, &centres, &halves);
            let [value, slopes @ ..] = &forms[..] else { return (Some(search_box), point) };
            if !jumps {
                match self.confine(&mut search_box, slopes, &centres, &halves) {
                    Confined::Nothing => return (None, point),
                    Confined::Less if pass < PASSES => continue,
                    _ => {}
                }
            }
            let (centres, halves) = search_box.centres();
            let [low, high] = self.problem.value_at(&mut self.points, &centres);
            if low.is_finite() {
                point = Point { value: low, at: centres.clone() };
            }
            let mut most = value.range()[1];
            let bound = SlopeBound::new(slopes, &halves);
            if !jumps {
                let from_centre = high + above(bound.most() + UNIT * high.abs());
                // A comparison with what is not a number is false.
                if from_centre < most {
                    most = from_centre;
                }
            }
            search_box.split = self.most_promising(&centres, &halves, &bound);
            search_box.most = if most.is_nan() { f64::INFINITY } else { search_box.most.min(most) };
            return (Some(search_box), point);
        }
        (Some(search_box), point)
    }

    /// The name that moves the value most by its slope: its halving promises most. But a slope says little of a fast sine: a
    /// name that alone moves the value as much on a quarter of its range comes last. Where slopes have no end, a name comes first
    /// that alone makes the value endless, and then the longest.
    fn most_promising(&mut self, centres: &[f64], halves: &[f64], bound: &SlopeBound<N>) -> usize {
        let mut alone = vec![0.0; halves.len()];
        let mut moved = |i: usize, part: f64| {
            alone[i] = part * halves[i];
            let radius = self.problem.value.evaluate(&mut self.registers, centres, &alone).0[0].radius();
            alone[i] = 0.0;
            if radius.is_nan() { f64::INFINITY } else { radius }
        };
        let mut order: Vec<(usize, [f64; 3])> = (0..halves.len())
            .filter(|i| halves[*i] > 0.0)
            .map(|i| {
                let ([low, high], share) = (self.problem.domain[i], bound.share(i));
                let key = match share.is_finite() {
                    true => [share, 0.0, 0.0],
                    false => [f64::INFINITY, moved(i, 1.0), halves[i] / (high - low)],
                };
                (i, key)
            })
            .collect();
        order.sort_by(|(_, a), (_, b)| b.partial_cmp(a).unwrap_or(Ordering::Equal));
        let mut is_promising = |i: usize| {
            let whole = moved(i, 1.0);
            !(whole.is_finite() && moved(i, 0.25) >= SATURATED * whole)
        };
        let names: Vec<usize> = order.into_iter().map(|(i, _)| i).collect();
        names.iter().copied().find(|i| is_promising(*i)).or(names.first().copied()).unwrap_or(0)
    }

    fn confine(
        &self,
        search_box: &mut SearchBox,
        slopes: &[Affine<N>],
        centres: &[f64],
        halves: &[f64],
    ) -> Confined {
        let mut confined = Confined::Same;
        for (i, slope) in slopes.iter().enumerate() {
            if halves[i] == 0.0 {
                continue;
            }
            let ([low, high], [first, last]) = (slope.range(), self.problem.domain[i]);
            let (at_first, at_last) = (search_box.low[i] <= first, search_box.high[i] >= last);
            if low > 0.0 {
                if !at_last {
                    return Confined::Nothing;
                }
                search_box.low[i] = search_box.high[i];
                confined = Confined::Less;
            } else if high < 0.0 {
                if !at_first {
                    return Confined::Nothing;
                }
                search_box.high[i] = search_box.low[i];
                confined = Confined::Less;
            } else if !at_first && !at_last {
                let Some([from, to]) = zero_of(slope, i) else { continue };
                if from > to {
                    return Confined::Nothing;
                }
                let margin = 4.0 * UNIT * (centres[i].abs() + halves[i]);
                let low = (centres[i] + halves[i] * from - margin).max(search_box.low[i]);
                let high = (centres[i] + halves[i] * to + margin).min(search_box.high[i]);
                if high - low < 0.7 * (search_box.high[i] - search_box.low[i]) {
                    (search_box.low[i], search_box.high[i]) = (low, high);
                    confined = Confined::Less;
                }
            }
        }
        confined
    }
}

/// What is left of a box.
enum Confined {
    Nothing,
    Less,
    Same,
}

/// Where on −1 … 1 a form can be 0 along a name, whatever the others are; nothing if everywhere.
fn zero_of<const N: usize>(slope: &Affine<N>, name: usize) -> Option<[f64; 2]> {
    let own = slope.slopes[name];
    let others =
        above(slope.slopes.iter().enumerate().map(|(j, a)| if j == name { 0.0 } else { a.abs() }).sum());
    let (middle, half) = (-slope.centre / own, above((others + slope.rest) / own.abs()));
    let margin = above(4.0 * UNIT * (middle.abs() + half));
    let (from, to) = ((middle - half - margin).max(-1.0), (middle + half + margin).min(1.0));
    (middle.is_finite() && half.is_finite() && (from > -1.0 || to < 1.0)).then_some([from, to])
}

impl SearchBox {
    /// Its middle, and how far it goes from there on both sides at least.
    pub(crate) fn centres(&self) -> (Vec<f64>, Vec<f64>) {
        let centres: Vec<f64> = self.low.iter().zip(&self.high).map(|(a, b)| 0.5 * a + 0.5 * b).collect();
        let ends = self.low.iter().zip(&self.high).zip(&centres);
        let halves = ends.map(|((low, high), centre)| match low == high {
            true => 0.0,
            false => (high - centre).max(centre - low).next_up(),
        });
        let halves = halves.collect();
        (centres, halves)
    }

    /// The widest of some names that have any width.
    fn widest(&self, is_one: impl Fn(usize) -> bool) -> Option<usize> {
        let width = |name: &usize| self.high[*name] - self.low[*name];
        let names = (0..self.low.len()).filter(|name| width(name) > 0.0 && is_one(*name));
        names.max_by(|a, b| width(a).total_cmp(&width(b)))
    }

    /// Both halves along the name that is to be halved.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let (mut lower, mut upper) = (self.clone(), self.clone());
        let middle = 0.5 * self.low[self.split] + 0.5 * self.high[self.split];
        lower.high[self.split] = middle;
        upper.low[self.split] = middle;
        [lower, upper]
    }
}
