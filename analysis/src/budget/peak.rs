//! Maximum per lane, with its place.

use abbe_core::Scalar;
use abbe_core::lanes::{Lanes, Register};

/// Largest value in every lane, and the place of the first configuration with it.
#[derive(Clone, Copy)]
pub(super) struct Peak<R: Register> {
    value: Lanes<R>,
    place: Lanes<R>,
}

impl<R: Register> Peak<R> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        Self { value: Lanes::constant(f64::NEG_INFINITY), place: Lanes::constant(-1.0) }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, value: Lanes<R>, place: Lanes<R>) {
        let more = value.more_than(self.value);
        self.value = more.select(value, self.value);
        self.place = more.select(place, self.place);
    }

    /// Returns the largest value of all lanes and its place, the first of several. Returns `None`
    /// if nothing was added.
    #[inline(always)]
    pub(super) fn finish(self) -> Option<(f64, usize)> {
        let lanes = self.value.as_slice().iter().zip(self.place.as_slice());
        let best = lanes.fold(None, |best: Option<(f64, f64)>, (&value, &place)| match best {
            Some(best) if best.0 > value || best.0 == value && best.1 < place => Some(best),
            _ => Some((value, place)),
        });
        best.filter(|best| best.1 >= 0.0).map(|(value, place)| (value, place as usize))
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
