//! Tests of `basis.rs`.

use super::{ProfileBasis, ProfileJoint};
use crate::identify::Unknown;

fn joint(basis: ProfileBasis) -> ProfileJoint {
    ProfileJoint {
        variable: 0,
        error: Unknown::Zero(0),
        basis,
        range: [-3.0, 3.0],
        cycles: ProfileBasis::CYCLES,
    }
}

#[test]
fn functions_are_harmonics() {
    for q in [-3.0, 0.2, 2.5] {
        let values = joint(ProfileBasis::Turn).values(q);
        let travel = joint(ProfileBasis::Travel([-3.0, 3.0])).values(q);
        for k in 1..=64 {
            let angle = k as f64 * q;
            assert!((values[2 * k - 2] - angle.cos()).abs() < 1e-12);
            assert!((values[2 * k - 1] - angle.sin()).abs() < 1e-12);
            let half_periods = k as f64 * core::f64::consts::PI * (q + 3.0) / 6.0;
            assert!((travel[k - 1] - half_periods.cos()).abs() < 1e-12);
        }
    }
}

#[test]
fn beyond_the_range_the_end_holds() {
    let turn = joint(ProfileBasis::Turn);
    assert_eq!(turn.values(3.1), turn.values(3.0));
    assert_eq!(turn.values(-9.0), turn.values(-3.0));
    assert_ne!(turn.values(2.9), turn.values(3.0));
}
