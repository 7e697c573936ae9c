//! Sine and cosine of an `f64` without a branch or a table, so that lanes of them become vector code and the
//! scalar form has the same bits.
//!
//! `x = n π/2 + r` with `|r| ≤ π/4` (Cody and Waite), then `sin r = r + r³ S(r²)` and
//! `cos r = 1 + r² (−1/2 + r² C(r²))` with the minimax polynomials of fdlibm (below 2⁻⁵⁸), then the quadrant `n`.
//! Below 1.7 ulp for `|x| ≤` [`REACH`].

/// How far from zero [`sin_cos`] holds: beyond it `n` has more bits than its products with π/2 leave free.
pub(crate) const REACH: f64 = 1e5;

const FRAC_2_PI: f64 = core::f64::consts::FRAC_2_PI;
/// π/2 down to 2⁻³⁶, 2⁻⁵³, 2⁻⁹⁰ and the rest: with an `n` of 16 bits the first three products are exact, and so are
/// the first two differences. All are positive: thus −0 stays −0.
const EXACT_PARTS: [f64; 4] = [
    1.570_796_326_792_333_3,
    2.563_282_919_254_561_4e-12,
    6.123_233_995_707_727e-17,
    2.903_855_973_979_360_5e-28,
];
/// π/2 in three parts of 53 bits, whose products are exact where they are fused.
const FUSED_PARTS: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_765e-17, 1.082_856_673_921_914e-32];
/// `1.5 · 2⁵²`: adding it rounds to the nearest integer, which then stands in the low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
const SIGN: u64 = 1 << 63;

/// `S`, lowest power first.
const SINE: [f64; 6] = [
    -0.166_666_666_666_666_32,
    0.008_333_333_333_322_49,
    -0.000_198_412_698_298_579_5,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
/// `C`, lowest power first, after `−1/2`.
const COSINE: [f64; 7] = [
    -0.5,
    0.041_666_666_666_666_6,
    -0.001_388_888_888_887_411,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Sine and cosine for `|x| ≤` [`REACH`], for lanes: signed zeros keep their sign; beyond the reach the values mean
/// nothing, and a caller takes [`beyond`] there.
///
/// `FUSED` is for functions compiled with FMA: elsewhere `mul_add` is a call of the C library.
#[inline(always)]
#[allow(dead_code, reason = "the lanes call it")]
pub(crate) fn sin_cos<const FUSED: bool>(x: f64) -> (f64, f64) {
    let (r, n) = reduce::<FUSED>(x);
    let (z, r) = (r * r, turn(r, n));
    let (sine, cosine) = polynomials::<FUSED>(r, z);
    // −0 + 0 is 0.
    swap(sine | (r.to_bits() & SIGN), cosine, n)
}

/// Sine and cosine of any `f64`: the same bits as `sin_cos::<false>` where that holds, so that they do not depend
/// on the machine.
#[inline]
pub(crate) fn scalar(x: f64) -> (f64, f64) {
    // One comparison for zeros, whose sign the polynomials lose, and for what is beyond the reach or not finite.
    if (x.to_bits() << 1).wrapping_sub(1) < REACH.to_bits() << 1 {
        let (r, n) = reduce::<false>(x);
        let (sine, cosine) = polynomials::<false>(turn(r, n), r * r);
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

/// `r = x − n π/2`, rounded once (a second rounding matters below 2⁻²⁰ only, where that of the sine is next to none),
/// and the bits of which the lowest are those of `n`.
#[inline(always)]
fn reduce<const FUSED: bool>(x: f64) -> (f64, u64) {
    let rounded = mul_add::<FUSED>(x, FRAC_2_PI, ROUND);
    let n = rounded - ROUND;
    let parts: &[f64] = if FUSED { &FUSED_PARTS } else { &EXACT_PARTS };
    let r = parts.iter().fold(x, |r, part| mul_add::<FUSED>(-n, *part, r));
    (r, rounded.to_bits())
}

/// `−r` in odd quadrants: there the cosine is `−sin r`, and `cos r` does not mind.
#[inline(always)]
fn turn(r: f64, n: u64) -> f64 {
    f64::from_bits(r.to_bits() ^ (n << 63))
}

/// The bits of `sin r` and `cos r` for `|r| ≤ π/4`, `z = r²`, step by step together: in scalar code they are one
/// SSE2 vector.
#[inline(always)]
fn polynomials<const FUSED: bool>(r: f64, z: f64) -> (u64, u64) {
    let (mut s, mut c) = (SINE[5], mul_add::<FUSED>(z, COSINE[6], COSINE[5]));
    for i in (0..5).rev() {
        s = mul_add::<FUSED>(z, s, SINE[i]);
        c = mul_add::<FUSED>(z, c, COSINE[i]);
    }
    (mul_add::<FUSED>(r * z, s, r).to_bits(), mul_add::<FUSED>(z, c, 1.0).to_bits())
}

/// In odd quadrants sine and cosine change places; in the second and third both change sign ([`turn`] did the rest).
#[inline(always)]
fn swap(sine: u64, cosine: u64, n: u64) -> (f64, f64) {
    let change = ((sine ^ cosine) & 0_u64.wrapping_sub(n & 1)) ^ ((n & 2) << 62);
    (f64::from_bits(sine ^ change), f64::from_bits(cosine ^ change))
}

/// `a b + c`, rounded once where `FUSED`. `core` has no stable `f64::mul_add`: without `std` it is always two steps.
#[inline(always)]
fn mul_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    #[cfg(feature = "std")]
    if FUSED {
        return a.mul_add(b, c);
    }
    a * b + c
}

#[cfg(test)]
mod tests;
