//! The numbers that generated code computes with.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::LookupTable;

/// A number type for generated code: `f64` and `f32` here, dual numbers or lanes where you need them.
///
/// Angles are radians. `sin_cos` is what generated code calls wherever both are needed.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The nearest value to a constant of the spec.
    fn constant(value: f64) -> Self;
    /// `self · b + c`, rounded once where the type has an instruction for it, twice otherwise.
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    /// `self · b − c`, rounded as [`mul_add`](Self::mul_add).
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        self * b - c
    }
    /// `c − self · b`, rounded as [`mul_add`](Self::mul_add).
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Sine and cosine of several angles: for some types quicker than one by one, and the same.
    #[inline(always)]
    fn sin_cos_each<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        angles.map(Self::sin_cos)
    }
    /// Sine.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Tangent.
    fn tan(self) -> Self;
    /// Inverse sine, in `[-π/2, π/2]`.
    fn asin(self) -> Self;
    /// Inverse cosine, in `[0, π]`.
    fn acos(self) -> Self;
    /// Inverse tangent, in `(-π/2, π/2)`.
    fn atan(self) -> Self;
    /// The angle of the point `(x, self)`, in `(-π, π]`.
    fn atan2(self, x: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// Exponential function.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// −1, 0 or 1.
    fn sign(self) -> Self;
    /// −1 below 0, else 1: the derivative of the absolute value, at 0 that to the right.
    fn side(self) -> Self;
    /// The smaller of two numbers; not a number if one of them is not.
    fn min(self, other: Self) -> Self;
    /// The larger of two numbers; not a number if one of them is not.
    fn max(self, other: Self) -> Self;
    /// A power with any exponent.
    fn powf(self, exponent: Self) -> Self;
    /// Of the polynomial that a table is at this x: its argument t, and its coefficients, the lowest power first.
    ///
    /// A type with derivatives gives t its own: `dt/dx` is [`LookupTable::unit`].
    fn piece(self, table: &LookupTable<'_>) -> (Self, [Self; 4]);
}
