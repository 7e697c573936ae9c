//! Sine and cosine without branches or tables: the same code for a number and for lanes.
//!
//! Argument reduction `x = n π/2 + r` with `|r| ≤ π/4` (Cody and Waite), then
//! `sin r = r + r³ S(r²)` and `cos r = 1 + r² (−1/2 + r² C(r²))` with the minimax polynomials of
//! fdlibm (error below 2⁻⁵⁸), then the quadrant `n`. The error is below 1.7 ulp for `|x| ≤`
//! `REACH`.

use core::ops::{Add, Mul, Sub};

use crate::register::{Lanes, Register};

/// Largest `|x|` for which [`near`] holds: beyond it the products of `n` with the parts of π/2 are
/// not exact.
pub(crate) const REACH: f64 = 1e5;

/// 2/π.
pub const FRAC_2_PI: f64 = core::f64::consts::FRAC_2_PI;
/// π/2 to 2⁻³⁶, 2⁻⁵³, 2⁻⁹⁰, and the rest. For an `n` of 16 bits the first three products and the
/// first two differences are exact. All parts are positive, so that −0 stays −0.
pub const EXACT_PARTS: [f64; 4] = [
    1.570_796_326_792_333_3,
    2.563_282_919_254_561_4e-12,
    6.123_233_995_707_727e-17,
    2.903_855_973_979_360_5e-28,
];
/// π/2 in three parts of 53 bits, whose products are exact with fused multiply-add.
const FUSED_PARTS: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_765e-17, 1.082_856_673_921_914e-32];
/// `1.5 · 2⁵²`. Adding it rounds to the nearest integer, which the low bits then hold.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// Coefficients of `S`, lowest power first.
pub const SINE: [f64; 6] = [
    -0.166_666_666_666_666_32,
    0.008_333_333_333_322_49,
    -0.000_198_412_698_298_579_5,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
/// Coefficients of `C`, lowest power first, after `−1/2`.
pub const COSINE: [f64; 7] = [
    -0.5,
    0.041_666_666_666_666_6,
    -0.001_388_888_888_887_411,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Number type with access to its bits.
pub(crate) trait Real: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// `true` if `a · b + c` is rounded once.
    const FUSED: bool;
    /// Returns a constant.
    fn splat(value: f64) -> Self;
    /// Returns `self · b + c`.
    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    /// Returns `c − self · b`.
    #[inline(always)]
    fn times_from(self, b: Self, c: Self) -> Self {
        c - self * b
    }
    /// Returns the bitwise exclusive or.
    fn xor(self, other: Self) -> Self;
    /// Returns the bitwise and.
    fn and(self, other: Self) -> Self;
    /// Returns all bits set if the lowest bit is set, otherwise none.
    fn odd(self) -> Self;
    /// Returns the bits shifted left.
    fn shifted<const PLACES: u32>(self) -> Self;
}

impl<R: Register> Real for Lanes<R> {
    const FUSED: bool = R::FUSED;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(R::splat(value))
    }

    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        Self(R::mul_add(self.0, b.0, c.0))
    }

    #[inline(always)]
    fn times_from(self, b: Self, c: Self) -> Self {
        Self(R::neg_mul_add(self.0, b.0, c.0))
    }

    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        Self(R::xor(self.0, other.0))
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(R::and(self.0, other.0))
    }

    #[inline(always)]
    fn odd(self) -> Self {
        Self(R::odd(self.0))
    }

    #[inline(always)]
    fn shifted<const PLACES: u32>(self) -> Self {
        Self(R::shifted::<PLACES>(self.0))
    }
}

impl Real for f64 {
    const FUSED: bool = false;

    #[inline(always)]
    fn splat(value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn xor(self, other: f64) -> f64 {
        f64::from_bits(self.to_bits() ^ other.to_bits())
    }

    #[inline(always)]
    fn and(self, other: f64) -> f64 {
        f64::from_bits(self.to_bits() & other.to_bits())
    }

    #[inline(always)]
    fn odd(self) -> f64 {
        f64::from_bits(0_u64.wrapping_sub(self.to_bits() & 1))
    }

    #[inline(always)]
    fn shifted<const PLACES: u32>(self) -> f64 {
        f64::from_bits(self.to_bits() << PLACES)
    }
}

/// Returns sine and cosine for `|x| ≤` [`REACH`], with the sign of signed zeros. Callers use
/// [`beyond`] for larger angles, where the result is meaningless.
#[inline(always)]
pub(crate) fn near<T: Real>(x: T) -> (T, T) {
    let (r, n) = reduce(x);
    let (z, r) = (r * r, turn(r, n));
    let (sine, cosine) = polynomials(r, z);
    // −0 + 0 is 0.
    let (sign, zero) = (T::splat(-0.0), sine.and(r).and(T::splat(-0.0)));
    swap(sine.xor(r.and(sign)).xor(zero), cosine, n)
}

/// Returns sine and cosine of any `f64`, with the same bits as [`near`] within its range, so that
/// results do not depend on the machine.
#[inline]
pub(crate) fn scalar(x: f64) -> (f64, f64) {
    // One comparison detects zeros, whose sign the polynomials lose, large angles, and non-finite
    // ones.
    if (x.to_bits() << 1).wrapping_sub(1) < REACH.to_bits() << 1 {
        let (r, n) = reduce(x);
        let (sine, cosine) = polynomials(turn(r, n), r * r);
        swap(sine, cosine, n)
    } else {
        beyond(x)
    }
}

/// Returns sine and cosine of several `f64`, with the bits of [`scalar`]. Pairs of angles share
/// instructions.
#[inline(always)]
pub(crate) fn each<R: Register, const N: usize>(angles: [f64; N]) -> [(f64, f64); N] {
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
        let pair: Lanes<R> = bytemuck::cast([angles[i], angles[j]]);
        let (sines, cosines) = near(pair);
        let [sines, cosines]: [[f64; 2]; 2] = [bytemuck::cast(sines), bytemuck::cast(cosines)];
        results[j] = (sines[1], cosines[1]);
        results[i] = (sines[0], cosines[0]);
    }
    results
}

/// Returns sine and cosine of any `f64` from the platform's library, or from `libm` without `std`.
#[cold]
#[inline(never)]
pub(crate) fn beyond(x: f64) -> (f64, f64) {
    #[cfg(feature = "std")]
    {
        x.sin_cos()
    }
    #[cfg(not(feature = "std"))]
    {
        libm::sincos(x)
    }
}

/// Returns `r = x − n π/2`, rounded once, and a number with `n` in its lowest bits. (A second
/// rounding would matter only below 2⁻²⁰, where the sine adds almost none.)
#[inline(always)]
fn reduce<T: Real>(x: T) -> (T, T) {
    let round = T::splat(ROUND);
    let rounded = x.times_plus(T::splat(FRAC_2_PI), round);
    let n = rounded - round;
    let parts: &[f64] = if T::FUSED { &FUSED_PARTS } else { &EXACT_PARTS };
    let mut r = x;
    for part in parts {
        r = n.times_from(T::splat(*part), r);
    }
    (r, rounded)
}

/// Returns `−r` in odd quadrants: there the cosine is `−sin r`, and `cos r` is even.
#[inline(always)]
fn turn<T: Real>(r: T, n: T) -> T {
    r.xor(n.shifted::<63>())
}

/// Returns `sin r` and `cos r` for `|r| ≤ π/4`, `z = r²`. The two polynomials are interleaved, so
/// that scalar code uses SSE2 vectors.
#[inline(always)]
fn polynomials<T: Real>(r: T, z: T) -> (T, T) {
    let mut s = T::splat(SINE[5]);
    let mut c = z.times_plus(T::splat(COSINE[6]), T::splat(COSINE[5]));
    for i in (0..5).rev() {
        s = z.times_plus(s, T::splat(SINE[i]));
        c = z.times_plus(c, T::splat(COSINE[i]));
    }
    ((r * z).times_plus(s, r), z.times_plus(c, T::splat(1.0)))
}

/// Swaps sine and cosine in odd quadrants, and negates both in the second and third ([`turn`] has
/// negated the rest).
#[inline(always)]
fn swap<T: Real>(sine: T, cosine: T, n: T) -> (T, T) {
    let change = sine.xor(cosine).and(n.odd()).xor(n.shifted::<62>().and(T::splat(-0.0)));
    (sine.xor(change), cosine.xor(change))
}

#[cfg(test)]
mod tests;
