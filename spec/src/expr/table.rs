//! Tables: functions that a spec defines by points.
//!
//! Slopes of monotone cubic interpolation, which never leaves the range between two neighbouring
//! points.
//!
//! The method is that of Fritsch and Butland, *A method for constructing local monotone piecewise
//! cubic interpolants*, SIAM J. Sci. Stat. Comput. 5 (1984) 300–304, with the ends of Moler,
//! *Numerical computing with MATLAB*, section 3.6. MATLAB and SciPy call it pchip. A natural spline
//! is smoother, but it overshoots between measured points, and one outlier affects all of it. Here
//! a point affects two intervals on each side.

use abbe_core::LookupTable;

use super::Dimension;

/// Interpolation between two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Piecewise linear.
    Linear,
    /// Monotone cubics with continuous slopes.
    Cubic,
}

/// Values beyond the first and the last point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extrapolation {
    /// No value: evaluation gives NaN.
    Nothing,
    /// The value at the end.
    Hold,
}

/// A function defined by points, with the data that generated code needs for lookups.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Name in expressions.
    pub name: String,
    /// Description.
    pub description: String,
    /// Dimensions of the argument and of the value.
    pub dimensions: [Dimension; 2],
    /// Points (x, y), with x ascending.
    pub points: Vec<[f64; 2]>,
    /// Interpolation between the points.
    pub interpolation: Interpolation,
    /// Values beyond the points.
    pub outside: Extrapolation,
    scale: f64,
    starts: Vec<u32>,
    knots: Vec<f64>,
    pieces: Vec<[f64; 4]>,
    steps: u32,
}

impl Table {
    /// Creates a table from at least two points with ascending x.
    pub fn new(
        name: String,
        description: String,
        dimensions: [Dimension; 2],
        points: Vec<[f64; 2]>,
        interpolation: Interpolation,
        outside: Extrapolation,
    ) -> Self {
        let intervals = points.len() - 1;
        let [first, last] = [points[0][0], points[intervals][0]];
        let mut table = Self {
            name,
            description,
            dimensions,
            points,
            interpolation,
            outside,
            scale: 0.0,
            starts: Vec::new(),
            knots: Vec::new(),
            pieces: Vec::new(),
            steps: 0,
        };
        if table.is_even() {
            table.scale = scale(first, last, intervals);
            table.pieces = table.pieces_of(|_| (last - first) / intervals as f64, |_| 1.0);
        } else {
            let width = |k: usize| table.points[k + 1][0] - table.points[k][0];
            table.pieces = table.pieces_of(width, width);
            table.knots = [first].into_iter().chain(table.points.iter().map(|point| point[0])).collect();
            table.fill_buckets();
        }
        table
    }

    /// Returns the same function with the values at the ends held beyond them.
    #[must_use]
    pub fn held(&self) -> Self {
        let Self { name, description, dimensions, points, interpolation, .. } = self.clone();
        Self::new(name, description, dimensions, points, interpolation, Extrapolation::Hold)
    }

    /// Returns the data of generated code.
    pub fn lookup(&self) -> LookupTable<'_> {
        LookupTable {
            first: self.points[0][0],
            scale: self.scale,
            starts: &self.starts,
            knots: &self.knots,
            pieces: &self.pieces,
            steps: self.steps,
        }
    }

    /// Returns a derivative; order 0 is the function itself.
    pub fn derivative(&self, order: u32, x: f64) -> f64 {
        match order {
            0 => self.lookup().value(x),
            _ => self.lookup().derivative(order, x),
        }
    }

    /// Returns the name of the constant in generated code.
    pub fn constant_name(&self) -> String {
        format!("{}_TABLE", self.name.to_ascii_uppercase())
    }

    /// Returns the documentation in generated code; `description` must be escaped for a comment.
    pub fn documentation(&self, description: &str) -> String {
        let kind = match self.interpolation {
            Interpolation::Linear => "piecewise linear",
            Interpolation::Cubic => "monotone cubic",
        };
        let beyond = match self.outside {
            Extrapolation::Nothing => "NaN outside",
            Extrapolation::Hold => "end value held outside",
        };
        let ([first, last], count) = (self.ends(), self.points.len());
        let description = description.trim_end_matches('.');
        let before = if description.is_empty() { String::new() } else { format!("{description}. ") };
        format!(
            "{before}`{}`: {kind} interpolation of {count} points from {first} to {last}, {beyond}.",
            self.name
        )
    }

    /// Returns the first and last x.
    pub fn ends(&self) -> [f64; 2] {
        [self.points[0][0], self.points[self.points.len() - 1][0]]
    }

    /// Returns the order of the highest derivative that is not zero everywhere.
    pub fn degree(&self) -> u32 {
        match self.interpolation {
            Interpolation::Linear => 1,
            Interpolation::Cubic => 3,
        }
    }

    /// Returns `true` if all values between the ends are finite.
    pub(crate) fn is_finite(&self) -> bool {
        let inner = &self.pieces[1..self.pieces.len() - 1];
        self.scale.is_finite() && inner.iter().flatten().all(|number| number.is_finite())
    }

    /// Returns `true` if the points are equally spaced, up to rounding.
    fn is_even(&self) -> bool {
        let [first, last] = self.ends();
        let step = (last - first) / (self.points.len() - 1) as f64;
        let rounding = 4.0 * f64::EPSILON * first.abs().max(last.abs());
        let even = |(k, [x, _]): (usize, &[f64; 2])| (x - (first + k as f64 * step)).abs() <= rounding;
        self.points.iter().enumerate().all(even)
    }

    /// Returns the coefficients of every piece, for t from 0 to `length`, and of the constants
    /// beyond the ends.
    ///
    /// With `τ = t/length`, `Δ = y₁ − y₀` and slopes `d = h m` by τ: `y₀ + d₀ τ + (3Δ − 2d₀ − d₁)
    /// τ² + (d₀ + d₁ − 2Δ) τ³`.
    fn pieces_of(&self, width: impl Fn(usize) -> f64, length: impl Fn(usize) -> f64) -> Vec<[f64; 4]> {
        let intervals = self.points.len() - 1;
        let widths: Vec<f64> = (0..intervals).map(width).collect();
        let y = |k: usize| self.points[k][1];
        let slopes = match self.interpolation {
            Interpolation::Linear => Vec::new(),
            Interpolation::Cubic => {
                let secants: Vec<f64> = (0..intervals).map(|k| (y(k + 1) - y(k)) / widths[k]).collect();
                slopes(&widths, &secants)
            }
        };
        let piece = |k: usize| {
            let (change, length) = (y(k + 1) - y(k), length(k));
            let [first, second, third] = match self.interpolation {
                Interpolation::Linear => [change, 0.0, 0.0],
                Interpolation::Cubic => {
                    let (from, to) = (widths[k] * slopes[k], widths[k] * slopes[k + 1]);
                    [from, 3.0 * change - 2.0 * from - to, from + to - 2.0 * change]
                }
            };
            [y(k), first / length, second / length.powi(2), third / length.powi(3)]
        };
        let end = |k: usize| match self.outside {
            Extrapolation::Nothing => [f64::NAN; 4],
            Extrapolation::Hold => [y(k), 0.0, 0.0, 0.0],
        };
        [end(0)].into_iter().chain((0..intervals).map(piece)).chain([end(intervals)]).collect()
    }

    /// Chooses the number of buckets so that each contains one point, if that takes at most eight
    /// times as many buckets as there are intervals.
    fn fill_buckets(&mut self) {
        let [first, last] = self.ends();
        let intervals = self.points.len() - 1;
        for factor in [1, 2, 4, 8] {
            let buckets = factor * intervals;
            self.scale = scale(first, last, buckets);
            // There is one more bucket before the first and one after the last.
            self.starts = vec![0; buckets + 2];
            let of_knot: Vec<usize> = self.knots.iter().map(|knot| self.lookup().bucket(*knot)).collect();
            let mut piece = 0;
            for bucket in 1..self.starts.len() {
                while piece + 1 < of_knot.len() && (piece == 0 || of_knot[piece + 1] < bucket) {
                    piece += 1;
                }
                self.starts[bucket] = piece as u32;
            }
            let inner = &of_knot[2..of_knot.len() - 1];
            let crowded = inner.chunk_by(|a, b| a == b).map(<[usize]>::len).max().unwrap_or(0);
            self.steps = usize::BITS - crowded.leading_zeros();
            if self.steps <= 1 {
                break;
            }
        }
    }
}

/// Returns the number of buckets per unit of x, such that the last x lies within the last bucket.
fn scale(first: f64, last: f64, buckets: usize) -> f64 {
    let mut scale = buckets as f64 / (last - first);
    while (last - first) * scale >= buckets as f64 {
        scale = scale.next_down();
    }
    scale
}

/// Returns the slope at each of n + 1 points, from the widths of the n intervals and the slopes of
/// their secants.
///
/// If the secants `d` of two neighbouring intervals differ in sign, the slope is 0. Otherwise it is
/// their weighted harmonic mean: `m = (w₁ + w₂) / (w₁/d₁ + w₂/d₂)` with `w₁ = 2h₂ + h₁` and `w₂ =
/// h₂ + 2h₁`.
pub(super) fn slopes(widths: &[f64], secants: &[f64]) -> Vec<f64> {
    let count = widths.len();
    if count == 1 {
        return vec![secants[0]; 2];
    }
    let inner = |k: usize| {
        let ([h1, h2], [d1, d2]) = ([widths[k - 1], widths[k]], [secants[k - 1], secants[k]]);
        if d1 * d2 <= 0.0 {
            return 0.0;
        }
        let (w1, w2) = (2.0 * h2 + h1, h2 + 2.0 * h1);
        (w1 + w2) / (w1 / d1 + w2 / d2)
    };
    let first = end([widths[0], widths[1]], [secants[0], secants[1]]);
    let last = end([widths[count - 1], widths[count - 2]], [secants[count - 1], secants[count - 2]]);
    [first].into_iter().chain((1..count).map(inner)).chain([last]).collect()
}

/// Returns the slope at an end: that of the parabola through three points, `((2h₁ + h₂) d₁ − h₁ d₂)
/// / (h₁ + h₂)`, limited to the sign of `d₁`, and to `3 d₁` if the secants differ in sign.
fn end([h1, h2]: [f64; 2], [d1, d2]: [f64; 2]) -> f64 {
    let slope = ((2.0 * h1 + h2) * d1 - h1 * d2) / (h1 + h2);
    if slope * d1 <= 0.0 {
        0.0
    } else if d1 * d2 < 0.0 && slope.abs() > 3.0 * d1.abs() {
        3.0 * d1
    } else {
        slope
    }
}
