//! Derivatives of points, rotations and observables with respect to the unknowns.
//!
//! An unknown of the chain moves a target by `dp` and rotates the tool by `dω`, in the axes of the
//! instrument, so an observable changes by `∇g · dp`, or by `∇g · dω` for an angle. An error of the
//! base moves fixtures and targets alike and changes only observables that [see the
//! base](super::InstrumentKind::sees_base).

use super::columns::Frame;
use super::instrument::{Evaluation, Geometry};
use super::scratch::Scratch;
use super::vectors::dot;
use super::{FixtureGeometry, Model, Reference, Unknown, tangents};
use abbe_core::Component;

impl Model<'_> {
    /// Returns the positions and orientations that observables depend on, after
    /// [`chain`](Self::chain).
    pub(super) fn geometry<'a>(&'a self, scratch: &'a Scratch) -> Geometry<'a> {
        let in_f0 = |scratch: &Scratch| scratch.base().inverse().then(&scratch.tool());
        Geometry {
            base: scratch.base(),
            tool: scratch.tool(),
            tool_in_f0: in_f0(scratch),
            targets: &scratch.targets[scratch.first_target..],
            fixtures: &self.fixtures,
            displacements: &scratch.fixtures,
            camera: scratch.camera.as_ref(),
            previous: scratch
                .previous
                .as_ref()
                .map(|previous| (in_f0(previous), &previous.targets[previous.first_target..])),
        }
    }

    /// Evaluates observable `i`; the value includes the zero.
    pub(super) fn evaluate(&self, scratch: &Scratch, geometry: &Geometry, i: usize) -> Evaluation {
        let observable = &self.observables[i];
        let evaluation = (observable.kind.evaluate)(observable, geometry);
        Evaluation { value: evaluation.value + scratch.zeros[i], ..evaluation }
    }

    /// Returns the derivative of observable `i` with respect to unknown `k` as a difference: the
    /// part of this row, and the part of the row that the observable refers to.
    ///
    /// `along` is the gradient of its evaluation in the axes of the instrument.
    pub(super) fn observable_derivative(
        &self,
        scratch: &Scratch,
        i: usize,
        evaluation: &Evaluation,
        along: [f64; 3],
        k: usize,
    ) -> [f64; 2] {
        let observable = &self.observables[i];
        match self.unknowns[k] {
            Unknown::Zero(zero) => [f64::from(u8::from(zero == i)), 0.0],
            Unknown::Intrinsic(parameter) => [evaluation.by_intrinsics[parameter], 0.0],
            Unknown::Fixture(f, coordinate) if observable.fixture == Some(f) => {
                let derivative = match self.fixtures[f].geometry {
                    FixtureGeometry::Point(_) => evaluation.by_fixture[coordinate],
                    FixtureGeometry::Direction(n) => {
                        dot(evaluation.by_fixture, tilt_derivative(n, &scratch.fixtures[f], coordinate))
                    }
                };
                [derivative, 0.0]
            }
            Unknown::Fixture(..) => [0.0; 2],
            Unknown::Base(..) if !observable.kind.sees_base => [0.0; 2],
            _ => {
                let [first, second] = observable.targets;
                let change = |scratch: &Scratch, target: usize| match observable.kind.is_angle {
                    true => dot(along, self.turn(scratch, k)),
                    false => {
                        let target = scratch.first_target + target;
                        let of_target = || (target, scratch.tool().apply(scratch.targets[target]));
                        let (target, position) = evaluation.at.map_or_else(of_target, |at| (usize::MAX, at));
                        dot(along, self.point(scratch, k, target, position))
                    }
                };
                let here = change(scratch, first);
                match observable.kind.reference {
                    Reference::None => [here, 0.0],
                    Reference::Target => [here - change(scratch, second), 0.0],
                    Reference::PreviousRow => {
                        [here, scratch.previous.as_ref().map_or(0.0, |previous| change(previous, first))]
                    }
                }
            }
        }
    }

    /// Returns the derivative of a point of target `j` of the model with respect to unknown `k`, in
    /// the axes of the instrument.
    pub(super) fn point(&self, scratch: &Scratch, k: usize, j: usize, point: [f64; 3]) -> [f64; 3] {
        match self.unknowns[k] {
            Unknown::Target(target, axis) if target == j => {
                scratch.frames[scratch.errors.len() + 1].after.0[axis]
            }
            unknown => self.by_frames(
                scratch,
                unknown,
                |frame, component| frame.point(component, point),
                |frame, component| scratch.point(frame, component, point),
            ),
        }
    }

    /// Returns the rotation vector of the tool per unit of unknown `k`, in the axes of the
    /// instrument.
    pub(super) fn turn(&self, scratch: &Scratch, k: usize) -> [f64; 3] {
        let by_error = |frame, component| scratch.turn(frame, component);
        self.by_frames(scratch, self.unknowns[k], Frame::turn, by_error)
    }

    /// Returns a derivative with respect to an unknown that displaces frames: `displaced` is that
    /// by a displacement of the base or the tool, `by_error` that by an error of a frame.
    fn by_frames(
        &self,
        scratch: &Scratch,
        unknown: Unknown,
        displaced: impl Fn(&Frame, Component) -> [f64; 3],
        by_error: impl Fn(usize, Component) -> [f64; 3],
    ) -> [f64; 3] {
        match unknown {
            Unknown::Base(station, component) if station == scratch.station => {
                displaced(&scratch.frames[0], component)
            }
            Unknown::Error(frame, component) => by_error(frame, component),
            Unknown::Tool(placement, component) if placement == scratch.placement => {
                displaced(&scratch.frames[scratch.errors.len() + 1], component)
            }
            Unknown::Base(..)
            | Unknown::Tool(..)
            | Unknown::Target(..)
            | Unknown::Fixture(..)
            | Unknown::Zero(_)
            | Unknown::Intrinsic(_) => [0.0; 3],
            Unknown::Magnitude(source) => self.by_magnitude(scratch, source, by_error),
        }
    }

    /// Adds the derivatives of all effects of a source.
    fn by_magnitude(
        &self,
        scratch: &Scratch,
        source: usize,
        derivative: impl Fn(usize, Component) -> [f64; 3],
    ) -> [f64; 3] {
        let description = self.manipulator.description();
        let mut sum = [0.0; 3];
        for (effect, size) in description.effects.iter().zip(&scratch.effects) {
            if effect.source == source {
                let moved = derivative(effect.frame, effect.component);
                sum = core::array::from_fn(|i| sum[i] + size * moved[i]);
            }
        }
        sum
    }
}

/// Returns the derivative of the direction `n = (n_0 + a t_1 + b t_2) / |…|` with respect to tilt
/// `coordinate`.
///
/// `(t − n (n · t)) / √(1 + a² + b²)`, with `[a, b]` the tilts.
fn tilt_derivative(nominal: [f64; 3], tilts: &[f64; 3], coordinate: usize) -> [f64; 3] {
    let t = tangents(nominal)[coordinate];
    let [a, b, _] = *tilts;
    let n = FixtureGeometry::Direction(nominal).displaced(tilts).vector();
    let along = dot(n, t);
    core::array::from_fn(|i| (t[i] - n[i] * along) / (1.0 + a * a + b * b).sqrt())
}
