//! Functions of affine forms: `f(x) = f(c) + α (x − c) ± rest`, with α and the rest from the range
//! of the derivative.

use std::f64::consts::{FRAC_PI_2, PI};

use abbe_core::Scalar;
use abbe_spec::expr::Function;

use super::form::{Affine, UNIT, above};

/// Maximum error of our own sine and cosine: 1.7 units in the last place of a number below 1, and 4
/// units of roundoff outside their accurate range.
const SINE: f64 = 4.0 * UNIT;
/// Maximum relative error of library functions, as in the rounding analysis of generated code.
const LIBRARY: f64 = 8.0 * UNIT;
/// Radius up to which sine and cosine are enclosed by series.
const SMALL: f64 = 0.25;

impl<const N: usize> Affine<N> {
    /// Returns sine and cosine. With `x = m + δ` and `|δ| ≤ w`:
    ///
    /// ```text
    /// sin x = sin m cos δ + cos m sin δ        cos δ between cos w and 1        sin δ = α δ ± e
    /// ```
    pub(crate) fn sin_cos(&self) -> [Self; 2] {
        let radius = self.radius();
        if !(radius < PI && self.centre.is_finite()) {
            return [Self::known(0.0, 1.0); 2];
        }
        let (sine, cosine) = Scalar::sin_cos(self.centre);
        let ([middle, half], [slope, error]) = (cosine_within(radius), sine_within(radius));
        let turned = |value: f64, derivative: f64| {
            let rest = value.abs() * half + derivative.abs() * error + SINE * (1.0 + radius) + 2.0 * UNIT;
            self.linear(derivative * slope, value * middle, above(rest + 2.0 * UNIT * radius))
        };
        [turned(sine, cosine), turned(cosine, -sine)]
    }

    /// Returns any function of one argument, and whether it may jump within the range.
    pub(crate) fn call(&self, function: Function) -> (Self, bool) {
        let [low, high] = self.range();
        if !(low.is_finite() && high.is_finite()) {
            return (Self::anything(), true);
        }
        let monotone = |f: fn(f64) -> f64, slopes: [f64; 2]| self.by_slopes(f(self.centre), slopes);
        let form = match function {
            Function::Sin => self.sin_cos()[0],
            Function::Cos => self.sin_cos()[1],
            Function::Tan => {
                let turns = |x: f64| (x / PI + 0.5).floor();
                match turns(low) == turns(high) {
                    true => monotone(f64::tan, sizes(low.tan(), high.tan()).map(|size| 1.0 + size * size)),
                    false => Self::anything(),
                }
            }
            Function::Asin | Function::Acos => {
                if low < -1.0 || high > 1.0 {
                    return (Self::anything(), true);
                }
                // 1 − x² would cancel near x = 1.
                let [near, far] = sizes(low, high).map(|size| 1.0 / ((1.0 - size) * (1.0 + size)).sqrt());
                let arc = match far.is_finite() {
                    true => monotone(f64::asin, [near, far]),
                    false => Self::between(low.asin() - LIBRARY, high.asin() + LIBRARY),
                };
                if function == Function::Asin { arc } else { arc.neg().shifted(&quarter_turn()) }
            }
            Function::Atan => {
                let [near, far] = sizes(low, high).map(|size| 1.0 / (1.0 + size * size));
                monotone(f64::atan, [far, near])
            }
            Function::Sqrt if low > 0.0 => monotone(f64::sqrt, [0.5 / high.sqrt(), 0.5 / low.sqrt()]),
            Function::Sqrt if high >= 0.0 => Self::between(0.0, high.sqrt().next_up()),
            Function::Sqrt => Self::anything(),
            Function::Exp => monotone(f64::exp, [low.exp(), high.exp()]),
            Function::Log if low > 0.0 => monotone(f64::ln, [1.0 / high, 1.0 / low]),
            Function::Log => Self::anything(),
            Function::Abs if low >= 0.0 => *self,
            Function::Abs if high <= 0.0 => self.neg(),
            // Bounded by the chord from above and by 0 from below: |x| − α x lies between 0 and 2
            // β.
            Function::Abs => {
                let (slope, half) = ((high + low) / (high - low), -low * (high / (high - low)));
                let value = slope * self.centre + half;
                self.linear(slope, value, above(half + 8.0 * UNIT * (high - low)))
            }
            Function::Sign if low > 0.0 => Self::known(1.0, 0.0),
            Function::Sign if high < 0.0 => Self::known(-1.0, 0.0),
            Function::Sign => return (Self::known(0.0, 1.0), true),
            Function::Side if low >= 0.0 => Self::known(1.0, 0.0),
            Function::Side if high < 0.0 => Self::known(-1.0, 0.0),
            Function::Side => Self::known(0.0, 1.0),
        };
        (form, false)
    }

    /// Returns `1 / self`; unbounded if the range contains 0.
    pub(crate) fn reciprocal(&self) -> Self {
        let [low, high] = self.range();
        if !(low > 0.0 || high < 0.0) {
            return Self::anything();
        }
        let slopes = [-1.0 / (low * low), -1.0 / (high * high)];
        self.by_slopes(1.0 / self.centre, slopes)
    }

    /// Returns a power of a positive number; unbounded for any other.
    pub(crate) fn power(&self, exponent: f64) -> Self {
        let [low, high] = self.range();
        if !(low > 0.0 && high.is_finite()) {
            return Self::anything();
        }
        let slope = |x: f64| exponent * x.powf(exponent - 1.0);
        self.by_slopes(self.centre.powf(exponent), [slope(low), slope(high)])
    }

    /// Returns the angle of the point (x, self), and whether it may jump.
    pub(crate) fn angle(&self, x: &Self) -> (Self, bool) {
        let ([x_low, _], [low, high]) = (x.range(), self.range());
        let quotient = |a: &Self, b: &Self| a.mul(&b.reciprocal()).call(Function::Atan).0;
        if x_low > 0.0 {
            (quotient(self, x), false)
        } else if low > 0.0 {
            (quotient(x, self).neg().shifted(&quarter_turn()), false)
        } else if high < 0.0 {
            (quotient(x, self).neg().shifted(&quarter_turn().neg()), false)
        } else {
            (Self::known(0.0, above(PI)), true)
        }
    }

    /// Returns the larger of two numbers.
    pub(crate) fn larger(&self, other: &Self) -> Self {
        let ([low, high], [other_low, other_high]) = (self.range(), other.range());
        if low >= other_high {
            return *self;
        }
        if other_low >= high {
            return *other;
        }
        let half = Affine::known(0.5, 0.0);
        let (sum, distance) = (self.add(other), self.sub(other).call(Function::Abs).0);
        sum.add(&distance).scaled(&half)
    }

    /// Returns the smaller of two numbers.
    pub(crate) fn smaller(&self, other: &Self) -> Self {
        self.neg().larger(&other.neg()).neg()
    }

    /// Returns a function with the given value at the centre, and with slopes between the two given
    /// ones everywhere.
    pub(crate) fn by_slopes(&self, value: f64, slopes: [f64; 2]) -> Self {
        let [first, second] = slopes;
        let (slope, margin) = (0.5 * first + 0.5 * second, 2.0 * LIBRARY * (first.abs() + second.abs()));
        let half = 0.5 * (first - second).abs() + margin;
        let rest = half * self.radius() + LIBRARY * value.abs();
        let form = self.linear(slope, value, above(rest));
        if form.rest.is_finite() { form } else { Self::anything() }
    }
}

/// Returns π/2.
fn quarter_turn() -> Affine<0> {
    Affine::known(FRAC_PI_2, UNIT)
}

/// Returns the least and the largest absolute value of the numbers between two.
fn sizes(low: f64, high: f64) -> [f64; 2] {
    let (a, b) = (low.abs(), high.abs());
    let least = if low <= 0.0 && high >= 0.0 { 0.0 } else { a.min(b) };
    [least, a.max(b)]
}

/// Returns `[middle, half]` with `cos δ = middle ± half` for `|δ| ≤ w ≤ π`: between `1 − w²/2` or
/// `cos w`, and 1.
fn cosine_within(w: f64) -> [f64; 2] {
    if w <= SMALL {
        let quarter = 0.25 * w * w;
        return [1.0 - quarter, above(quarter + UNIT)];
    }
    let least = w.cos() - 2.0 * LIBRARY;
    [0.5 + 0.5 * least, 0.5 - 0.5 * least + 2.0 * UNIT]
}

/// Returns `[α, e]` with `sin δ = α δ ± e` for `|δ| ≤ w ≤ π`. For small w, `δ³ = ¾ w² δ ± w³/4`
/// (Chebyshev) and `sin δ = δ − δ³/6 ± |δ|⁵/120` give `α = 1 − w²/8`, `e = w³/24 + w⁵/120`. For
/// larger w, α is the coefficient of the Chebyshev series of the sine, `2 J₁(w)/w`, and `sin δ − α
/// δ` is largest at `cos δ = α` or at an end.
fn sine_within(w: f64) -> [f64; 2] {
    let square = w * w;
    if w <= SMALL {
        let slope = 1.0 - square / 8.0;
        return [slope, above(w * square * (1.0 / 24.0 + square / 120.0) + 4.0 * UNIT * w)];
    }
    let slope = 1.0 - square / 8.0 * (1.0 - square / 24.0 * (1.0 - square / 48.0));
    let inner = slope.acos();
    let error = (w.sin() - slope * w).abs().max((inner.sin() - slope * inner).abs());
    // The δ with cos δ = α exceeds w only if the difference is largest at the end.
    [slope, above(error + 8.0 * LIBRARY * (1.0 + w))]
}

#[cfg(test)]
mod tests;
