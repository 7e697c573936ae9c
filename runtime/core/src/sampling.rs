//! Deterministic sample points: the same on every run and every machine.

use core::f64::consts::PI;
use std::{sync::LazyLock, vec, vec::Vec};

use crate::{Description, Manipulator, Variable};

pub use arm_length::{JointAxis, arm_length, arm_length_within};
pub use vectors::norm;

mod arm_length;
pub mod vectors;

/// Returns term `index` of the Halton sequence in a dimension, in `[0, 1)`: the radical inverse of
/// `index` in the dimension's prime base.
///
/// ```
/// use abbe::analysis::sampling::halton;
/// // Bases 2 and 3. Index 0 is the corner 0; start at 1.
/// assert_eq!([halton(1, 0), halton(2, 0), halton(3, 0)], [0.5, 0.25, 0.75]);
/// assert_eq!(halton(1, 1), 1.0 / 3.0);
/// ```
pub fn halton(index: usize, dimension: usize) -> f64 {
    radical_inverse(index, prime(dimension))
}

/// Returns the digits of `index` in a base, mirrored at the radix point: `0.d_0 d_1 d_2 …`, rounded
/// once.
pub fn radical_inverse(index: usize, base: usize) -> f64 {
    let end = RadicalInverses::end(base);
    mirrored(index, base, end) as f64 / end as f64
}

/// Returns the mirrored digits of `index` as an integer below `end`, a power of the base. Digits
/// beyond those of the power are ignored.
fn mirrored(index: usize, base: usize, end: u64) -> u64 {
    let base = base as u64;
    let (mut rest, mut mirrored, mut weight) = (index as u64, 0, end);
    while weight >= base {
        weight /= base;
        mirrored += weight * (rest % base);
        rest /= base;
    }
    mirrored
}

/// Radical inverses of consecutive numbers in one base.
///
/// The low digits of the numbers come from a table, so that consecutive values differ by additions.
///
/// ```
/// use abbe::analysis::sampling::{RadicalInverses, radical_inverse};
/// let mut values = [0.0; 4];
/// RadicalInverses::new(3).fill(1, &mut values);
/// assert_eq!(values, [1, 2, 3, 4].map(|index| radical_inverse(index, 3)));
/// ```
#[derive(Clone, Debug)]
pub struct RadicalInverses {
    base: usize,
    /// Mirrored digits of all numbers below a power of the base.
    low: Vec<u64>,
    /// Largest power of the base that a floating-point number represents exactly.
    end: u64,
}

impl RadicalInverses {
    /// Largest number of entries of the table.
    const TABLE: usize = 1024;

    /// Prepares the values in a base.
    pub fn new(base: usize) -> Self {
        let end = Self::end(base);
        let mut count = base;
        while count <= Self::TABLE / base {
            count *= base;
        }
        let low = if count <= Self::TABLE { count } else { 1 };
        Self { base, low: (0..low).map(|index| mirrored(index, base, end)).collect(), end }
    }

    /// Returns the largest power of a base of at most 2⁵³.
    fn end(base: usize) -> u64 {
        let mut end = 1;
        while end <= (1 << f64::MANTISSA_DIGITS) / base as u64 {
            end *= base as u64;
        }
        end
    }

    /// Writes the radical inverses of the numbers from `index` on.
    #[inline(always)]
    pub fn fill(&self, index: usize, values: &mut [f64]) {
        let end = self.end as f64;
        let (mut index, mut rest) = (index, values);
        while !rest.is_empty() {
            let (block, first) = (index / self.low.len(), index % self.low.len());
            let high = mirrored(block, self.base, self.end / self.low.len() as u64);
            let low = &self.low[first..];
            let (values, others) = rest.split_at_mut(low.len().min(rest.len()));
            for (value, low) in values.iter_mut().zip(low) {
                *value = (low + high) as f64 / end;
            }
            index += values.len();
            rest = others;
        }
    }
}

/// Returns prime number `index`: 2, 3, 5, …
pub fn prime(index: usize) -> usize {
    /// Covers the variables of all practical chains; cached because every sample needs them.
    static FIRST: LazyLock<Vec<usize>> = LazyLock::new(|| sieved(1 << 17));
    let is_prime = |n: usize| (2..).take_while(|d| d * d <= n).all(|d| !n.is_multiple_of(d));
    match FIRST.get(index) {
        Some(prime) => *prime,
        None => (1 << 17..).filter(|&n| is_prime(n)).nth(index - FIRST.len()).unwrap_or(2),
    }
}

/// Returns the primes below `end`, by the sieve of Eratosthenes.
fn sieved(end: usize) -> Vec<usize> {
    let mut is_multiple = vec![false; end];
    let mut primes = Vec::new();
    for n in 2..end {
        if !is_multiple[n] {
            primes.push(n);
            (n * n..end).step_by(n).for_each(|multiple| is_multiple[multiple] = true);
        }
    }
    primes
}

/// Returns `count` equidistant values from one end of a range to the other. A single value is the
/// center.
///
/// ```
/// use abbe::analysis::sampling::grid;
/// assert_eq!(grid([-1.0, 1.0], 5), [-1.0, -0.5, 0.0, 0.5, 1.0]);
/// assert_eq!(grid([-1.0, 1.0], 1), [0.0]);
/// ```
pub fn grid([first, last]: [f64; 2], count: usize) -> Vec<f64> {
    let fraction = |i: usize| if count == 1 { 0.5 } else { i as f64 / (count - 1) as f64 };
    (0..count).map(|i| first * (1.0 - fraction(i)) + last * fraction(i)).collect()
}

/// Returns the smallest and the largest value; infinite and reversed without values.
pub fn range_of(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], value| [a.min(value), b.max(value)])
}

/// Returns the home configuration.
pub fn home(description: &Description) -> Vec<f64> {
    description.variables.iter().map(|variable| variable.home).collect()
}

/// Returns the nominal structural parameters.
pub fn nominal_parameters(description: &Description) -> Vec<f64> {
    description.parameters.iter().map(|parameter| parameter.nominal).collect()
}

/// Returns the default inputs.
pub fn nominal_inputs(description: &Description) -> Vec<f64> {
    description.inputs.iter().map(|input| input.nominal).collect()
}

/// Returns `false` where the loops of a manipulator do not close.
pub fn closes(manipulator: &dyn Manipulator, q: &[f64], s: &[f64]) -> bool {
    let mut passive = vec![0.0; manipulator.description().passive().count()];
    passive.is_empty() || !manipulator.passive(q, s, &mut passive).is_err_and(|error| error.is_open())
}

/// Returns the range from which a variable is sampled: its limits. If both are infinite, the range
/// is half a turn or one arm length to either side of zero. If one is infinite, the range has the
/// same width and begins at the other.
pub fn joint_range(variable: &Variable, arm: f64) -> [f64; 2] {
    let span = variable.kind.either(PI, arm);
    let [lower, upper] = variable.limits;
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) => [lower, upper],
        (true, false) => [lower, lower + 2.0 * span],
        (false, true) => [upper - 2.0 * span, upper],
        (false, false) => [-span, span],
    }
}

/// Returns sample `index` of the joint variables, counted from 0. Variables that are not in `moved`
/// stay at home.
pub fn joint_sample(description: &Description, arm: f64, moved: &[usize], index: usize) -> Vec<f64> {
    let mut q = home(description);
    for (dimension, &i) in moved.iter().enumerate() {
        if let Some(variable) = description.variables.get(i) {
            let [lower, upper] = joint_range(variable, arm);
            q[i] = lower + (upper - lower) * halton(index + 1, dimension);
        }
    }
    q
}

#[cfg(test)]
mod tests;
