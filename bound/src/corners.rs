//! Upper bound of a norm within a box, taken at control points.
//!
//! The value of each part at any point of the box is a weighted mean of its control points, which
//! are combinations of those of each name (`controls`). A norm is convex in its parts, so it is
//! nowhere larger than at one of them. Control points of affine parts are the values at the
//! vertices of polygons; those of quadratic parts follow from the values at all samples, name by
//! name.
//!
//! The samples of two names are evaluated in lanes. The other names step through their samples one
//! after the other, and operations that do not depend on the changed names are not repeated.

use abbe_core::lanes::{InstructionSet, Kernel, Register};

use crate::affine::above;
use crate::controls::{AFFINE, Controls, QUADRATIC, Shape, Vertex};
use crate::convex::{At, Convex, Names, Operation};
use crate::vertex::{Lanes, Number, Size, result};

/// Number of names whose samples are in lanes.
const IN_LANES: usize = 2;
/// Number of lanes for norms of affine parts.
const FEW_LANES: usize = AFFINE * AFFINE;
/// Number of lanes for norms of quadratic parts: whole registers.
const MANY_LANES: usize = (QUADRATIC * QUADRATIC).next_multiple_of(8);
/// Maximum number of moving names: k angles have `AFFINE`^k vertices.
const MOST_NAMES: usize = 8;
/// Maximum number of samples of quadratic parts: seven angles.
const MOST_SAMPLES: usize = 300_000;

/// A norm and the order in which its names step.
#[derive(Clone, Debug)]
pub(crate) struct Corners {
    norm: Convex,
    shapes: Vec<Shape>,
    /// Order of the names, those in lanes first.
    order: Vec<usize>,
    /// Operations to repeat when a name outside the lanes steps and all names before it restart.
    again: Vec<Vec<At>>,
    /// Largest number of samples of a box.
    samples: usize,
    set: InstructionSet,
}

/// The control point with the largest norm.
#[derive(Clone, Debug)]
pub(crate) struct Corner {
    /// Upper bound of the norm in the box.
    pub(crate) most: f64,
    /// Position of each name between both ends of its range.
    shares: Vec<f64>,
}

/// Reusable buffers.
#[derive(Debug, Default)]
pub(crate) struct Buffers {
    few: Vec<Lanes<FEW_LANES>>,
    many: Vec<Lanes<MANY_LANES>>,
    sizes: Vec<Size>,
    /// Values of each part at all samples, and at the control points of some names.
    values: Vec<Vec<f64>>,
    other: Vec<f64>,
}

impl Corners {
    /// Creates the evaluation of a norm. Returns `None` for no names, more than `MOST_NAMES`, or
    /// more than `MOST_SAMPLES` samples of quadratic parts.
    pub(crate) fn new(norm: Convex) -> Option<Self> {
        let names = norm.angles.len();
        let shapes = norm.angles.iter().enumerate().map(|(name, is_angle)| Shape {
            is_angle: *is_angle,
            is_quadratic: norm.quadratic & (1 << name) != 0,
        });
        let shapes: Vec<Shape> = shapes.collect();
        if names == 0 || names > MOST_NAMES {
            return None;
        }
        let samples: usize = shapes.iter().map(|shape| shape.samples()).product();
        if norm.quadratic != 0 && samples > MOST_SAMPLES {
            return None;
        }
        let depends = depends(&norm.operations);
        let order = order(&depends, names);
        let is_stored = |at: &At| norm.quadratic == 0 || norm.outer.binary_search(at).is_err();
        let again = (IN_LANES..names).map(|last| {
            let moved: Names = order[IN_LANES..=last].iter().map(|name| 1 << name).sum();
            (0..depends.len()).filter(|at| depends[*at] & moved != 0).filter(is_stored).collect()
        });
        let again = again.collect();
        Some(Self { norm, shapes, order, again, samples, set: InstructionSet::best() })
    }

    /// Returns the largest number of samples of a box if a part is quadratic, or 1.
    pub(crate) fn samples(&self) -> usize {
        if self.norm.quadratic == 0 { 1 } else { self.samples }
    }

    /// Returns `true` if the arc of a name is too long for a useful bound.
    pub(crate) fn is_too_long(&self, name: usize, ends: [f64; 2]) -> bool {
        self.shapes[name].is_too_long(ends)
    }

    /// Returns the control point with the largest norm in a box whose arcs are short enough.
    /// Returns `None` if the rounding error is unbounded.
    pub(crate) fn largest(&self, numbers: &mut Buffers, low: &[f64], high: &[f64]) -> Option<Corner> {
        let ends = low.iter().zip(high).map(|(low, high)| [*low, *high]);
        let controls = self.shapes.iter().zip(ends).map(|(shape, ends)| Controls::new(*shape, ends));
        let controls: Vec<Controls> = controls.collect();
        let off = self.off(&mut numbers.sizes, &controls);
        let Buffers { few, many, values, other, .. } = numbers;
        let (largest, at) = match self.norm.quadratic {
            0 => self.set.run(Rounded { corners: self, lanes: few, values, other, controls: &controls }),
            _ => self.set.run(Rounded { corners: self, lanes: many, values, other, controls: &controls }),
        };
        let shares = controls.iter().zip(at).map(|(controls, at)| controls.share(at)).collect();
        off.is_finite().then(|| Corner { most: above(largest + off), shares })
    }

    /// Returns a bound of the rounding error of the norm at any control point.
    fn off(&self, sizes: &mut Vec<Size>, controls: &[Controls]) -> f64 {
        let of_all = |controls: &Controls, part: usize| {
            let sizes = controls.samples.iter().map(|vertex| Size::known(&vertex[part]));
            sizes.fold(Size::NOTHING, Size::hull)
        };
        let names: Vec<[Size; 2]> = controls.iter().map(|own| [0, 1].map(|part| of_all(own, part))).collect();
        sizes.clear();
        for operation in &self.norm.operations {
            let size = result(operation, sizes, &names);
            sizes.push(size);
        }
        if self.norm.quadratic != 0 {
            for part in &self.norm.parts {
                let at_samples = sizes[*part];
                sizes[*part] = controls.iter().fold(at_samples, |size, own| {
                    own.points(&[size; QUADRATIC]).into_iter().fold(Size::NOTHING, Size::hull)
                });
            }
            for operation in &self.norm.outer {
                sizes[*operation] = result(&self.norm.operations[*operation], sizes, &names);
            }
        }
        sizes.last().map_or(f64::INFINITY, |norm| norm.off)
    }
}

/// Computes the largest rounded norm at a control point, and the control point of each name there.
struct Rounded<'a, const N: usize> {
    corners: &'a Corners,
    lanes: &'a mut Vec<Lanes<N>>,
    values: &'a mut Vec<Vec<f64>>,
    other: &'a mut Vec<f64>,
    controls: &'a [Controls],
}

/// The largest norm so far, and the index of its control point.
struct Largest {
    norm: f64,
    index: usize,
}

impl Largest {
    #[inline(always)]
    fn include<const N: usize>(&mut self, norms: &Lanes<N>, first: usize, count: usize) {
        for (lane, norm) in norms.iter().take(count).enumerate() {
            if *norm > self.norm {
                *self = Self { norm: *norm, index: first + lane };
            }
        }
    }
}

impl<const N: usize> Kernel for Rounded<'_, N> {
    type Output = (f64, Vec<usize>);

    #[inline(always)]
    fn run<R: Register>(mut self) -> Self::Output {
        let order = &self.corners.order;
        let mut counts: Vec<usize> = order.iter().map(|name| self.controls[*name].samples.len()).collect();
        let mut largest = Largest { norm: f64::NEG_INFINITY, index: 0 };
        self.at_samples(&counts, &mut largest);
        if self.corners.norm.quadratic != 0 {
            for place in 0..order.len() {
                self.along(place, &mut counts);
            }
            self.at_controls(&mut largest);
        }
        let mut at = vec![0; order.len()];
        let mut index = largest.index;
        for (name, count) in order.iter().zip(&counts) {
            at[*name] = index % count;
            index /= count;
        }
        (largest.norm, at)
    }
}

impl<const N: usize> Rounded<'_, N> {
    /// Evaluates all samples: the norm of affine parts, or the values of quadratic ones.
    #[inline(always)]
    fn at_samples(&mut self, counts: &[usize], largest: &mut Largest) {
        let Self { corners: Corners { norm, order, again, .. }, lanes, values, controls, .. } = self;
        let (in_lanes, outside) = order.split_at(order.len().min(IN_LANES));
        let inner: usize = counts[..in_lanes.len()].iter().product();
        let mut names: Vec<[Lanes<N>; 2]> = controls.iter().map(|own| all_lanes(&own.samples[0])).collect();
        let mut stride = 1;
        for (name, count) in in_lanes.iter().zip(counts) {
            let own = |lane: usize| &controls[*name].samples[lane.min(inner - 1) / stride % count];
            names[*name] = [0, 1].map(|part| std::array::from_fn(|lane| own(lane)[part].centre));
            stride *= count;
        }
        lanes.clear();
        for operation in &norm.operations {
            let value = result(operation, lanes, &names);
            lanes.push(value);
        }
        if norm.quadratic != 0 {
            values.resize_with(norm.parts.len(), Vec::new);
            values.iter_mut().for_each(Vec::clear);
        }
        let mut at = vec![0; outside.len()];
        for first in (0..).step_by(inner) {
            if norm.quadratic == 0 {
                largest.include(&lanes[lanes.len() - 1], first, inner);
            } else {
                for (values, part) in values.iter_mut().zip(&norm.parts) {
                    values.extend_from_slice(&lanes[*part][..inner]);
                }
            }
            let next = (0..outside.len()).find(|place| at[*place] + 1 < counts[IN_LANES + place]);
            let Some(next) = next else { return };
            for (place, name) in outside[..=next].iter().enumerate() {
                at[place] = if place == next { at[place] + 1 } else { 0 };
                names[*name] = all_lanes(&controls[*name].samples[at[place]]);
            }
            for operation in &again[next] {
                lanes[*operation] = result(&norm.operations[*operation], lanes, &names);
            }
        }
    }

    /// Replaces the values at the samples of a name by its control points.
    #[inline(always)]
    fn along(&mut self, place: usize, counts: &mut [usize]) {
        let controls = &self.controls[self.corners.order[place]];
        if controls.are_samples() {
            return;
        }
        let stride: usize = counts[..place].iter().product();
        let (samples, count) = (counts[place], controls.count());
        for values in self.values.iter_mut() {
            self.other.clear();
            self.other.resize(values.len() / samples * count, 0.0);
            let blocks =
                values.chunks_exact(samples * stride).zip(self.other.chunks_exact_mut(count * stride));
            for (values, points) in blocks {
                for i in 0..stride {
                    let own = std::array::from_fn(|sample| [values[sample.min(samples - 1) * stride + i]]);
                    for (control, [point]) in controls.points(&own).into_iter().take(count).enumerate() {
                        points[control * stride + i] = point;
                    }
                }
            }
            std::mem::swap(values, self.other);
        }
        counts[place] = count;
    }

    /// Evaluates the norm at all control points.
    #[inline(always)]
    fn at_controls(&mut self, largest: &mut Largest) {
        let Self { corners: Corners { norm, .. }, lanes, values, .. } = self;
        let total = values.first().map_or(0, Vec::len);
        for first in (0..total).step_by(N) {
            let count = N.min(total - first);
            for (values, part) in values.iter().zip(&norm.parts) {
                lanes[*part][..count].copy_from_slice(&values[first..first + count]);
            }
            for operation in &norm.outer {
                lanes[*operation] = result(&norm.operations[*operation], lanes, &[]);
            }
            largest.include(&lanes[lanes.len() - 1], first, count);
        }
    }
}

impl Corner {
    /// Returns `true` if a name is at neither end of its range.
    pub(crate) fn is_outside(&self, name: usize) -> bool {
        self.shares[name] > 0.0 && self.shares[name] < 1.0
    }

    /// Returns the nearest point of the box.
    pub(crate) fn nearest(&self, low: &[f64], high: &[f64]) -> Vec<f64> {
        let ends = low.iter().zip(high).zip(&self.shares);
        let near =
            ends.map(|((low, high), share)| if *share == 1.0 { *high } else { low + (high - low) * share });
        near.collect()
    }
}

#[inline(always)]
fn all_lanes<const N: usize>(vertex: &Vertex) -> [Lanes<N>; 2] {
    vertex.map(|part| [part.centre; N])
}

/// Returns the names that each operation depends on.
fn depends(operations: &[Operation]) -> Vec<Names> {
    let mut depends: Vec<Names> = Vec::with_capacity(operations.len());
    for operation in operations {
        let own = match operation {
            Operation::Name(name, _) => 1 << name,
            _ => operation.operands().fold(0, |names, operand| names | depends[operand]),
        };
        depends.push(own);
    }
    depends
}

/// Orders the names so that the fewest operations depend on the first one, then the fewest
/// remaining ones on the next.
fn order(depends: &[Names], names: usize) -> Vec<usize> {
    let mut order: Vec<usize> = Vec::with_capacity(names);
    let mut chosen: Names = 0;
    while order.len() < names {
        let left = (0..names).filter(|name| chosen & (1 << name) == 0);
        let rest = |name: &usize| {
            depends.iter().filter(|own| **own & chosen == 0 && **own & (1 << name) != 0).count()
        };
        let Some(next) = left.min_by_key(rest) else { break };
        chosen |= 1 << next;
        order.push(next);
    }
    order
}

#[cfg(test)]
mod tests;
