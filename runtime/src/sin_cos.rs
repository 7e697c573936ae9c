//! Sine and cosine without a branch or a table: the same for a number and for lanes of them.
//!
//! `x = n π/2 + r` with `|r| ≤ π/4` (Cody and Waite), then `sin r = r + r³ S(r²)` and
//! `cos r = 1 + r² (−1/2 + r² C(r²))` with the minimax polynomials of fdlibm (below 2⁻⁵⁸), then the quadrant `n`.
//! At most 1.5 ulp for `|x| ≤` [`REACH`].

use crate::Scalar;

/// How far from zero [`near`] holds: beyond it `n` has more bits than its products with π/2 leave free.
pub(crate) const REACH: f64 = 1e5;

const FRAC_2_PI: f64 = core::f64::consts::FRAC_2_PI;
/// π/2 in three parts. The first two have 37 bits and `n` has 17 with its sign: their products are exact.
const PARTS: [f64; 3] = [1.570_796_326_792_333_3, 2.563_344_151_583_955_8e-12, 1.056_299_906_698_742_8e-23];
/// `1.5 · 2⁵²`: adding it rounds to the nearest integer, which then stands in the low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// `S`, lowest power first.
const SINE: [f64; 6] = [
    -1.666_666_666_666_663_243_48e-1,
    8.333_333_333_322_489_461_24e-3,
    -1.984_126_982_985_794_931_34e-4,
    2.755_731_370_707_006_767_89e-6,
    -2.505_076_025_340_686_341_95e-8,
    1.589_690_995_211_550_102_21e-10,
];
/// `C`, lowest power first, after `−1/2`.
const COSINE: [f64; 7] = [
    -0.5,
    4.166_666_666_666_660_190_37e-2,
    -1.388_888_888_887_410_957_49e-3,
    2.480_158_728_947_672_941_78e-5,
    -2.755_731_435_139_066_330_35e-7,
    2.087_572_321_298_174_827_90e-9,
    -1.135_964_755_778_819_482_65e-11,
];

/// What can be computed with as numbers and as bits.
pub(crate) trait Real: Scalar {
    /// Exclusive or of the bits.
    fn xor(self, other: Self) -> Self;
    /// And of the bits.
    fn and(self, other: Self) -> Self;
    /// All bits where the lowest bit is set, none elsewhere.
    fn odd(self) -> Self;
    /// The bits moved up by so many places.
    fn shifted<const PLACES: u32>(self) -> Self;
}

impl Real for f64 {
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

/// Sine and cosine for `|x| ≤` [`REACH`]: signed zeros keep their sign; beyond the reach the values mean nothing,
/// and a caller takes [`beyond`] there.
#[inline(always)]
pub(crate) fn near<T: Real>(x: T) -> (T, T) {
    let (r, n) = reduce(x);
    let (z, r) = (r * r, turn(r, n));
    let (sine, cosine) = polynomials(r, z);
    // −0 + 0 is 0.
    let (sign, zero) = (T::constant(-0.0), sine.and(r).and(T::constant(-0.0)));
    let sine = sine.xor(r.and(sign)).xor(zero);
    swap(sine, cosine, n)
}

/// Sine and cosine of any `f64`: the same bits as [`near`] where that holds, so that they do not depend on the
/// machine.
#[inline]
pub(crate) fn scalar(x: f64) -> (f64, f64) {
    // One comparison for zeros, whose sign the polynomials lose, and for what is beyond the reach or not finite.
    if (x.to_bits() << 1).wrapping_sub(1) < REACH.to_bits() << 1 {
        let (r, n) = reduce(x);
        let (sine, cosine) = polynomials(turn(r, n), r * r);
        swap(sine, cosine, n)
    } else {
        beyond(x)
    }
}

/// Sine and cosine of any `f64` by the library: the platform's, or `libm` without `std`.
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

/// `r = x − n π/2`, and what has `n` in its lowest bits.
#[inline(always)]
fn reduce<T: Real>(x: T) -> (T, T) {
    let round = T::constant(ROUND);
    let rounded = x.mul_add(T::constant(FRAC_2_PI), round);
    let n = rounded - round;
    let r = PARTS.iter().fold(x, |r, part| n.neg_mul_add(T::constant(*part), r));
    (r, rounded)
}

/// `−r` in odd quadrants: there the cosine is `−sin r`, and `cos r` does not mind.
#[inline(always)]
fn turn<T: Real>(r: T, n: T) -> T {
    r.xor(n.shifted::<63>())
}

/// `sin r` and `cos r` for `|r| ≤ π/4`, `z = r²`, step by step together: in scalar code they are one SSE2 vector.
#[inline(always)]
fn polynomials<T: Real>(r: T, z: T) -> (T, T) {
    let mut s = T::constant(SINE[5]);
    let mut c = z.mul_add(T::constant(COSINE[6]), T::constant(COSINE[5]));
    for i in (0..5).rev() {
        s = z.mul_add(s, T::constant(SINE[i]));
        c = z.mul_add(c, T::constant(COSINE[i]));
    }
    ((r * z).mul_add(s, r), z.mul_add(c, T::constant(1.0)))
}

/// In odd quadrants sine and cosine change places; in the second and third both change sign ([`turn`] did the rest).
#[inline(always)]
fn swap<T: Real>(sine: T, cosine: T, n: T) -> (T, T) {
    let sign = n.shifted::<62>().and(T::constant(-0.0));
    let change = sine.xor(cosine).and(n.odd()).xor(sign);
    (sine.xor(change), cosine.xor(change))
}
