//! Two numbers in an array: the compiler finds the instructions of the machine for pairs.

use core::ops::{Add, Mul, Sub};

use super::{REACH, Real, near, scalar};

/// Two numbers.
#[derive(Clone, Copy)]
struct Array([f64; 2]);

/// Returns sine and cosine of several `f64`, with the bits of [`scalar`]. Pairs of angles share
/// instructions.
#[inline(always)]
pub(crate) fn each<const N: usize>(angles: [f64; N]) -> [(f64, f64); N] {
    let mut all = true;
    for x in &angles {
        all &= x.abs() <= REACH;
    }
    if !all {
        return angles.map(scalar);
    }
    let mut results = [(0.0, 0.0); N];
    for i in (0..N).step_by(2) {
        // Two at a time; the last angle twice if the count is odd.
        let j = (i + 1).min(N - 1);
        let (Array(sines), Array(cosines)) = near(Array([angles[i], angles[j]]));
        results[j] = (sines[1], cosines[1]);
        results[i] = (sines[0], cosines[0]);
    }
    results
}

impl Array {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self([f(self.0[0], other.0[0]), f(self.0[1], other.0[1])])
    }
}

impl Add for Array {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for Array {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Array {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Real for Array {
    const FUSED: bool = false;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; 2])
    }

    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    #[inline(always)]
    fn times_from(self, b: Self, c: Self) -> Self {
        c - self * b
    }

    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        self.zip(other, Real::xor)
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self.zip(other, Real::and)
    }

    #[inline(always)]
    fn odd(self) -> Self {
        Self(self.0.map(Real::odd))
    }

    #[inline(always)]
    fn shifted<const PLACES: u32>(self) -> Self {
        Self(self.0.map(Real::shifted::<PLACES>))
    }
}
