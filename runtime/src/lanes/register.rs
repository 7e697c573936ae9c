//! A number per lane.
//!
//! Operations are plain loops over the lanes of a value that lives in one register: the compiler makes each of them
//! one instruction, which it does not where lanes live in arrays of their own.

use core::array;
use core::ops::{Add, Div, Mul, Neg, Sub};

use bytemuck::{Pod, TransparentWrapper, Zeroable};

use crate::Scalar;
use crate::sin_cos::{self, Real};

impl<R: Register> Real for Lanes<R> {
    #[inline(always)]
    fn bits(a: Self, b: Self, c: Self, f: impl Fn(u64, u64, u64) -> u64) -> Self {
        a.zip3(b, c, |a, b, c| f64::from_bits(f(a.to_bits(), b.to_bits(), c.to_bits())))
    }
}

/// The register that lanes live in.
pub trait Register: Pod + Send + Sync {
    /// How many lanes it has.
    const WIDTH: usize;
    /// Whether `a · b + c` is one instruction.
    const FUSED: bool;
    /// All lanes with the same value.
    fn splat(value: f64) -> Self;
    /// The value of every lane: `f` of its number.
    fn from_fn(f: impl Fn(usize) -> f64) -> Self;
    /// The value of every lane: `f` of the lanes of three registers.
    fn map(a: Self, b: Self, c: Self, f: impl Fn(f64, f64, f64) -> f64) -> Self;
    /// The values of the lanes.
    fn lanes(&self) -> &[f64];
}

macro_rules! register {
    ($register:ty, $width:literal, $fused:literal) => {
        impl Register for $register {
            const WIDTH: usize = $width;
            const FUSED: bool = $fused;

            #[inline(always)]
            fn splat(value: f64) -> Self {
                bytemuck::cast([value; $width])
            }

            #[inline(always)]
            fn from_fn(f: impl Fn(usize) -> f64) -> Self {
                bytemuck::cast::<[f64; $width], Self>(array::from_fn(f))
            }

            #[inline(always)]
            fn map(a: Self, b: Self, c: Self, f: impl Fn(f64, f64, f64) -> f64) -> Self {
                let [a, b, c]: [[f64; $width]; 3] = [a, b, c].map(|register| bytemuck::cast(register));
                let result: [f64; $width] = array::from_fn(|lane| f(a[lane], b[lane], c[lane]));
                bytemuck::cast(result)
            }

            #[inline(always)]
            fn lanes(&self) -> &[f64] {
                bytemuck::cast_ref::<Self, [f64; $width]>(self)
            }
        }
    };
}

register!([f64; 2], 2, false);
#[cfg(target_arch = "x86_64")]
register!(core::arch::x86_64::__m256d, 4, true);
#[cfg(target_arch = "x86_64")]
register!(core::arch::x86_64::__m512d, 8, true);

/// A number per lane: the [`Scalar`] of a batch.
#[derive(Clone, Copy, Debug, Pod, Zeroable, TransparentWrapper)]
#[repr(transparent)]
pub struct Lanes<R: Register>(R);

/// A truth per lane: all bits of the lane, or none.
#[derive(Clone, Copy, Debug)]
pub struct Mask<R: Register>(R);

impl<R: Register> Lanes<R> {
    /// How many lanes there are.
    pub const WIDTH: usize = R::WIDTH;

    /// The value of every lane, by its number.
    #[inline(always)]
    pub fn from_fn(f: impl Fn(usize) -> f64) -> Self {
        Self(R::from_fn(f))
    }

    /// The value of every lane.
    #[inline(always)]
    pub fn to_slice(&self) -> &[f64] {
        self.0.lanes()
    }

    /// `f` of every lane.
    #[inline(always)]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(R::map(self.0, self.0, self.0, |a, _, _| f(a)))
    }

    /// `f` of every lane of two.
    #[inline(always)]
    pub fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(R::map(self.0, other.0, self.0, |a, b, _| f(a, b)))
    }

    /// `f` of every lane of three.
    #[inline(always)]
    fn zip3(self, b: Self, c: Self, f: impl Fn(f64, f64, f64) -> f64) -> Self {
        Self(R::map(self.0, b.0, c.0, f))
    }

    /// The smaller of two values, lane by lane; the other if one is not a number.
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    /// The larger of two values, lane by lane; `other` if one is not a number.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    /// Where it is more than another.
    #[inline(always)]
    pub fn more_than(self, other: Self) -> Mask<R> {
        Mask(self.zip(other, |a, b| f64::from_bits(if a > b { u64::MAX } else { 0 })).0)
    }

    /// `self` where the mask is set, `other` elsewhere.
    #[inline(always)]
    pub fn or(self, other: Self, mask: Mask<R>) -> Self {
        self.zip3(other, Self(mask.0), |a, b, mask| {
            f64::from_bits(a.to_bits() & mask.to_bits() | b.to_bits() & !mask.to_bits())
        })
    }
}

impl<R: Register> Mask<R> {
    /// Whether it is set in any lane.
    #[inline(always)]
    pub fn any(&self) -> bool {
        self.0.lanes().iter().fold(0, |bits, lane| bits | lane.to_bits()) != 0
    }
}

macro_rules! operator {
    ($operator:ident, $function:ident, $sign:tt) => {
        impl<R: Register> $operator for Lanes<R> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                self.zip(other, |a, b| a $sign b)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<R: Register> Neg for Lanes<R> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}

/// `a · b + c`, with one rounding if the register has an instruction for it.
#[inline(always)]
fn mul_add<R: Register>(a: f64, b: f64, c: f64) -> f64 {
    if R::FUSED { a.mul_add(b, c) } else { a * b + c }
}

impl<R: Register> Scalar for Lanes<R> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self(R::splat(value))
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self.zip3(b, c, mul_add::<R>)
    }

    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        self.zip3(b, c, |a, b, c| mul_add::<R>(a, b, -c))
    }

    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        self.zip3(b, c, |a, b, c| mul_add::<R>(-a, b, c))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let far = self.abs().zip(self, |magnitude, _| {
            // What is not a number is far too.
            f64::from_bits(if magnitude <= sin_cos::REACH { 0 } else { u64::MAX })
        });
        if Mask(far.0).any() {
            return (self.map(|a| Scalar::sin_cos(a).0), self.map(|a| Scalar::sin_cos(a).1));
        }
        sin_cos::near(self)
    }

    fn tan(self) -> Self {
        self.map(Scalar::tan)
    }

    fn asin(self) -> Self {
        self.map(Scalar::asin)
    }

    fn acos(self) -> Self {
        self.map(Scalar::acos)
    }

    fn atan(self) -> Self {
        self.map(Scalar::atan)
    }

    fn atan2(self, x: Self) -> Self {
        self.zip(x, Scalar::atan2)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }

    #[inline(always)]
    fn sign(self) -> Self {
        self.map(Scalar::sign)
    }

    fn powf(self, exponent: Self) -> Self {
        self.zip(exponent, Scalar::powf)
    }
}
