//! Values and derivatives of lookup tables for any scalar.

use crate::{LookupTable, Scalar};

impl LookupTable<'_> {
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
