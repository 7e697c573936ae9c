abbe::include_manipulators!();

fn main() -> Result<(), abbe::Error> {
    let q = [300.0, 0.5, -0.8]; // mm and rad
    let (pose, error_jacobian) = arm::error_jacobian(&q, &arm::Parameters::NOMINAL)?;
    println!("{:?}, e_r of frame 2 moves it by {:?} mm/rad", pose.position(), &error_jacobian[6 + 4][..3]);
    Ok(())
}

mod wrist;

#[cfg(test)]
mod tests {
    abbe::test_manipulator!(arm_laws: crate::arm::Arm);

    #[test]
    fn it_runs() {
        super::main().unwrap();
        let heavy = crate::arm::Inputs { payload: 6.0 };
        assert!(matches!(
            crate::arm::generalized_errors(&[0.0; 3], &crate::arm::Parameters::NOMINAL, &heavy),
            Err(abbe::Error::OutOfRange { input: 0, .. })
        ));
    }
}
