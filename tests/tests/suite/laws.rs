//! Every shipped manipulator, generated and interpreted, obeys the laws: `J_e` against central
//! differences of the exact chain with exact rotations (1e-8 relative, 200 configurations), the
//! first-order remainder with slope 2 ± 0.05, `J_q`, `∂X_T/∂s`, and the contract of the trait.

use abbe::laws::{SAMPLES, all};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;

#[test]
fn generated() {
    for shipped in SHIPPED {
        all(shipped.compiled, SAMPLES).unwrap_or_else(|failure| panic!("{}: {failure}", shipped.name));
    }
}

#[test]
fn interpreted() {
    for shipped in SHIPPED {
        let spec = Spec::parse(shipped.name, shipped.spec).unwrap();
        all(&Interpreter::new(spec.clone()), SAMPLES)
            .unwrap_or_else(|failure| panic!("{}: {failure}", shipped.name));
    }
}

#[test]
fn euler_rows_of_every_manipulator() {
    for shipped in SHIPPED {
        for orientation in ["euler-yzx", "iec-61217"] {
            let text = with_orientation(shipped.spec, orientation);
            let spec = Spec::parse(shipped.name, &text).unwrap();
            all(&Interpreter::new(spec.clone()), 60)
                .unwrap_or_else(|failure| panic!("{}, {orientation}: {failure}", shipped.name));
        }
    }
}

/// Returns the text of a spec with another orientation.
fn with_orientation(spec: &str, orientation: &str) -> String {
    let without: Vec<&str> = spec.lines().filter(|line| !line.starts_with("orientation")).collect();
    without.join("\n").replacen(
        "[manipulator]",
        &format!("[manipulator]\norientation = \"{orientation}\""),
        1,
    )
}
