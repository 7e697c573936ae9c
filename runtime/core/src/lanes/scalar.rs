//! The number type of a batch: the functions of [`Scalar`] for lanes.

use super::{Lanes, Mask, Register, arc_tangent};
use crate::{LookupTable, Scalar, register::WIDEST, scalar::ROUND, sin_cos};

impl<R: Register> Scalar for Lanes<R> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self(R::splat(value))
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(R::mul_add(self.0, b.0, c.0))
    }

    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        Self(R::mul_sub(self.0, b.0, c.0))
    }

    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        Self(R::neg_mul_add(self.0, b.0, c.0))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let [pair] = Self::sin_cos_each([self]);
        pair
    }

    #[inline(always)]
    fn sin_cos_each<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        // Loops instead of closures, which could be compiled without the instruction set.
        let (mut far, reach) = (Self::constant(0.0), Self::constant(sin_cos::REACH));
        for angle in &angles {
            // Nonzero bits mark lanes beyond the reach. A NaN lane yields NaN either way.
            let size = angle.abs();
            far = Self(R::or(far.0, R::xor(reach.min(size).0, size.0)));
        }
        if Mask(far.0).any() {
            return angles.map(Self::far);
        }
        let mut pairs = [(far, far); N];
        for i in 0..N {
            pairs[i] = sin_cos::near(angles[i]);
        }
        pairs
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

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn atan2(self, x: Self) -> Self {
        let size = Lanes::max(self.abs(), x.abs());
        // Nonzero bits mark lanes beyond the reach. A NaN lane yields NaN either way.
        let [least, most] = arc_tangent::REACH.map(R::splat);
        let far = R::or(R::xor(R::max(least, size.0), size.0), R::xor(R::min(most, size.0), size.0));
        if Mask(far).any() { self.far_atan2(x) } else { arc_tangent::near(self, x) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(R::sqrt(self.0))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(R::and_not(self.0, R::splat(-0.0)))
    }

    #[inline(always)]
    fn sign(self) -> Self {
        self.map(Scalar::sign)
    }

    fn exp(self) -> Self {
        self.map(Scalar::exp)
    }

    fn ln(self) -> Self {
        self.map(Scalar::ln)
    }

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn side(self) -> Self {
        let (zero, one) = (Self::constant(0.0), Self::constant(1.0));
        let side = zero.more_than(self).select(-one, one);
        // NaN stays NaN.
        let within = Lanes::max(-one, Lanes::min(one, self));
        side + within * zero
    }

    fn is_positive(self) -> bool {
        self.0.lanes().iter().any(|lane| *lane > 0.0)
    }

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn min(self, other: Self) -> Self {
        self.is_number().select(Lanes::min(self, other), self)
    }

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn max(self, other: Self) -> Self {
        self.is_number().select(Lanes::max(self, other), self)
    }

    fn powf(self, exponent: Self) -> Self {
        self.zip(exponent, Scalar::powf)
    }

    /// Vectorizes `LookupTable::find`: the steps that all lanes share run in all lanes together.
    #[inline(always)]
    fn piece(self, table: &LookupTable<'_>) -> (Self, [Self; 4]) {
        let number = <Self as Scalar>::constant;
        let u = (self - number(table.first)) * number(table.scale);
        let bucket = Lanes::min(Lanes::max(u - number(0.5), number(-1.0)), number(table.buckets()));
        let rounded = bucket + number(ROUND);
        let buckets = rounded.as_slice();
        if table.starts.is_empty() {
            let coefficients = R::columns(|lane| table.coefficients(LookupTable::bucket_in(buckets[lane])));
            return (u - (rounded - number(ROUND)), coefficients.map(Self));
        }
        let x = self.as_slice();
        let mut pieces = [0; WIDEST];
        for ((piece, bucket), x) in pieces.iter_mut().zip(buckets).zip(x) {
            *piece = table.piece_from(LookupTable::bucket_in(*bucket), *x);
        }
        let knots = Self::from_fn(|lane| table.knot(pieces[lane]));
        (self - knots, R::columns(|lane| table.coefficients(pieces[lane])).map(Self))
    }
}
