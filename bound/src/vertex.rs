//! Arithmetic at corners: either several corners in lanes, or a bound of their magnitudes and
//! rounding errors.

use crate::affine::{Affine, UNIT, above};
use crate::convex::Operation;

/// Arithmetic of the operations.
pub(crate) trait Number: Copy {
    fn known(number: &Affine<0>) -> Self;
    fn neg(self) -> Self;
    fn add(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    /// Returns the root of a sum of squares; a sum that is negative by rounding counts as 0.
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    fn larger(self, other: Self) -> Self;
}

/// Returns the result of an operation; `names` holds sine and cosine of each name, or its value.
#[inline(always)]
pub(crate) fn result<T: Number>(operation: &Operation, before: &[T], names: &[[T; 2]]) -> T {
    match *operation {
        Operation::Name(name, part) => names[name][part],
        Operation::Known(number) => T::known(&number),
        Operation::Neg(a) => before[a].neg(),
        Operation::Add(a, b) => before[a].add(before[b]),
        Operation::Mul(a, b) => before[a].mul(before[b]),
        Operation::Sqrt(a) => before[a].sqrt(),
        Operation::Abs(a) => before[a].abs(),
        Operation::Larger(a, b) => before[a].larger(before[b]),
    }
}

/// Rounded numbers at several points.
pub(crate) type Lanes<const N: usize> = [f64; N];

impl<const N: usize> Number for Lanes<N> {
    #[inline(always)]
    fn known(number: &Affine<0>) -> Self {
        [number.centre; N]
    }

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|value| -value)
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] + other[i])
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i] * other[i])
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(|value| value.max(0.0).sqrt())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        std::array::from_fn(|i| self[i].max(other[i]))
    }
}

/// Bounds of the magnitudes of computed and exact numbers (`most`), and of their difference
/// (`off`).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Size {
    pub(crate) most: f64,
    pub(crate) off: f64,
}

impl Size {
    pub(crate) const NOTHING: Self = Self { most: 0.0, off: 0.0 };

    /// Returns bounds that hold for both.
    pub(crate) fn hull(self, other: Self) -> Self {
        Self { most: self.most.max(other.most), off: self.off.max(other.off) }
    }
}

/// The rounding error of each result is at most `UNIT` times its magnitude, or an underflow;
/// `above` covers both.
impl Number for Size {
    fn known(number: &Affine<0>) -> Self {
        Self { most: above(number.centre.abs() + number.radius()), off: number.radius() }
    }

    fn neg(self) -> Self {
        self
    }

    fn add(self, other: Self) -> Self {
        let most = above(self.most + other.most);
        Self { most, off: above(self.off + other.off + UNIT * most) }
    }

    fn mul(self, other: Self) -> Self {
        let most = above(self.most * other.most);
        Self { most, off: above(self.most * other.off + other.most * self.off + UNIT * most) }
    }

    /// `|√a − √b| ≤ √|a − b|`.
    fn sqrt(self) -> Self {
        let most = above(self.most.sqrt());
        Self { most, off: above(self.off.sqrt() + UNIT * most) }
    }

    fn abs(self) -> Self {
        self
    }

    fn larger(self, other: Self) -> Self {
        self.hull(other)
    }
}
