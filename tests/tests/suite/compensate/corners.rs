//! Compensation at singular poses, at which tables of corrections have many of their nodes.

use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

use abbe::analysis::{Goal, compensated, sampling};
use abbe::compensator::{Status, norms};
use abbe::{Description, Error, Function, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_tests::thorough;

use super::{with_errors, within};

/// Counts the calls of a manipulator.
struct Counted<'a>(&'a Interpreter, AtomicUsize);

impl Manipulator for Counted<'_> {
    fn description(&self) -> &Description {
        self.0.description()
    }

    fn evaluate(
        &self,
        function: Function,
        arguments: &[&[f64]],
        results: &mut [&mut [f64]],
    ) -> Result<(), Error> {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.evaluate(function, arguments, results)
    }
}

/// Holds the number of evaluations for each node of a grid of three values of each joint of the
/// UR5, where the wrist and the stretched arm are singular: searches make progress there. All
/// reach the tool point.
#[test]
fn searches_at_singular_corners_make_progress() {
    let robot = Interpreter::new(with_errors("ur5"));
    let counted = Counted(&robot, AtomicUsize::new(0));
    let description = robot.description();
    let (s, u) = (sampling::nominal_parameters(description), sampling::nominal_inputs(description));
    let every = if thorough() { 1 } else { 13 };
    let (mut nodes, mut moving, mut largest) = (0, 0, 0.0_f64);
    for node in (0..729_usize).step_by(every) {
        let q: Vec<f64> = (0..6).map(|j: u32| [-PI, 0.0, PI][node / 3_usize.pow(j) % 3]).collect();
        let found = compensated(&counted, Goal::default(), &q, &s, &u).unwrap();
        let (length, angle) = norms(&found.after);
        assert!(within(&robot, &found.q), "{q:?}");
        assert!(length * description.length.in_metres() < 1e-9, "{q:?}: {length}");
        largest = largest.max(angle);
        moving += usize::from(found.status == Status::NotConverged);
        nodes += 1;
    }
    let each = counted.1.into_inner() / nodes;
    println!(
        "{each} evaluations for each of {nodes} nodes, {moving} not converged, at most {largest:.2e} rad left"
    );
    assert!(each < 1500 && 20 * moving <= nodes, "{each} {moving}");
}
