//! Tests of `sampling.rs`.

use super::*;

/// Compares with the sum of digits, and each step with a new start, also where digits carry.
#[test]
fn radical_inverses_mirror_the_digits() {
    let sum = |index: usize, base: usize| {
        let (mut digits, mut value, mut weight) = (index, 0.0, 1.0);
        while digits > 0 {
            weight /= base as f64;
            value += weight * (digits % base) as f64;
            digits /= base;
        }
        value
    };
    for base in [2_usize, 3, 5, 7, 131_071] {
        for first in [0, 1, base.pow(3) - 2, 12_345_678_901] {
            let mut values = [0.0; 2500];
            RadicalInverses::new(base).fill(first, &mut values);
            for (index, value) in (first..).zip(values) {
                assert_eq!(value, radical_inverse(index, base));
                assert!((value - sum(index, base)).abs() < 1e-15, "{index} {base}");
            }
        }
    }
    let mut last = [0.0; 2];
    RadicalInverses::new(2).fill((1 << 53) - 1, &mut last);
    assert_eq!(last, [1.0 - f64::EPSILON / 2.0, 0.0]);
}

#[test]
fn primes_are_those_of_trial_division() {
    let is_prime = |n: &usize| (2..).take_while(|d| d * d <= *n).all(|d| !n.is_multiple_of(d));
    assert!(sieved(1 << 17).into_iter().eq((2..1 << 17).filter(is_prime)));
    // The last cached prime and the first computed one.
    assert_eq!([prime(0), prime(12_250), prime(12_251), prime(12_252)], [2, 131_071, 131_101, 131_111]);
}
