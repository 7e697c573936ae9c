//! Tests of `target_frame.rs`.

use super::*;

/// Checks the covariance of two targets of rank one, `v vᵀ`: in the frame of the flange it is
/// that of the turned vectors. The tool turns by 90 degrees about z and is 50 mm away.
#[test]
fn covariances_turn_with_the_tool() {
    let tool = Pose([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [50.0, 0.0, 0.0]]);
    let frame = TargetFrame { is_stated: true, tool: Some(tool) };
    let outer = |v: [f64; 6]| v.map(|a| v.map(|b| a * b).to_vec()).to_vec();
    let found = frame.covariance_from_tool(&outer([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    assert_eq!(found, outer([-2.0, 1.0, 3.0, -5.0, 4.0, 6.0]));
    assert_eq!(frame.placed_in_frame([1.0, 2.0, 3.0]), [48.0, 1.0, 3.0]);
    assert_eq!(frame.to_tool([48.0, 1.0, 3.0]), [1.0, 2.0, 3.0]);
}
