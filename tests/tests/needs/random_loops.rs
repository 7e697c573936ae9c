//! Random machines with loops.

use abbe::analysis::sampling::{self, arm_length, halton, nominal_parameters};
use abbe::{Error, Function, Manipulator, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::languages::{arguments, compensated, configurations, given_arrays};
use abbe_tests::mechanisms::Mechanism;
use abbe_tests::platforms::{BODIES, platform};
use abbe_tests::thorough;

/// Returns random machines with loops that move the tool, each with configurations near home at
/// which every function is finite: mechanisms and platforms in turn, 500 in a thorough run, and a
/// few of them otherwise.
pub(crate) fn random_loops(few: usize) -> impl Iterator<Item = (Spec, Vec<Vec<f64>>)> {
    let mechanisms = (0..).map(|seed| Mechanism::new(seed).text);
    let platforms = (0..).map(|seed| platform(&BODIES[seed as usize % BODIES.len()], seed).0);
    let both = mechanisms.zip(platforms).flat_map(|(a, b)| [a, b]);
    let machines = both.filter_map(|text| {
        let spec = Spec::parse("machine.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let robot = Interpreter::new(spec.clone());
        let (description, home) = (robot.description(), sampling::home(robot.description()));
        let scale = arm_length(&robot, &nominal_parameters(description)).ok()?;
        let mut given = configurations(&robot, 40);
        for (index, given) in given.iter_mut().enumerate() {
            for (j, (home, variable)) in home.iter().zip(&*description.variables).enumerate() {
                let unit = if variable.kind == VariableKind::Revolute { 1.0 } else { scale };
                given[j] = home + 0.05 * unit * (2.0 * halton(index + 1, j) - 1.0);
            }
        }
        // Corrections stay near, where the loops close as well.
        let mut first = 0;
        for array in given_arrays() {
            let range = first..first + array.len(description);
            if ["change", "largest"].contains(&array.name) {
                given.iter_mut().for_each(|given| given[range.clone()].fill(1e-3));
            }
            first = range.end;
        }
        let mut columns = vec![[0.0; 6]; home.len()];
        robot.joint_jacobian(&home, &nominal_parameters(description), &mut columns).ok()?;
        let moves = columns.as_flattened().iter().any(|entry| entry.abs() > 1e-6);
        let evaluate = |function: Function, given: &[f64]| {
            let found = robot.evaluate_unchecked(function, given)?;
            if found.iter().all(|value| value.is_finite()) { Ok(found) } else { Err(Error::NotClosed) }
        };
        given.retain(|given| {
            let closes = |function: Function| {
                evaluate(function, &arguments(&robot, function.signature(), given)).is_ok()
            };
            Function::all(description).all(closes) && compensated(&robot, evaluate, given).is_ok()
        });
        given.truncate(10);
        (moves && given.len() == 10).then_some((spec, given))
    });
    machines.take(if thorough() { 500 } else { few })
}
