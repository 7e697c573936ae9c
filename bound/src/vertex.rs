//! Numbers at corners: some of them side by side, or how large all of them are and how far rounding has put them off.

use crate::affine::{Affine, UNIT, above};
use crate::convex::Operation;

/// How many corners stand side by side: those of the vertices of two names.
pub(crate) const LANES: usize = 16;

/// What operations compute with.
pub(crate) trait Number: Copy {
    fn known(number: &Affine<0>) -> Self;
    fn neg(self) -> Self;
    fn add(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    /// The root of a sum of squares: of what is less than 0 by rounding, 0.
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    fn larger(self, other: Self) -> Self;
}

/// The result of an operation; `names` are sine and cosine of each name, or the name.
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

/// Numbers at several corners, rounded.
pub(crate) type Lanes = [f64; LANES];

impl Number for Lanes {
    #[inline(always)]
    fn known(number: &Affine<0>) -> Self {
        [number.centre; LANES]
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

/// What numbers do not exceed: neither those that are computed nor the exact ones, nor how far they are apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Size {
    pub(crate) most: f64,
    pub(crate) off: f64,
}

impl Size {
    /// No less than either.
    pub(crate) fn of_both(self, other: Self) -> Self {
        Self { most: self.most.max(other.most), off: self.off.max(other.off) }
    }
}

/// Each result is rounded by no more than `UNIT` of its size, or underflows: `above` has room for both.
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
        self.of_both(other)
    }
}
