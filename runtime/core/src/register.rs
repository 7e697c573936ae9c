//! [`Lanes`]: one number per lane, over any [`Register`].
//!
//! Rare functions run lane by lane; the others are one instruction for all lanes.

#[cfg(any(test, not(target_arch = "x86_64")))]
mod portable;

use core::ops::{Add, Div, Mul, Neg, Sub};

use bytemuck::{Pod, Zeroable};

use crate::Scalar;

/// Largest number of lanes of a register.
pub(crate) const WIDEST: usize = 8;

/// SIMD register and its operations, one type per [`InstructionSet`](crate::lanes::InstructionSet).
///
/// Each method applies the operation of its name to every lane. `mul_add`, `mul_sub` and
/// `neg_mul_add` round once where the instruction set has fused operations.
pub trait Register: Pod + Send + Sync {
    /// Number of lanes.
    const WIDTH: usize;
    /// `true` if `a · b + c` is rounded once.
    const FUSED: bool;
    /// Returns all lanes with the same value.
    fn splat(value: f64) -> Self;
    /// Returns the lanes `f(0), f(1), …`.
    fn from_fn(f: impl Fn(usize) -> f64) -> Self;
    /// Returns `f` applied lane by lane to three registers.
    fn map(a: Self, b: Self, c: Self, f: impl Fn(f64, f64, f64) -> f64) -> Self;
    /// Returns the values of the lanes.
    fn lanes(&self) -> &[f64];
    /// Transposes rows of four numbers, one row per lane, into four registers.
    #[inline(always)]
    fn columns<'r>(row: impl Fn(usize) -> &'r [f64; 4]) -> [Self; 4] {
        let mut rows = [&[0.0; 4]; WIDEST];
        for (lane, place) in rows[..Self::WIDTH].iter_mut().enumerate() {
            *place = row(lane);
        }
        [0, 1, 2, 3].map(|column| Self::from_fn(|lane| rows[lane][column]))
    }
    /// Returns `a + b`.
    fn add(a: Self, b: Self) -> Self;
    /// Returns `a − b`.
    fn sub(a: Self, b: Self) -> Self;
    /// Returns `a · b`.
    fn mul(a: Self, b: Self) -> Self;
    /// Returns `a / b`.
    fn div(a: Self, b: Self) -> Self;
    /// Returns `a · b + c`.
    fn mul_add(a: Self, b: Self, c: Self) -> Self;
    /// Returns `a · b − c`.
    fn mul_sub(a: Self, b: Self, c: Self) -> Self;
    /// Returns `c − a · b`.
    fn neg_mul_add(a: Self, b: Self, c: Self) -> Self;
    /// Returns `√a`.
    fn sqrt(a: Self) -> Self;
    /// Returns `a` if it is less than `b`, otherwise `b`.
    fn min(a: Self, b: Self) -> Self;
    /// Returns `a` if it is greater than `b`, otherwise `b`.
    fn max(a: Self, b: Self) -> Self;
    /// Returns the bitwise exclusive or.
    fn xor(a: Self, b: Self) -> Self;
    /// Returns the bitwise and.
    fn and(a: Self, b: Self) -> Self;
    /// Returns the bitwise or.
    fn or(a: Self, b: Self) -> Self;
    /// Returns the bits of `a` that are not set in `b`.
    fn and_not(a: Self, b: Self) -> Self;
    /// Returns all bits set where `a` is greater than `b`, otherwise none.
    fn more_than(a: Self, b: Self) -> Self;
    /// Returns all bits set where the lowest bit is set, otherwise none.
    fn odd(a: Self) -> Self;
    /// Returns the bits shifted left.
    fn shifted<const PLACES: u32>(a: Self) -> Self;
}

/// Implements the operations that every register performs through an array.
macro_rules! by_array {
    ($width:literal, fused: $fused:literal) => {
        const WIDTH: usize = $width;
        const FUSED: bool = $fused;

        #[inline(always)]
        fn splat(value: f64) -> Self {
            bytemuck::cast([value; $width])
        }

        #[inline(always)]
        fn from_fn(f: impl Fn(usize) -> f64) -> Self {
            bytemuck::cast::<[f64; $width], Self>(core::array::from_fn(f))
        }

        #[inline(always)]
        fn map(a: Self, b: Self, c: Self, f: impl Fn(f64, f64, f64) -> f64) -> Self {
            let [a, b, c]: [[f64; $width]; 3] = [a, b, c].map(|register| bytemuck::cast(register));
            let result: [f64; $width] = core::array::from_fn(|lane| f(a[lane], b[lane], c[lane]));
            bytemuck::cast(result)
        }

        #[inline(always)]
        fn lanes(&self) -> &[f64] {
            bytemuck::cast_ref::<Self, [f64; $width]>(self)
        }
    };
}
pub(crate) use by_array;

/// One number per lane: the [`Scalar`] of a batch.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(transparent)]
pub struct Lanes<R>(pub(crate) R)
where
    R: Register;

/// One truth value per lane: all bits of the lane, or none.
#[derive(Clone, Copy, Debug)]
pub struct Mask<R: Register>(pub(crate) R);

impl<R: Register> Lanes<R> {
    /// Number of lanes.
    pub const WIDTH: usize = R::WIDTH;

    /// Returns the lanes `f(0), f(1), …`.
    #[inline(always)]
    pub fn from_fn(f: impl Fn(usize) -> f64) -> Self {
        Self(R::from_fn(f))
    }

    /// Returns the values of the lanes.
    #[inline(always)]
    pub fn as_slice(&self) -> &[f64] {
        self.0.lanes()
    }

    /// Applies `f` to every lane.
    #[inline(always)]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(R::map(self.0, self.0, self.0, |a, _, _| f(a)))
    }

    /// Applies `f` to every pair of lanes.
    #[inline(always)]
    pub fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(R::map(self.0, other.0, self.0, |a, b, _| f(a, b)))
    }

    /// Returns sine and cosine, lane by lane.
    #[cold]
    #[inline(never)]
    pub(crate) fn far(self) -> (Self, Self) {
        (self.map(|a| Scalar::sin_cos(a).0), self.map(|a| Scalar::sin_cos(a).1))
    }

    /// Returns the angle of the point (x, self), lane by lane.
    #[cold]
    #[inline(never)]
    pub(crate) fn far_atan2(self, x: Self) -> Self {
        self.zip(x, Scalar::atan2)
    }

    /// Returns the value which is not negative, with the sign of another one.
    #[inline(always)]
    pub fn with_sign_of(self, other: Self) -> Self {
        Self(R::or(self.0, R::and(other.0, R::splat(-0.0))))
    }

    /// Returns the lanes that are not NaN.
    #[inline(always)]
    pub(crate) fn is_number(self) -> Mask<R> {
        let [least, zero] = [f64::NEG_INFINITY, 0.0].map(R::splat);
        Mask(R::or(R::more_than(self.0, least), R::more_than(zero, self.0)))
    }

    /// Returns the smaller of two values, lane by lane. Returns `other` if either is NaN.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self(R::min(self.0, other.0))
    }

    /// Returns the larger of two values, lane by lane. Returns `other` if either is NaN.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self(R::max(self.0, other.0))
    }

    /// Returns the lanes that are greater than those of `other`.
    #[inline(always)]
    pub fn more_than(self, other: Self) -> Mask<R> {
        Mask(R::more_than(self.0, other.0))
    }
}

impl<R: Register> Mask<R> {
    /// Selects `yes` in the lanes that are set, `no` in the others.
    #[inline(always)]
    pub fn select(self, yes: Lanes<R>, no: Lanes<R>) -> Lanes<R> {
        Lanes(R::xor(no.0, R::and(R::xor(yes.0, no.0), self.0)))
    }

    /// Returns whether any lane is set.
    #[inline(always)]
    pub fn any(&self) -> bool {
        self.0.lanes().iter().fold(0, |bits, lane| bits | lane.to_bits()) != 0
    }
}

macro_rules! operator {
    ($operator:ident, $function:ident) => {
        impl<R: Register> $operator for Lanes<R> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(R::$function(self.0, other.0))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<R: Register> Neg for Lanes<R> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(R::xor(self.0, R::splat(-0.0)))
    }
}
