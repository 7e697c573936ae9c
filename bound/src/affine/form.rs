//! Affine forms: enclosures of a number while names move within their ranges (Comba and Stolfi,
//! *Affine arithmetic and its applications to computer graphics*, 1993; Messine, *Extensions of
//! affine arithmetic*, 2002).
//!
//! # Rounding
//!
//! A rounded result x differs from the exact one by at most `UNIT |x|`, or by less than the
//! smallest number if it underflows. The effect of all roundings of an operation is added to
//! `rest`. `rest` and `spread` themselves are sums of nonnegative products with fewer than 64
//! roundings each; [`above`] makes them no less than the exact values.

/// Unit of roundoff: maximum relative error of one rounding.
pub(crate) const UNIT: f64 = f64::EPSILON / 2.0;

/// Returns an upper bound of a sum of nonnegative products that was computed with fewer than 64
/// roundings.
#[inline(always)]
pub(crate) fn above(sum: f64) -> f64 {
    sum * (1.0 + 128.0 * UNIT) + f64::MIN_POSITIVE
}

/// `centre + Σ slopes_i t_i ± rest`, where each `t_i` lies in [−1, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine<const N: usize> {
    pub(crate) centre: f64,
    pub(crate) slopes: [f64; N],
    /// Upper bound of `Σ |slopes_i|`.
    pub(crate) spread: f64,
    pub(crate) rest: f64,
}

impl<const N: usize> Affine<N> {
    pub(crate) fn new(centre: f64, slopes: [f64; N], rest: f64) -> Self {
        let spread = above(slopes.iter().map(|slope| slope.abs()).sum());
        Self { centre, slopes, spread, rest }
    }

    /// Creates a number with a known error.
    pub(crate) fn known(centre: f64, rest: f64) -> Self {
        Self { centre, slopes: [0.0; N], spread: 0.0, rest }
    }

    /// Creates an enclosure of an interval.
    pub(crate) fn between(low: f64, high: f64) -> Self {
        let centre = 0.5 * low + 0.5 * high;
        Self::known(centre, above((high - centre).abs().max((centre - low).abs()) + UNIT * centre.abs()))
    }

    /// Creates an unbounded enclosure.
    pub(crate) fn anything() -> Self {
        Self::known(0.0, f64::INFINITY)
    }

    /// Returns the maximum distance from the centre.
    pub(crate) fn radius(&self) -> f64 {
        above(self.spread + self.rest)
    }

    /// Returns the enclosing interval; infinite if the form is unbounded or NaN.
    pub(crate) fn range(&self) -> [f64; 2] {
        let radius = self.radius();
        let [low, high] = [(self.centre - radius).next_down(), (self.centre + radius).next_up()];
        if low <= high { [low, high] } else { [f64::NEG_INFINITY, f64::INFINITY] }
    }

    pub(crate) fn neg(&self) -> Self {
        Self { centre: -self.centre, slopes: self.slopes.map(|slope| -slope), ..*self }
    }

    #[inline(always)]
    pub(crate) fn add(&self, other: &Self) -> Self {
        let slopes = std::array::from_fn(|i| self.slopes[i] + other.slopes[i]);
        let sum = Self::new(self.centre + other.centre, slopes, 0.0);
        Self { rest: above(self.rest + other.rest + UNIT * (sum.centre.abs() + sum.spread)), ..sum }
    }

    #[inline(always)]
    pub(crate) fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }

    /// Adds a number.
    pub(crate) fn shifted(&self, by: &Affine<0>) -> Self {
        let centre = self.centre + by.centre;
        Self { centre, rest: above(self.rest + by.rest + UNIT * centre.abs()), ..*self }
    }

    /// Multiplies by a number.
    pub(crate) fn scaled(&self, by: &Affine<0>) -> Self {
        let factor = by.centre;
        let scaled = Self::new(factor * self.centre, self.slopes.map(|slope| factor * slope), 0.0);
        let all = self.centre.abs() + self.spread + self.rest;
        let rest = factor.abs() * self.rest + by.rest * all + UNIT * (scaled.centre.abs() + scaled.spread);
        Self { rest: above(rest), ..scaled }
    }

    /// Returns `slope (self − centre) + value ± rest`.
    pub(crate) fn linear(&self, slope: f64, value: f64, rest: f64) -> Self {
        let scaled = Self::new(value, self.slopes.map(|own| slope * own), 0.0);
        Self { rest: above(slope.abs() * self.rest + rest + UNIT * scaled.spread), ..scaled }
    }

    /// Returns the product. In `Σ a_i t_i · Σ b_j t_j` the squares `t_i²` lie between 0 and 1,
    /// which leaves
    ///
    /// ```text
    /// ½ Σ a_i b_i  ±  (Σ |a_i| Σ |b_j| − ½ Σ |a_i b_i|)
    /// ```
    #[inline(always)]
    pub(crate) fn mul(&self, other: &Self) -> Self {
        let (mut cross, mut size) = (0.0, 0.0);
        for (a, b) in self.slopes.iter().zip(&other.slopes) {
            let product = a * b;
            cross += product;
            size += product.abs();
        }
        let centre = self.centre * other.centre + 0.5 * cross;
        let slopes = std::array::from_fn(|i| self.centre * other.slopes[i] + other.centre * self.slopes[i]);
        let (a, b) = (self.centre.abs() + self.spread, other.centre.abs() + other.spread);
        let mixed = self.spread * other.spread - 0.5 * size;
        let rounding = (N + 8) as f64 * UNIT * a * b;
        let rest = a * other.rest + b * self.rest + self.rest * other.rest + mixed + rounding;
        Self::new(centre, slopes, above(rest))
    }
}
