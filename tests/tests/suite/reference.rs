//! `J_e` compared with differences of the exact chain from an independent Python program, which
//! restates the rotation axes of the generalized errors (`tests/reference/chain.py`).

use abbe::{Manipulator, Orientation};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use serde_json::Value;

#[test]
fn error_jacobians_are_those_of_an_independent_chain() {
    let cases: Value = serde_json::from_str(include_str!("../../reference/error_jacobians.json")).unwrap();
    let cases = cases.as_array().unwrap();
    assert_eq!(cases.len(), 5);
    for case in cases {
        let name = case["manipulator"].as_str().unwrap();
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
        let mut spec = Spec::parse(&format!("{name}.toml"), shipped.spec).unwrap();
        spec.orientation = Orientation::RotationVector;
        let robot = Interpreter::new(spec);
        let s: Vec<f64> = robot.description().parameters.iter().map(|parameter| parameter.nominal).collect();
        let q = numbers(&case["q"]);
        let expected: Vec<Vec<f64>> =
            case["error_jacobian"].as_array().unwrap().iter().map(numbers).collect();
        let mut columns = vec![[0.0; 6]; expected.len()];
        robot.error_jacobian(&q, &s, &mut columns).unwrap();
        for (k, (column, expected)) in columns.iter().zip(&expected).enumerate() {
            for (row, (entry, expected)) in column.iter().zip(expected).enumerate() {
                let difference = (entry - expected).abs();
                // Lengths in mm are up to thousands.
                assert!(
                    difference <= 1e-8 * expected.abs().max(1.0),
                    "{name} row {row} column {k}: {entry} {expected}"
                );
            }
        }
    }
}

fn numbers(values: &Value) -> Vec<f64> {
    values.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}
