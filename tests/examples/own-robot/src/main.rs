//! Two robots of one's own: `gantry` by the build script, `wrist` by the macro.

abbe::include_manipulators!();
abbe_macro::manipulator!("robots/wrist.toml");

fn main() -> Result<(), abbe::Error> {
    let q = [400.0, -250.0, 0.5];
    let s = gantry::Parameters { spindle: 200.0, ..gantry::Parameters::NOMINAL };
    let warm = gantry::Inputs { temperature: 5.0 };
    let (pose, error_jacobian) = gantry::error_jacobian(&q, &s)?;
    let errors = gantry::generalized_errors(&q, &s, &warm)?;
    // ΔX = J_e ε, rows 1 to 3.
    let shift: [f64; 3] = std::array::from_fn(|row| {
        error_jacobian.iter().zip(errors.as_flattened()).map(|(column, error)| column[row] * error).sum()
    });
    println!("tool point {:?} mm, moved by {shift:?} mm", pose.position());

    match wrist::error_jacobian(&[0.1, std::f64::consts::FRAC_PI_2, 0.0], &wrist::Parameters::NOMINAL) {
        Ok(_) => println!("no singularity"),
        Err(error) => println!("wrist with roll at 90°: {error}"),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    abbe::test_manipulator!(gantry_laws: crate::gantry::Gantry);
    abbe::test_manipulator!(wrist_laws: crate::wrist::Wrist);

    #[test]
    fn it_runs() {
        super::main().unwrap();
        let hot = crate::gantry::Inputs { temperature: 20.0 };
        assert!(matches!(
            crate::gantry::generalized_errors(&[0.0; 3], &crate::gantry::Parameters::NOMINAL, &hot),
            Err(abbe::Error::OutOfRange { input: 0, .. })
        ));
    }
}
