//! Deterministic points to evaluate a manipulator at: the same on every run and every machine.

use core::f64::consts::PI;
use std::sync::LazyLock;
use std::vec;
use std::vec::Vec;

use crate::{Description, Error, Manipulator, Variable, VariableKind};

/// Number `index` of the Halton sequence in a dimension, in `[0, 1)`: the radical inverse of `index` in the
/// dimension's prime.
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

/// The digits of `index` in a base, mirrored at the point: `0.d_0 d_1 d_2 …`.
pub fn radical_inverse(index: usize, base: usize) -> f64 {
    let (mut digits, mut value, mut weight) = (index, 0.0, 1.0);
    while digits > 0 {
        weight /= base as f64;
        value += weight * (digits % base) as f64;
        digits /= base;
    }
    value
}

/// Prime number `index`: 2, 3, 5, …
pub fn prime(index: usize) -> usize {
    /// More than chains have variables: they are asked for again and again.
    static FIRST: LazyLock<Vec<usize>> = LazyLock::new(|| sieved(1 << 17));
    let is_prime = |n: usize| (2..).take_while(|d| d * d <= n).all(|d| !n.is_multiple_of(d));
    match FIRST.get(index) {
        Some(prime) => *prime,
        None => (1 << 17..).filter(|&n| is_prime(n)).nth(index - FIRST.len()).unwrap_or(2),
    }
}

/// The primes below an end, by the sieve of Eratosthenes.
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

/// `count` equally spaced values from one end of a range to the other; a single one is the middle.
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

/// The home configuration.
pub fn home(description: &Description) -> Vec<f64> {
    description.variables.iter().map(|variable| variable.home).collect()
}

/// The nominal structural parameters.
pub fn nominal_parameters(description: &Description) -> Vec<f64> {
    description.parameters.iter().map(|parameter| parameter.nominal).collect()
}

/// The default inputs.
pub fn nominal_inputs(description: &Description) -> Vec<f64> {
    description.inputs.iter().map(|input| input.nominal).collect()
}

/// The sum of the lengths of the chain's transforms at home: what a length is compared with. 1 if it is zero.
///
/// Errors as for [`Manipulator::transforms`].
pub fn arm_length(manipulator: &dyn Manipulator, s: &[f64]) -> Result<f64, Error> {
    let description = manipulator.description();
    let mut transforms = vec![crate::Pose::IDENTITY; description.frames.len() + 1];
    manipulator.transforms(&home(description), s, &mut transforms)?;
    let length = transforms.iter().map(|transform| norm(transform.position())).sum::<f64>();
    Ok(if length > 0.0 { length } else { 1.0 })
}

/// The range from which a variable is sampled: its limits; where there is none, half a turn or one arm
/// length to either side.
pub fn joint_range(variable: &Variable, arm: f64) -> [f64; 2] {
    let span = match variable.kind {
        VariableKind::Revolute => PI,
        VariableKind::Prismatic => arm,
    };
    let [lower, upper] = variable.limits;
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) => [lower, upper],
        (true, false) => [lower, lower + 2.0 * span],
        (false, true) => [upper - 2.0 * span, upper],
        (false, false) => [-span, span],
    }
}

/// Sample `index` of the joint variables; those not in `moved` stay at home. Samples start at index 0.
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

/// The Euclidean norm of a vector.
pub fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|component| component * component).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn primes_are_those_of_trial_division() {
        let is_prime = |n: &usize| (2..).take_while(|d| d * d <= *n).all(|d| !n.is_multiple_of(d));
        assert!(sieved(1 << 17).into_iter().eq((2..1 << 17).filter(is_prime)));
        // The last that is kept and the first that is not.
        assert_eq!([prime(0), prime(12_250), prime(12_251), prime(12_252)], [2, 131_071, 131_101, 131_111]);
    }
}
