//! The number type that generated code is generic over, and its lookup tables.

mod lookup_table;

use core::ops::{Add, Div, Mul, Neg, Sub};

pub use lookup_table::LookupTable;
#[cfg(feature = "lanes")]
pub(crate) use lookup_table::ROUND;

/// Number type of generated code: `f64` and `f32` here, dual numbers or lanes elsewhere.
///
/// Angles are in radians. Generated code calls `sin_cos` where it needs both.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// Returns the value nearest to a constant of the spec.
    fn constant(value: f64) -> Self;
    /// Returns `self · b + c`, rounded once where the type has a fused instruction, otherwise
    /// twice.
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    /// Returns `self · b − c`, rounded as [`mul_add`](Self::mul_add).
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        self * b - c
    }
    /// Returns `c − self · b`, rounded as [`mul_add`](Self::mul_add).
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }
    /// Returns sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Returns sine and cosine of several angles: the same results as one by one, faster for some
    /// types.
    #[inline(always)]
    fn sin_cos_each<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        angles.map(Self::sin_cos)
    }
    /// Returns the sine.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Returns the cosine.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Returns the tangent.
    fn tan(self) -> Self;
    /// Returns the inverse sine, in `[-π/2, π/2]`.
    fn asin(self) -> Self;
    /// Returns the inverse cosine, in `[0, π]`.
    fn acos(self) -> Self;
    /// Returns the inverse tangent, in `(-π/2, π/2)`.
    fn atan(self) -> Self;
    /// Returns the angle of the point `(x, self)`, in `(-π, π]`.
    fn atan2(self, x: Self) -> Self;
    /// Returns the square root.
    fn sqrt(self) -> Self;
    /// Returns the absolute value.
    fn abs(self) -> Self;
    /// Returns the exponential.
    fn exp(self) -> Self;
    /// Returns the natural logarithm.
    fn ln(self) -> Self;
    /// Returns the sign: −1, 0 or 1.
    fn sign(self) -> Self;
    /// Returns −1 below 0, otherwise 1: the derivative of the absolute value, right-sided at 0.
    fn side(self) -> Self;
    /// Returns `true` for a number above 0; for several lanes, if one of them is.
    fn is_positive(self) -> bool;
    /// Returns the smaller of two numbers, or NaN if one is NaN.
    fn min(self, other: Self) -> Self;
    /// Returns the larger of two numbers, or NaN if one is NaN.
    fn max(self, other: Self) -> Self;
    /// Returns a power with any exponent.
    fn powf(self, exponent: Self) -> Self;
    /// Returns the piece of a table at this x: the argument t of its polynomial, and the
    /// coefficients, lowest power first.
    ///
    /// A type with derivatives scales those of t by `dt/dx`, which is [`LookupTable::unit`].
    fn piece(self, table: &LookupTable<'_>) -> (Self, [Self; 4]);
}
