//! Functions that are given by points, as polynomials between them: found without a branch, so that lanes find theirs at
//! once.
//!
//! The range of the points is cut into equal buckets: `u = (x − first) · scale` is where x is, in buckets. Points at equal
//! distances are the ends of the buckets, and `t = u − ⌊u⌋` is the argument of the polynomial. Of other points, each bucket
//! knows the piece in which it begins; a few comparisons lead from there to that of x, which begins at `knot`, and
//! `t = x − knot`.

use crate::Scalar;

/// `1.5 · 2⁵²`: adding it rounds to the nearest integer, which then stands in the low bits.
pub(crate) const ROUND: f64 = 6_755_399_441_055_744.0;

/// A function that is given by points: generated code has it as a constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookupTable<'a> {
    /// The first x.
    pub first: f64,
    /// Buckets per unit of x; the last x is just below the end of the last bucket.
    pub scale: f64,
    /// The piece in which each bucket begins, before and behind them what is beyond the ends; empty if the points are at
    /// equal distances.
    pub starts: &'a [u32],
    /// Where each piece begins; empty if the points are at equal distances.
    pub knots: &'a [f64],
    /// Each piece by its coefficients, the lowest power of t first; the first and the last are beyond the ends.
    pub pieces: &'a [[f64; 4]],
    /// How many comparisons lead from the beginning of a bucket to any piece in it.
    pub steps: u32,
}

impl LookupTable<'_> {
    /// Its value; not a number beyond ends that do not hold.
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

    /// Its first, second or third derivative; at a point where pieces differ, that of one of them.
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

    /// `dt/dx`.
    #[inline(always)]
    pub fn unit(&self) -> f64 {
        if self.starts.is_empty() { self.scale } else { 1.0 }
    }

    /// How many buckets there are, and so from where on x is beyond them.
    #[inline(always)]
    pub(crate) fn buckets(&self) -> f64 {
        let entries = if self.starts.is_empty() { self.pieces.len() } else { self.starts.len() };
        entries as f64 - 2.0
    }

    /// The bucket that `rounded` holds in its low bits, see [`ROUND`]; counted from 1, since 0 is before the first.
    #[inline(always)]
    pub(crate) fn bucket_in(rounded: f64) -> usize {
        (rounded.to_bits() as u32).wrapping_add(1) as usize
    }

    /// The bucket of x: its entry among `starts`.
    #[inline(always)]
    pub fn bucket(&self, x: f64) -> usize {
        Self::bucket_in(self.rounded((x - self.first) * self.scale))
    }

    /// `⌊u⌋`, no further than a bucket beyond the ends, see [`ROUND`].
    #[inline(always)]
    fn rounded(&self, u: f64) -> f64 {
        (u - 0.5).max(-1.0).min(self.buckets()) + ROUND
    }

    /// The piece of x, where its bucket is known and points are not at equal distances.
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

    /// The coefficients of a piece.
    #[inline(always)]
    pub(crate) fn coefficients(&self, piece: usize) -> &[f64; 4] {
        const NONE: &[f64; 4] = &[f64::NAN; 4];
        self.pieces.get(piece).unwrap_or(NONE)
    }

    /// Where a piece begins.
    #[inline(always)]
    pub(crate) fn knot(&self, piece: usize) -> f64 {
        self.knots.get(piece).copied().unwrap_or(f64::NAN)
    }

    /// `t` and the coefficients at x.
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
}
