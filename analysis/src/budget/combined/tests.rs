//! Tests of `combined.rs`.

use abbe_core::lanes::{InstructionSet, Kernel};
use nalgebra::Matrix3;

use super::*;
use abbe_kinematics::sampling::halton;

/// Counts covariances whose largest eigenvalue the criterion misjudges.
struct Misjudged;

impl Kernel for Misjudged {
    type Output = usize;

    fn run<R: Register>(self) -> usize {
        let is_misjudged = |i: &usize| {
            let rows = Matrix3::from_fn(|row, column| halton(*i, 3 * row + column) - 0.5);
            let covariance = rows * rows.transpose();
            let largest = covariance.symmetric_eigenvalues().max();
            let [xx, yy, zz, xy, xz, yz] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
            let lanes = [xx, yy, zz, xy, xz, yz].map(|entry| Lanes::<R>::constant(covariance[entry]));
            let is_longer = |limit| least_minor(&lanes, limit).as_slice()[0] < 0.0;
            !is_longer(largest * (1.0 - 1e-6)) || is_longer(largest * (1.0 + 1e-6))
        };
        (1..2000).filter(is_misjudged).count()
    }
}

#[test]
fn longer_ellipsoids_are_found_and_no_others() {
    assert_eq!(InstructionSet::best().run(Misjudged), 0);
}
