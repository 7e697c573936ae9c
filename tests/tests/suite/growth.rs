//! Work grows linearly with the length of a chain and the number of parameters: counted, not timed.

use std::sync::atomic::{AtomicUsize, Ordering};

use abbe::analysis::{Measurement, Parts, Workspace, identifiable_in_parts, random_joint_samples};
use abbe::laws::{self, DERIVATIVE_TOLERANCE};
use abbe::{Description, Error, Function, Manipulator};
use abbe_codegen::chain::Model;
use abbe_codegen::program::Routines;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::chains::{many_parameters, revolute_chain};

/// Manipulator that counts its transforms, and whose Jacobians by joints and parameters may have a
/// wrong entry.
struct Counted {
    robot: Interpreter,
    transforms: AtomicUsize,
    off: Option<(usize, f64)>,
}

impl Counted {
    fn new(text: &str) -> Self {
        let spec = Spec::parse("chain.toml", text).unwrap_or_else(|refused| panic!("{refused}"));
        Self { robot: Interpreter::new(spec), transforms: AtomicUsize::new(0), off: None }
    }

    /// Returns the number of evaluations of the transforms, and the result.
    fn transforms_of<T>(&self, run: impl FnOnce(&Self) -> T) -> (usize, T) {
        let before = self.transforms.load(Ordering::Relaxed);
        let result = run(self);
        (self.transforms.load(Ordering::Relaxed) - before, result)
    }
}

impl Manipulator for Counted {
    fn description(&self) -> &Description {
        self.robot.description()
    }
    fn evaluate(
        &self,
        function: Function,
        arguments: &[&[f64]],
        results: &mut [&mut [f64]],
    ) -> Result<(), Error> {
        self.transforms.fetch_add(usize::from(function == Function::Transforms), Ordering::Relaxed);
        self.robot.evaluate(function, arguments, results)?;
        if let (Function::JointJacobian | Function::ParameterJacobian, [_, columns], Some((column, by))) =
            (function, results, self.off)
        {
            columns[6 * column + 1] += by;
        }
        Ok(())
    }
}

const SAMPLES: usize = 3;

/// Checks that the number of evaluations hardly depends on the chain, which affects how often steps
/// are halved.
fn as_often(short: usize, long: usize) {
    assert!(5 * long <= 6 * short, "{short} transforms, and {long} of the longer one");
}

#[test]
fn laws_ask_as_often_however_long_the_chain_is() {
    let of_joints = [80, 160].map(|frames| {
        let robot = Counted::new(&revolute_chain(frames));
        // At home and beside it for the arm length, and once at each sample.
        let (asked, found) = robot.transforms_of(|robot| laws::error_jacobian(robot, SAMPLES).unwrap());
        assert_eq!(asked, 2 + SAMPLES);
        assert!(found.relative < DERIVATIVE_TOLERANCE, "{found:?}");
        let (asked, found) = robot.transforms_of(|robot| laws::joint_jacobian(robot, SAMPLES).unwrap());
        assert!(found.relative < DERIVATIVE_TOLERANCE, "{found:?}");
        asked
    });
    as_often(of_joints[0], of_joints[1]);
    let of_parameters = [100, 1000].map(|parameters| {
        let robot = Counted::new(&many_parameters(parameters));
        let (asked, found) = robot.transforms_of(|robot| laws::parameter_jacobian(robot, SAMPLES).unwrap());
        assert!(found.relative < DERIVATIVE_TOLERANCE, "{found:?}");
        asked
    });
    as_often(of_parameters[0], of_parameters[1]);
}

/// Checks that derivatives along sums of columns detect any wrong column.
#[test]
fn laws_of_many_columns_see_each_of_them() {
    for column in [0, 59, 60, 77, 149] {
        let mut robot = Counted::new(&revolute_chain(150));
        robot.off = Some((column, 1e-5));
        let found = laws::joint_jacobian(&robot, SAMPLES).unwrap();
        assert!(found.relative > DERIVATIVE_TOLERANCE, "{column}: {found:?}");
        let mut robot = Counted::new(&many_parameters(150));
        robot.off = Some((column, 1e-5));
        let found = laws::parameter_jacobian(&robot, SAMPLES).unwrap();
        assert!(found.relative > DERIVATIVE_TOLERANCE, "{column}: {found:?}");
    }
}

#[test]
fn what_can_be_identified_takes_each_configuration_once() {
    for frames in [50, 100] {
        let robot = Counted::new(&revolute_chain(frames));
        let all: Vec<usize> = (0..frames).collect();
        let configurations = random_joint_samples(&robot, &all, 60, 1).unwrap().reached();
        let parts = Parts::new(&robot.robot.spec().variables_of_transforms());
        assert_eq!((parts.count(), parts.longest()), (frames + 1, 1));
        let (asked, _) = robot.transforms_of(|robot| {
            identifiable_in_parts(robot, &parts, &configurations, Measurement::Pose, true).unwrap()
        });
        assert_eq!(asked, 60);
    }
}

/// Checks that twice the frames, and twice the parameters, need little more than twice the work.
#[test]
fn models_and_programs_grow_with_the_chain() {
    let sizes = |text: &str| -> [usize; 2] {
        let spec = Spec::parse("chain.toml", text).unwrap_or_else(|refused| panic!("{refused}"));
        let model = Model::new(&spec);
        let routines = Routines::new(&spec, &model);
        let operations = routines.list.iter().map(|routine| routine.operations.weight()).sum();
        [model.graph.len(), operations]
    };
    for make in [revolute_chain as fn(usize) -> String, many_parameters] {
        let [once, twice] = [200, 400].map(|count| sizes(&make(count)));
        for (once, twice) in once.into_iter().zip(twice) {
            assert!(twice as f64 <= 2.1 * once as f64, "{once}, then {twice}");
        }
    }
}
