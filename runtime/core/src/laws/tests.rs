//! Laws hold for correct robots by a wide margin, and fail for wrong ones.

mod by_hand;

use self::by_hand::{Pps, Puma};
use super::*;
use crate::lanes::OneByOne;
use crate::{Description, Error, Function, Manipulator};

#[test]
fn right_robots_pass_by_a_wide_margin() {
    for robot in [&Pps as &dyn Manipulator, &Puma] {
        let found = [
            error_jacobian(robot, SAMPLES).unwrap(),
            joint_jacobian(robot, SAMPLES).unwrap(),
            parameter_jacobian(robot, SAMPLES).unwrap(),
        ];
        for discrepancy in found {
            assert!(discrepancy.relative < 1e-10, "{discrepancy:?}");
            assert_eq!(discrepancy.compared, SAMPLES);
        }
        let slope = remainder_slope(robot, SAMPLES).unwrap();
        assert!((slope.slope - 2.0).abs() < 0.02, "{slope:?}");
    }
}

/// The patient positioning system with a corrupted Jacobian.
struct Wrong(fn(&mut [[f64; 6]]));

impl Manipulator for Wrong {
    fn description(&self) -> &Description {
        Pps.description()
    }
    fn evaluate(
        &self,
        function: Function,
        arguments: &[&[f64]],
        results: &mut [&mut [f64]],
    ) -> Result<(), Error> {
        Pps.evaluate(function, arguments, results)?;
        if let (Function::ErrorJacobian, [_, columns]) = (function, results) {
            self.0(columns.as_chunks_mut().0);
        }
        Ok(())
    }
}

#[test]
fn wrong_robots_fail() {
    // Spin and pitch swapped: the most likely bug.
    let exchanged = OneByOne(Wrong(|columns| columns.chunks_exact_mut(6).for_each(|frame| frame.swap(3, 5))));
    assert!(matches!(all(&exchanged, 20), Err(Failure::Discrepant { law: "error Jacobian", .. })));
    // One entry in 10⁷, in the smallest rows.
    let slightly = OneByOne(Wrong(|columns| columns[15][3] *= 1.0 + 1e-7));
    assert!(matches!(all(&slightly, 20), Err(Failure::Discrepant { law: "error Jacobian", .. })));
    let slope = remainder_slope(&exchanged, 20).unwrap();
    assert!((slope.slope - 1.0).abs() < 0.1, "{slope:?}");
    let silent = OneByOne(Wrong(|columns| columns[7][1] = f64::NAN));
    assert!(matches!(all(&silent, 20), Err(Failure::NotFinite { method: "error_jacobian", .. })));
    let nan = error_jacobian(&silent, 20).unwrap();
    assert_eq!(nan.relative, f64::INFINITY);
}
