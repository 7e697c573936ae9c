//! The outline of a cloud of points, and the smallest sphere around it.

use nalgebra::Vector3;

use super::enclosing_sphere::{Ball, Sphere};
use super::peak;
use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Register};

/// Relative width of the shell of points that are kept, inside the sphere of a small sample and of
/// one with more than [`LARGE`] points, whose center is more accurate.
const SHELL: [f64; 2] = [0.1, 0.05];
const LARGE: usize = 2000;
/// Largest number of directions in which points are kept.
const MOST: usize = 1 << 13;
/// Binary logarithm of the number of cells along an edge of the finest grid.
const FINEST: u32 = 30;

/// Viewpoint of an outline: the center of the smallest sphere around some points. Points within the
/// inner radius are dropped.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) centre: [f64; 3],
    inner: f64,
    /// Number of times the cells have doubled their width from the beginning, as a sample of the
    /// cloud suggests.
    doubled: u32,
}

impl View {
    /// Creates the viewpoint of a cloud of `count` points, of which these are a sample.
    pub(super) fn around(points: &[[f64; 3]], count: usize) -> Self {
        let ball = Ball::around(&vectors(points).collect::<Vec<_>>());
        let shell = SHELL[usize::from(points.len() > LARGE)];
        let mut view = Self { centre: ball.centre.into(), inner: (1.0 - shell) * ball.radius, doubled: 0 };
        // If all points are kept, the sphere is the smallest.
        if count > MOST {
            let from = points.iter().map(|point| view.from(*point));
            let outside = from.filter(|from| Vector3::from(*from).norm() > view.inner);
            let mut cells: Vec<u64> = outside.map(|from| cell(from, 0)).collect();
            cells.sort_unstable();
            cells.dedup();
            while cells.len() > MOST / 4 {
                cells.iter_mut().for_each(|cell| *cell = parent(*cell, 1));
                cells.dedup();
                view.doubled += 1;
            }
        }
        view
    }

    /// Returns the vector from the center to a point.
    fn from(&self, point: [f64; 3]) -> [f64; 3] {
        core::array::from_fn(|i| point[i] - self.centre[i])
    }
}

/// Farthest point of a cloud in every direction from a center.
///
/// Directions are the cells of a grid on the faces of a cube, fine enough to separate different
/// directions. While there are too many, the cells double their width. The result depends on the
/// points alone, not on their order or partition: outlines of parts merge into the outline of all.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Outline {
    /// Distance of the farthest point that was dropped inside the inner radius, if any.
    inside: Option<f64>,
    /// Number of times the cells have doubled their width.
    doubled: u32,
    /// Sorted by the numbers of the cells.
    cells: Vec<(u64, Farthest)>,
}

/// Point outside the inner radius.
#[derive(Clone, Copy, Debug)]
struct Point {
    point: [f64; 3],
    /// Square of its distance from the center.
    square: f64,
}

/// Farthest points in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Farthest {
    point: [f64; 3],
    distance: f64,
    /// Distance of the second farthest point, if any.
    other: Option<f64>,
}

impl Farthest {
    /// Merges another one. Of two points at equal distances the one with the larger coordinates
    /// stays, so that the order does not matter.
    fn merge(&mut self, mut next: Self) {
        let order = |one: &Self| (one.distance, one.point);
        if order(&next) > order(self) {
            core::mem::swap(self, &mut next);
        }
        let other = if next.point == self.point { next.other } else { Some(next.distance) };
        self.other = farther(self.other, other);
    }
}

impl Outline {
    /// Creates the outline of some points, with the largest distance of those that were dropped.
    fn new(view: &View, points: &[Point], inside: Option<f64>) -> Self {
        // Open addressing: places in `cells`, at most half of them taken.
        let mut places = vec![u32::MAX; (2 * points.len()).next_power_of_two()];
        let mut cells: Vec<(u64, Farthest)> = Vec::new();
        for Point { point, square } in points {
            let cell = cell(view.from(*point), view.doubled);
            let here = Farthest { point: *point, distance: square.sqrt(), other: None };
            let mut slot = hash(cell);
            loop {
                slot &= places.len() - 1;
                match cells.get_mut(places[slot] as usize) {
                    None => {
                        places[slot] = cells.len() as u32;
                        cells.push((cell, here));
                        break;
                    }
                    Some((known, farthest)) if *known == cell => {
                        farthest.merge(here);
                        break;
                    }
                    Some(_) => slot += 1,
                }
            }
        }
        cells.sort_unstable_by_key(|(cell, _)| *cell);
        let mut outline = Self { inside, doubled: view.doubled, cells };
        outline.unite();
        outline
    }

    /// Merges equal cells, which are neighbours, and doubles their width while there are too many.
    fn unite(&mut self) {
        loop {
            self.cells.dedup_by(|(next, farthest), (cell, kept)| {
                let same = next == cell;
                if same {
                    kept.merge(*farthest);
                }
                same
            });
            if self.cells.len() <= MOST {
                break;
            }
            self.widen(1);
        }
    }

    /// Doubles the width of the cells `doubled` times. They stay sorted.
    fn widen(&mut self, doubled: u32) {
        self.cells.iter_mut().for_each(|(cell, _)| *cell = parent(*cell, doubled));
        self.doubled += doubled;
    }

    /// Merges another outline from the same center.
    pub(super) fn merge(&mut self, other: &Self) {
        self.inside = farther(self.inside, other.inside);
        if self.doubled < other.doubled {
            self.widen(other.doubled - self.doubled);
            self.unite();
        }
        let doubled = self.doubled - other.doubled;
        let others = other.cells.iter().map(|(cell, farthest)| (parent(*cell, doubled), *farthest));
        let mut merged: Vec<(u64, Farthest)> = Vec::with_capacity(self.cells.len() + others.len());
        let mut here = core::mem::take(&mut self.cells).into_iter().peekable();
        for (cell, farthest) in others {
            while let Some(before) = here.next_if(|(before, _)| *before <= cell) {
                merged.push(before);
            }
            match merged.last_mut() {
                Some((same, kept)) if *same == cell => kept.merge(farthest),
                _ => merged.push((cell, farthest)),
            }
        }
        merged.extend(here);
        self.cells = merged;
        self.unite();
    }

    /// Returns whether all cells are valid. They may come from a file.
    pub(super) fn is_sound(&self) -> bool {
        let is_cell = |cell: &u64| {
            let (face, place) = (cell >> (2 * FINEST), cell & ((1 << (2 * FINEST)) - 1));
            face < 6 && place < 1 << (2 * (FINEST - self.doubled))
        };
        self.doubled <= FINEST
            && self.cells.len() <= MOST
            && self.cells.is_sorted_by(|(cell, _), (next, _)| cell < next)
            && self.cells.iter().all(|(cell, _)| is_cell(cell))
    }

    /// Returns the smallest sphere around the cloud, given some known points.
    ///
    /// With `v` from the center of the view to that of the sphere, the distance of the latter from
    /// a point at distance d in direction u is `√(d² − 2d u·v + v²)`. Within a cell `u·v` varies by
    /// at most its width w times `|v|`, and the square is convex in d. Dropped points in a cell are
    /// therefore within the larger of its values at 0 and at the second farthest point, and those
    /// inside the inner radius within `|v| + d`. If this is at most the radius, the sphere is the
    /// smallest.
    pub(super) fn sphere(&self, view: &View, known: &[[f64; 3]]) -> Sphere {
        let kept = self.cells.iter().map(|(_, farthest)| farthest.point.into());
        let Ball { centre, radius } = Ball::around(&vectors(known).chain(kept).collect::<Vec<_>>());
        let v = centre - Vector3::from(view.centre);
        let mut certain = self.inside.map_or(radius, |inside| radius.max(v.norm() + inside));
        for (_, Farthest { point, distance, other }) in &self.cells {
            let Some(other) = other else { continue };
            let along = (Vector3::from(*point) - Vector3::from(view.centre)).dot(&v) / distance;
            let least = along - width(self.doubled) * v.norm();
            let square = (other * (other - 2.0 * least)).max(0.0) + v.norm_squared();
            certain = certain.max(square.sqrt());
        }
        Sphere { centre: centre.into(), radius: certain, excess: certain - radius }
    }
}

/// Returns the larger of two distances that may be missing.
fn farther(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    one.into_iter().chain(other).reduce(f64::max)
}

fn vectors(points: &[[f64; 3]]) -> impl Iterator<Item = Vector3<f64>> {
    points.iter().copied().map(Vector3::from)
}

/// Returns the number of the cell in which a direction meets the cube around the center: its face,
/// and the interleaved digits of its position along both edges, so that cells with the same parent
/// follow each other.
fn cell([x, y, z]: [f64; 3], doubled: u32) -> u64 {
    let (axis, along, first, second) = match [x.abs(), y.abs(), z.abs()] {
        [a, b, c] if a >= b && a >= c => (0, x, y, z),
        [_, b, c] if b >= c => (1, y, z, x),
        _ => (2, z, x, y),
    };
    let face = 2 * axis + u64::from(along < 0.0);
    let place = |edge: f64| {
        let share = (edge / along.abs() + 1.0) / 2.0;
        // Clamped at the last edge. NaN, at the center, gives 0.
        ((share * f64::from(1_u32 << FINEST)) as u64).min((1 << FINEST) - 1) >> doubled
    };
    face << (2 * FINEST) | spread(place(first)) << 1 | spread(place(second))
}

/// Returns the cell that contains this one after the width has doubled `doubled` times.
fn parent(cell: u64, doubled: u32) -> u64 {
    let mask = (1 << (2 * FINEST)) - 1;
    cell & !mask | (cell & mask) >> (2 * doubled)
}

/// Puts a 0 before each of the 32 binary digits of a number.
fn spread(number: u64) -> u64 {
    let mut spread = number;
    for (shift, mask) in [
        (16, 0x0000_ffff_0000_ffff),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ] {
        spread = (spread | spread << shift) & mask;
    }
    spread
}

/// Scatters the numbers of cells by Fibonacci hashing, with 2⁶⁴ over the golden ratio.
fn hash(cell: u64) -> usize {
    (cell.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize
}

/// Returns an upper bound of the distance of two unit vectors in a cell: the diagonal of the cell
/// on the cube, whose faces are at distance 1. The central projection to the sphere does not
/// lengthen it.
fn width(doubled: u32) -> f64 {
    core::f64::consts::SQRT_2 * 2.0 / f64::from(1_u32 << (FINEST - doubled))
}

/// Accumulates an [`Outline`] in lanes.
pub(super) struct OutlineAccumulator<R: Register> {
    view: View,
    /// Largest squared distance within the inner radius. −1 if there is none.
    inside: Lanes<R>,
    outside: Vec<Point>,
}

impl<R: Register> OutlineAccumulator<R> {
    pub(super) fn new(view: View) -> Self {
        Self { view, inside: Lanes::constant(-1.0), outside: Vec::new() }
    }

    /// Adds the points of a tile. Points of weight 0 repeat the last one.
    #[inline(always)]
    pub(super) fn add(&mut self, points: [Lanes<R>; 3], weight: Lanes<R>) {
        let centre = self.view.centre.map(Lanes::constant);
        let from = core::array::from_fn(|i| points[i] - centre[i]);
        let square = peak::square(from);
        let outside = square.more_than(Lanes::constant(self.view.inner * self.view.inner));
        if !outside.any() {
            self.inside = square.max(self.inside);
            return;
        }
        let [x, y, z] = points.each_ref().map(Lanes::to_slice);
        let mut inside = -1.0_f64;
        for (lane, square) in square.to_slice().iter().enumerate() {
            if *square <= self.view.inner * self.view.inner {
                inside = inside.max(*square);
            } else if weight.to_slice()[lane] > 0.0 {
                self.outside.push(Point { point: [x[lane], y[lane], z[lane]], square: *square });
            }
        }
        self.inside = Lanes::constant(inside).max(self.inside);
    }

    pub(super) fn finish(self) -> Outline {
        let inside = Some(peak::largest(self.inside)).filter(|square| *square >= 0.0).map(f64::sqrt);
        Outline::new(&self.view, &self.outside, inside)
    }
}

#[cfg(test)]
mod tests;
