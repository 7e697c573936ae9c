//! Another robot, defined by the macro without a build script.

abbe_macro::manipulator!("robots/wrist.toml");

#[cfg(test)]
mod tests {
    use super::wrist::{Parameters, Wrist, error_jacobian};

    abbe::test_manipulator!(laws: Wrist);

    #[test]
    fn roll_at_a_right_angle_is_an_error() {
        let upright = [0.1, std::f64::consts::FRAC_PI_2, 0.0];
        let error = error_jacobian(&upright, &Parameters::NOMINAL).unwrap_err();
        assert!(matches!(error, abbe::Error::EulerSingularity { .. }));
    }
}
