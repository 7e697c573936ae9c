//! Maximum per lane, with its place; of equal values, the first.

use super::extreme::{Extreme, comparable};
use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Register};

/// Largest value in every lane, and the place of the first configuration with a
/// [`comparable`] one.
#[derive(Clone, Copy)]
pub(super) struct Peak<R: Register> {
    value: Lanes<R>,
    compared: Lanes<R>,
    place: Lanes<R>,
}

impl<R: Register> Peak<R> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        let none = Lanes::constant(f64::NEG_INFINITY);
        Self { value: none, compared: none, place: Lanes::constant(-1.0) }
    }

    /// Adds the value at a place. Norms are compared by their squares, as [`Extreme`] does it.
    #[inline(always)]
    pub(super) fn add(&mut self, value: Lanes<R>, square: Lanes<R>, place: Lanes<R>) {
        let compared = comparable(square);
        let more = compared.more_than(self.compared);
        self.value = value.max(self.value);
        self.compared = more.select(compared, self.compared);
        self.place = more.select(place, self.place);
    }

    /// Returns the largest value of all lanes, and the index of the first place with a comparable
    /// one.
    #[inline(always)]
    pub(super) fn finish(self, index: impl Fn(usize) -> usize) -> Extreme {
        let lanes = self.compared.as_slice().iter().zip(self.place.as_slice());
        let best = lanes.fold((f64::NEG_INFINITY, -1.0), |best, (&value, &place)| {
            if best.0 > value || best.0 == value && best.1 < place { best } else { (value, place) }
        });
        // Squares beyond 1e300 are not compared: the largest counts, at the first place.
        match largest(self.value) {
            f64::NEG_INFINITY => Extreme::default(),
            value => Extreme { value, configuration: Some(index(best.1.max(0.0) as usize)) },
        }
    }
}

/// Returns the largest value of all lanes.
#[inline(always)]
pub(super) fn largest<R: Register>(lanes: Lanes<R>) -> f64 {
    lanes.as_slice().iter().fold(f64::NEG_INFINITY, |largest, value| largest.max(*value))
}

/// Returns the smallest value of all lanes.
#[inline(always)]
pub(super) fn least<R: Register>(lanes: Lanes<R>) -> f64 {
    lanes.as_slice().iter().fold(f64::INFINITY, |least, value| least.min(*value))
}

/// Returns the sum of all lanes, in the order of the lanes.
#[inline(always)]
pub(super) fn sum<R: Register>(lanes: Lanes<R>) -> f64 {
    lanes.as_slice().iter().sum()
}

/// Returns `x² + y² + z²`.
#[inline(always)]
pub(super) fn square<R: Register>([x, y, z]: [Lanes<R>; 3]) -> Lanes<R> {
    x.mul_add(x, y.mul_add(y, z * z))
}
