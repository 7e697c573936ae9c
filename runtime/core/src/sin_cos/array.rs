//! Two numbers in an array, for machines without a register type here: the compiler finds their
//! instructions for pairs.

use core::ops::{Add, Mul, Sub};

use super::{Pair, Real};

/// Two numbers.
#[derive(Clone, Copy)]
pub(crate) struct Array([f64; 2]);

impl Array {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self([f(self.0[0], other.0[0]), f(self.0[1], other.0[1])])
    }
}

macro_rules! operator {
    ($trait:ident::$name:ident $sign:tt) => {
        impl $trait for Array {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                self.zip(other, |a, b| a $sign b)
            }
        }
    };
}

operator!(Add::add+);
operator!(Sub::sub -);
operator!(Mul::mul *);

impl Pair for Array {
    #[inline(always)]
    fn new(numbers: [f64; 2]) -> Self {
        Self(numbers)
    }

    #[inline(always)]
    fn numbers(self) -> [f64; 2] {
        self.0
    }
}

impl Real for Array {
    const FUSED: bool = false;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; 2])
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
