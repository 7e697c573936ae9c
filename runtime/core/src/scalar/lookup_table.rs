//! Functions given by points, as piecewise polynomials. The search is branch-free, so that lanes
//! search together.
//!
//! The range of the points is divided into equal buckets, and `u = (x − first) · scale` is x in
//! buckets. Equidistant points are the ends of the buckets, and the argument of the polynomial is
//! `t = u − ⌊u⌋`. For other points each bucket stores the piece in which it begins; a few
//! comparisons find the piece of x, which begins at `knot`, and `t = x − knot`.

use crate::Scalar;

/// `1.5 · 2⁵²`. Adding it rounds to the nearest integer, which the low bits then hold.
pub(crate) const ROUND: f64 = 6_755_399_441_055_744.0;

/// Function given by points: a constant of generated code.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookupTable<'a> {
    /// First x.
    pub first: f64,
    /// Buckets per unit of x. The last x is just below the end of the last bucket.
    pub scale: f64,
    /// Piece in which each bucket begins, with one entry before the first and one after the last
    /// bucket for extrapolation. Empty for equidistant points.
    pub starts: &'a [u32],
    /// Beginning of each piece. Empty for equidistant points.
    pub knots: &'a [f64],
    /// Coefficients of each piece, lowest power of t first. The first and the last piece
    /// extrapolate.
    pub pieces: &'a [[f64; 4]],
    /// Number of comparisons that reach any piece of a bucket from its beginning.
    pub steps: u32,
}

impl LookupTable<'_> {
    /// Returns `dt/dx`.
    #[inline(always)]
    pub fn unit(&self) -> f64 {
        if self.starts.is_empty() { self.scale } else { 1.0 }
    }

    /// Returns the number of buckets.
    #[inline(always)]
    pub(crate) fn buckets(&self) -> f64 {
        let entries = if self.starts.is_empty() { self.pieces.len() } else { self.starts.len() };
        entries as f64 - 2.0
    }

    /// Returns the bucket in the low bits of `rounded`, see [`ROUND`], plus one: bucket 0 is before
    /// the first.
    #[inline(always)]
    pub(crate) fn bucket_in(rounded: f64) -> usize {
        (rounded.to_bits() as u32).wrapping_add(1) as usize
    }

    /// Returns the bucket of x: its index in `starts`.
    #[inline(always)]
    pub fn bucket(&self, x: f64) -> usize {
        Self::bucket_in(self.rounded((x - self.first) * self.scale))
    }

    /// Returns `⌊u⌋`, clamped to one bucket beyond the ends, plus [`ROUND`].
    #[inline(always)]
    fn rounded(&self, u: f64) -> f64 {
        (u - 0.5).max(-1.0).min(self.buckets()) + ROUND
    }

    /// Returns the piece of x, given its bucket, if the points are not equidistant.
    #[inline(always)]
    pub(crate) fn piece_from(&self, bucket: usize, x: f64) -> usize {
        let mut piece = self.starts.get(bucket).map_or(0, |start| *start as usize);
        for step in (0..self.steps).rev() {
            let next = piece + (1 << step);
            if self.knots.get(next).is_some_and(|knot| x > *knot) {
                piece = next;
            }
        }
        piece
    }

    /// Returns the coefficients of a piece.
    #[inline(always)]
    pub(crate) fn coefficients(&self, piece: usize) -> &[f64; 4] {
        const NONE: &[f64; 4] = &[f64::NAN; 4];
        self.pieces.get(piece).unwrap_or(NONE)
    }

    /// Returns the beginning of a piece.
    #[inline(always)]
    pub(crate) fn knot(&self, piece: usize) -> f64 {
        self.knots.get(piece).copied().unwrap_or(f64::NAN)
    }

    /// Returns `t` and the coefficients at x.
    #[inline(always)]
    pub(crate) fn find(&self, x: f64) -> (f64, [f64; 4]) {
        let u = (x - self.first) * self.scale;
        let rounded = self.rounded(u);
        let bucket = Self::bucket_in(rounded);
        if self.starts.is_empty() {
            return (u - (rounded - ROUND), *self.coefficients(bucket));
        }
        let piece = self.piece_from(bucket, x);
        (x - self.knot(piece), *self.coefficients(piece))
    }

    /// Returns the value at x. NaN beyond the ends of a table that does not extrapolate.
    ///
    /// ```
    /// # use abbe::LookupTable;
    /// // 10 at x = 0, 12 at x = 2, and held beyond.
    /// let table = LookupTable {
    ///     first: 0.0,
    ///     scale: 0.5_f64.next_down(),
    ///     starts: &[],
    ///     knots: &[],
    ///     pieces: &[[10.0, 0.0, 0.0, 0.0], [10.0, 2.0, 0.0, 0.0], [12.0, 0.0, 0.0, 0.0]],
    ///     steps: 0,
    /// };
    /// assert_eq!([-1.0, 0.0, 1.0, 3.0].map(|x| table.value(x)), [10.0, 10.0, 11.0, 12.0]);
    /// ```
    #[inline(always)]
    pub fn value<T: Scalar>(&self, x: T) -> T {
        let (t, [a, b, c, d]) = x.piece(self);
        t.mul_add(t.mul_add(t.mul_add(d, c), b), a)
    }

    /// Returns the first, second or third derivative. Where pieces meet, it is that of one of them.
    #[inline(always)]
    pub fn derivative<T: Scalar>(&self, order: u32, x: T) -> T {
        let (t, [_, b, c, d]) = x.piece(self);
        let times = |factor: f64, value: T| T::constant(factor) * value;
        let mut derivative = match order {
            1 => t.mul_add(t.mul_add(times(3.0, d), times(2.0, c)), b),
            2 => t.mul_add(times(6.0, d), times(2.0, c)),
            _ => times(6.0, d),
        };
        for _ in 0..order {
            derivative = times(self.unit(), derivative);
        }
        derivative
    }
}
