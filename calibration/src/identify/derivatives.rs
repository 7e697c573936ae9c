//! Derivatives of points, rotations and observables with respect to the unknowns.
//!
//! An unknown of the chain moves a target by `dp` and rotates the tool by `dω`, in the axes of the
//! instrument, so an observable changes by `∇g · dp`, or by `∇g · dω` for an angle. An error of the
//! base moves fixtures and targets alike and changes only observables that [see the
//! base](super::InstrumentKind::sees_base).

use super::columns::Frame;
use super::instrument::{Evaluation, Geometry};
use super::{EvaluatedModel, FixtureGeometry, Reference, Unknown};
use abbe_analysis::sampling::vectors::{dot, tangents};
use abbe_core::Component;

impl EvaluatedModel<'_> {
    /// Returns the positions and orientations that observables depend on, after
    /// [`chain`](Self::chain).
    pub(super) fn geometry(&self) -> Geometry<'_> {
        let in_f0 = |here: &Self| here.base_pose().inverse().then(&here.tool_pose());
        Geometry {
            base: self.base_pose(),
            tool: self.tool_pose(),
            tool_in_f0: in_f0(self),
            targets: &self.targets[self.first_target..],
            fixtures: &self.model.fixtures,
            displacements: &self.fixtures,
            camera: self.camera.as_ref(),
            previous: self
                .previous
                .as_ref()
                .map(|previous| (in_f0(previous), &previous.targets[previous.first_target..])),
        }
    }

    /// Evaluates observable `i`; the value includes the zero.
    pub(super) fn evaluate(&self, geometry: &Geometry, i: usize) -> Evaluation {
        let observable = &self.model.observables[i];
        let evaluation = (observable.kind.evaluate)(observable, geometry);
        Evaluation { value: evaluation.value + self.zeros[i], ..evaluation }
    }

    /// Returns the derivative of observable `i` with respect to unknown `k` as a difference: the
    /// part of this row, and the part of the row that the observable refers to.
    ///
    /// `along` is the gradient of its evaluation in the axes of the instrument.
    pub(super) fn observable_derivative(
        &self,
        i: usize,
        evaluation: &Evaluation,
        along: [f64; 3],
        k: usize,
    ) -> [f64; 2] {
        let model = self.model;
        let observable = &model.observables[i];
        match model.unknowns[k] {
            Unknown::Zero(zero) => [f64::from(u8::from(zero == i)), 0.0],
            Unknown::Intrinsic(parameter) => [evaluation.by_intrinsics[parameter], 0.0],
            Unknown::Fixture(f, coordinate) if observable.fixture == Some(f) => {
                let derivative = match model.fixtures[f].geometry {
                    FixtureGeometry::Point(_) => evaluation.by_fixture[coordinate],
                    FixtureGeometry::Direction(n) => {
                        dot(evaluation.by_fixture, tilt_derivative(n, &self.fixtures[f], coordinate))
                    }
                };
                [derivative, 0.0]
            }
            Unknown::Fixture(..) => [0.0; 2],
            Unknown::Base(..) if !observable.kind.sees_base => [0.0; 2],
            _ => {
                let [first, second] = observable.targets;
                let change = |here: &Self, target: usize| match observable.kind.is_angle {
                    true => dot(along, here.turn(k)),
                    false => {
                        let target = here.first_target + target;
                        let of_target = || (target, here.tool_pose().apply(here.targets[target]));
                        let (target, position) = evaluation.at.map_or_else(of_target, |at| (usize::MAX, at));
                        dot(along, here.point(k, target, position))
                    }
                };
                let here = change(self, first);
                match observable.kind.reference {
                    Reference::None => [here, 0.0],
                    Reference::Target => [here - change(self, second), 0.0],
                    Reference::PreviousRow => {
                        [here, self.previous.as_ref().map_or(0.0, |previous| change(previous, first))]
                    }
                }
            }
        }
    }

    /// Returns the derivative of a point of target `j` of the model with respect to unknown `k`, in
    /// the axes of the instrument.
    pub(super) fn point(&self, k: usize, j: usize, point: [f64; 3]) -> [f64; 3] {
        match self.model.unknowns[k] {
            Unknown::Target(target, axis) if target == j => self.frames[self.errors.len() + 1].after.0[axis],
            unknown => self.by_frames(
                unknown,
                |frame, component| frame.point(component, point),
                |frame, component| self.point_by_error(frame, component, point),
            ),
        }
    }

    /// Returns the rotation vector of the tool per unit of unknown `k`, in the axes of the
    /// instrument.
    pub(super) fn turn(&self, k: usize) -> [f64; 3] {
        let by_error = |frame, component| self.turn_by_error(frame, component);
        self.by_frames(self.model.unknowns[k], Frame::turn, by_error)
    }

    /// Returns a derivative with respect to an unknown that displaces frames: `displaced` is that
    /// by a displacement of the base or the tool, `by_error` that by an error of a frame.
    fn by_frames(
        &self,
        unknown: Unknown,
        displaced: impl Fn(&Frame, Component) -> [f64; 3],
        by_error: impl Fn(usize, Component) -> [f64; 3],
    ) -> [f64; 3] {
        match unknown {
            Unknown::Base(station, component) if station == self.station => {
                displaced(&self.frames[0], component)
            }
            Unknown::Error(frame, component) => by_error(frame, component),
            Unknown::Tool(placement, component) if placement == self.placement => {
                displaced(&self.frames[self.errors.len() + 1], component)
            }
            Unknown::Base(..)
            | Unknown::Tool(..)
            | Unknown::Target(..)
            | Unknown::Fixture(..)
            | Unknown::Zero(_)
            | Unknown::Intrinsic(_) => [0.0; 3],
            Unknown::Magnitude(source) => self.by_magnitude(source, by_error),
        }
    }

    /// Adds the derivatives of all effects of a source.
    fn by_magnitude(&self, source: usize, derivative: impl Fn(usize, Component) -> [f64; 3]) -> [f64; 3] {
        let description = self.model.manipulator.description();
        let mut sum = [0.0; 3];
        for (effect, size) in description.effects.iter().zip(&self.effects) {
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
