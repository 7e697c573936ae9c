//! What a reading is at a place, and how it moves with every unknown.
//!
//! A gauge tells a function `g(p)` of where a target is, seen in `F_0`. An unknown of the chain moves the target by `dp` and
//! turns the tool by `dω`, seen by the instrument, and so the reading by `∇g · dp` (or `∇g · dω` of an angle), `∇g` in the axes of the
//! instrument. An error of the base moves fixtures and targets alike: it moves no reading but coordinates.

use super::reading::{dot, tangents, unit};
use super::residuals::Room;
use super::{Gauge, Model, Place, Unknown};

/// A reading and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gradient {
    /// What the instrument should tell.
    pub(super) value: f64,
    /// How it changes as the target moves, or as the tool turns if it is an angle; in the axes of the instrument.
    pub(super) along: [f64; 3],
    /// The same in the axes of `F_0`.
    along_in_f0: [f64; 3],
    /// What a direction is held against, in `F_0`: the target from where it is about, or the normal of the mirror.
    seen: [f64; 3],
}

impl Model<'_> {
    /// Reading `i`, the chain of `room` being where it is.
    pub(super) fn gradient(&self, room: &Room, i: usize) -> Gradient {
        let base = room.frames[0].after;
        let last = room.frames[room.errors.len() + 1].after;
        let in_f0 = base.inverse().then(&last);
        let target = |j: usize| in_f0.apply(room.targets[j]);
        let fixture = |f: usize| self.fixtures[f].place.moved(&room.fixtures[f]).vector();
        let difference = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] { core::array::from_fn(|i| a[i] - b[i]) };
        let (value, along, seen) = match self.readings[i].gauge {
            Gauge::Coordinate { target: j, axis } => {
                let point = last.apply(room.targets[j]);
                let along = core::array::from_fn(|i| base.0[i][axis]);
                (point[axis], along, target(j))
            }
            Gauge::Distance { target: j, from } => {
                let apart = difference(target(j), fixture(from));
                (dot(apart, apart).sqrt(), unit(apart), target(j))
            }
            Gauge::Apart { target: j, from, axis } => {
                let along = core::array::from_fn(|i| f64::from(u8::from(i == axis)));
                (target(j)[axis] - fixture(from)[axis], along, target(j))
            }
            Gauge::Along { target: j, about, direction } => {
                let (n, apart) = (fixture(direction), difference(target(j), about));
                (dot(n, apart), n, apart)
            }
            Gauge::Between { targets: [j, k] } => {
                let apart = difference(target(j), target(k));
                (dot(apart, apart).sqrt(), unit(apart), target(j))
            }
            Gauge::Moved { target: j } => {
                let apart = room.start.as_ref().map_or([0.0; 3], |start| {
                    let there =
                        start.frames[0].after.inverse().then(&start.frames[start.errors.len() + 1].after);
                    difference(target(j), there.apply(start.targets[j]))
                });
                (dot(apart, apart).sqrt(), unit(apart), target(j))
            }
            Gauge::Lean { mirror, direction } => {
                // d asin(n · m) = (m × n) · dω / √(1 − (n · m)²).
                let (m, n) = (in_f0.turn(mirror), fixture(direction));
                let sine = dot(n, m).clamp(-1.0, 1.0);
                let cosine = (1.0 - sine * sine).sqrt().max(f64::MIN_POSITIVE);
                (sine.asin(), super::columns::cross(m, n).map(|v| v / cosine), m)
            }
        };
        Gradient { value: value + room.zeros[i], along: base.turn(along), along_in_f0: along, seen }
    }

    /// How reading `i` moves with unknown `k`.
    pub(super) fn moves(&self, room: &Room, i: usize, gradient: &Gradient, k: usize) -> f64 {
        let gauge = self.readings[i].gauge;
        let Gradient { along, along_in_f0, seen, .. } = *gradient;
        let fixed = gauge.fixture();
        match self.unknowns[k] {
            Unknown::Zero(reading) => f64::from(u8::from(reading == i)),
            Unknown::Fixture(f, coordinate) if fixed == Some(f) => match gauge {
                Gauge::Distance { .. } | Gauge::Apart { .. } => -along_in_f0[coordinate],
                Gauge::Along { .. } => dot(seen, self.tilted(room, f, coordinate)),
                Gauge::Lean { .. } => {
                    let tilt = self.tilted(room, f, coordinate);
                    let n = self.fixtures[f].place.moved(&room.fixtures[f]).vector();
                    let sine = dot(n, seen).clamp(-1.0, 1.0);
                    dot(seen, tilt) / (1.0 - sine * sine).sqrt().max(f64::MIN_POSITIVE)
                }
                Gauge::Coordinate { .. } | Gauge::Between { .. } | Gauge::Moved { .. } => 0.0,
            },
            Unknown::Fixture(..) => 0.0,
            Unknown::Base(..) if !matches!(gauge, Gauge::Coordinate { .. }) => 0.0,
            _ => match gauge {
                Gauge::Coordinate { target, .. }
                | Gauge::Distance { target, .. }
                | Gauge::Apart { target, .. }
                | Gauge::Along { target, .. } => dot(along, self.point_moves(room, k, target)),
                Gauge::Between { targets: [a, b] } => {
                    dot(along, self.point_moves(room, k, a)) - dot(along, self.point_moves(room, k, b))
                }
                Gauge::Moved { target } => {
                    let there =
                        room.start.as_ref().map_or([0.0; 3], |start| self.point_moves(start, k, target));
                    dot(along, self.point_moves(room, k, target)) - dot(along, there)
                }
                Gauge::Lean { .. } => dot(along, self.turn(room, k)),
            },
        }
    }

    fn point_moves(&self, room: &Room, k: usize, target: usize) -> [f64; 3] {
        let last = room.frames[room.errors.len() + 1].after;
        self.point(room, k, target, last.apply(room.targets[target]))
    }

    /// How a direction `n = (n_0 + a t_1 + b t_2) / |…|` moves with one of its tilts: `(t − n (n · t)) / |…|`.
    fn tilted(&self, room: &Room, fixture: usize, coordinate: usize) -> [f64; 3] {
        let Place::Direction(nominal) = self.fixtures[fixture].place else { return [0.0; 3] };
        let t = tangents(nominal)[coordinate];
        let [a, b, _] = room.fixtures[fixture];
        let n = self.fixtures[fixture].place.moved(&room.fixtures[fixture]).vector();
        let along = dot(n, t);
        core::array::from_fn(|i| (t[i] - n[i] * along) / (1.0 + a * a + b * b).sqrt())
    }
}
