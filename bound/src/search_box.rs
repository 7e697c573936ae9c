//! Bounds of the node within one box.

use std::cmp::Ordering;

use crate::affine::{Affine, UNIT, above};
use crate::corners::{self, Corners};
use crate::problem::{Point, Problem};
use crate::slopes::SlopeBound;
use crate::unknowns::{Buffers, Known};

/// A box that may contain the largest value.
#[derive(Clone, Debug)]
pub(crate) struct SearchBox {
    pub(crate) low: Vec<f64>,
    pub(crate) high: Vec<f64>,
    /// Upper bound of the value within the box.
    pub(crate) most: f64,
    /// Name to bisect.
    pub(crate) split: usize,
    /// Unknowns at the centre of the box from which this one was cut, if they exist throughout it;
    /// otherwise they are followed from home.
    pub(crate) known: Option<Known>,
}

/// Maximum width of boxes, rad, to which slopes are applied as well. Close to a maximum they shrink
/// the box.
const NARROW: f64 = 0.1;

/// Maximum number of times that a box is shrunk and examined again.
const PASSES: usize = 4;

/// A name whose quarter range changes the value by this fraction of the change over the whole range
/// is saturated, and its slope is not informative.
const SATURATED: f64 = 0.95;

/// Examines boxes, with buffers that are reused from one to the next.
pub(crate) struct Workspace<'a, const N: usize> {
    problem: &'a Problem,
    buffers: Buffers<N>,
    points: Buffers<0>,
    corners: corners::Buffers,
}

impl<'a, const N: usize> Workspace<'a, N> {
    pub(crate) fn new(problem: &'a Problem) -> Self {
        Self {
            problem,
            buffers: Buffers::default(),
            points: Buffers::default(),
            corners: corners::Buffers::default(),
        }
    }

    /// Examines a box. Returns `None` for the box if it contains no value larger than the found
    /// one.
    pub(crate) fn look(&mut self, search_box: SearchBox, found: f64) -> (Option<SearchBox>, Point) {
        match &self.problem.corners {
            Some(corners) => self.look_at_corners(corners, search_box, found),
            None if self.problem.unknowns.is_some() => self.look_at_forms(search_box, found),
            None => self.look_at_slopes(search_box),
        }
    }

    /// Bounds the box by the form of the value, and bisects the name with the largest influence on
    /// it: its slope, and its part of the rest, which grows with the square of the width.
    fn look_at_forms(&mut self, mut search_box: SearchBox, found: f64) -> (Option<SearchBox>, Point) {
        let (centres, halves) = search_box.centres();
        let form = self.problem.value_within(&mut self.buffers, &centres, &halves, &mut search_box.known);
        if !form.rest.is_finite() {
            // Only a box in which the unknowns exist leads to those of its parts.
            search_box.known = None;
        }
        search_box.most = search_box.most.min(form.range()[1]);
        if search_box.most <= found {
            return (None, Point::NONE);
        }
        let widths = halves.iter().zip(&self.problem.domain).map(|(half, [low, high])| match half {
            0.0 => 0.0,
            _ => half / (high - low),
        });
        let widths: Vec<f64> = widths.collect();
        let squares: f64 = widths.iter().map(|width| width * width).sum();
        let influence = |i: usize| match form.rest.is_finite() {
            true => {
                let slope = form.slopes.get(i).map_or(0.0, |slope| slope.abs());
                slope + form.rest * widths[i] * widths[i] / squares
            }
            false => widths[i],
        };
        let names = (0..halves.len()).filter(|i| halves[*i] > 0.0);
        search_box.split = names.max_by(|a, b| influence(*a).total_cmp(&influence(*b))).unwrap_or(0);
        let value = match form.centre > found {
            true => self.problem.value_at(&mut self.points, &centres)[0],
            false => f64::NEG_INFINITY,
        };
        let point = if value.is_finite() { Point { value, at: centres } } else { Point::NONE };
        (Some(search_box), point)
    }

    /// Bounds the box by the corner with the largest value. If that lies outside of the arcs, a
    /// name with a vertex outside is bisected.
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

    /// Removes parts of a box that cannot contain the largest value.
    ///
    /// - Where the value increases with a name everywhere, its maximum is at the upper end of that
    ///   name. A box that does not reach the end of the domain is discarded.
    /// - Where a name is not at an end of the domain, its slope must be 0. The range of names
    ///   shrinks to the values at which that is possible.
    fn look_at_slopes(&mut self, mut search_box: SearchBox) -> (Option<SearchBox>, Point) {
        let mut point = Point::NONE;
        for pass in 1.. {
            let (centres, halves) = search_box.centres();
            let (forms, jumps) = self.problem.all.evaluate(&mut self.buffers.registers, &centres, &halves);
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
                // A comparison with NaN is false.
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

    /// Returns the name to bisect: the one whose slope changes the value most. The slope is not
    /// informative for a fast sine, so saturated names come last. If slopes are unbounded, a name
    /// that alone makes the value unbounded comes first, and then the longest one.
    fn most_promising(&mut self, centres: &[f64], halves: &[f64], bound: &SlopeBound<N>) -> usize {
        let mut alone = vec![0.0; halves.len()];
        let mut moved = |i: usize, part: f64| {
            alone[i] = part * halves[i];
            let radius =
                self.problem.value.evaluate(&mut self.buffers.registers, centres, &alone).0[0].radius();
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

/// Rest of a box after shrinking.
enum Confined {
    Nothing,
    Less,
    Same,
}

/// Returns the part of [−1, 1] in which a form can be 0 along a name, for any values of the others.
/// Returns `None` if that is everywhere.
fn zero_of<const N: usize>(slope: &Affine<N>, name: usize) -> Option<[f64; 2]> {
    let own = slope.slopes[name];
    let others =
        above(slope.slopes.iter().enumerate().map(|(j, a)| if j == name { 0.0 } else { a.abs() }).sum());
    let (middle, half) = (-slope.centre / own, above((others + slope.rest) / own.abs()));
    let margin = above(4.0 * UNIT * (middle.abs() + half));
    let (from, to) = ((middle - half - margin).max(-1.0), (middle + half + margin).min(1.0));
    (middle.is_finite() && half.is_finite() && (from > -1.0 || to < 1.0)).then_some([from, to])
}

/// Returns the centre of a box, and upper bounds of the half widths.
pub(crate) fn centres(low: &[f64], high: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let centres: Vec<f64> = low.iter().zip(high).map(|(a, b)| 0.5 * a + 0.5 * b).collect();
    let ends = low.iter().zip(high).zip(&centres);
    let halves = ends.map(|((low, high), centre)| match low == high {
        true => 0.0,
        false => (high - centre).max(centre - low).next_up(),
    });
    let halves = halves.collect();
    (centres, halves)
}

impl SearchBox {
    /// Returns the centre, and upper bounds of the half widths.
    pub(crate) fn centres(&self) -> (Vec<f64>, Vec<f64>) {
        centres(&self.low, &self.high)
    }

    /// Returns the widest name with a positive width among some.
    fn widest(&self, is_one: impl Fn(usize) -> bool) -> Option<usize> {
        let width = |name: &usize| self.high[*name] - self.low[*name];
        let names = (0..self.low.len()).filter(|name| width(name) > 0.0 && is_one(*name));
        names.max_by(|a, b| width(a).total_cmp(&width(b)))
    }

    /// Returns both halves along the name to bisect.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let (mut lower, mut upper) = (self.clone(), self.clone());
        let middle = 0.5 * self.low[self.split] + 0.5 * self.high[self.split];
        lower.high[self.split] = middle;
        upper.low[self.split] = middle;
        [lower, upper]
    }
}
