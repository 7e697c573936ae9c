//! Instruction counts, which do not depend on the load of the machine: generated functions (`long`
//! is a chain of 40 frames), an interpreted batch, and generation. `tests/tests/instructions.rs`
//! compares them with `tests/golden/instructions.txt`.
//!
//! `cargo bench -p abbe-instructions --bench instructions --features instructions`, with valgrind
//! and the gungraun-runner of the same version as the crate.
#![allow(missing_docs)] // of what gungraun's macros make

use std::hint::black_box;

use abbe::lanes::{Batches, InstructionSet, Tiles};
use abbe::{Function, Manipulator};
use abbe_codegen::print;
use abbe_interpreter::Interpreter;
use abbe_manipulators::{self as shipped, SHIPPED};
use abbe_spec::Spec;
use abbe_tests::chains::elastic_links;
use abbe_tests::golden;
use gungraun::{Callgrind, LibraryBenchmarkConfig, library_benchmark, library_benchmark_group, main};

/// Work that is counted. Its preparation is not.
type Work = Box<dyn FnMut()>;

/// Number of configurations of the batch.
const COUNT: usize = 16;

macro_rules! functions {
    ($($path:ident::$module:ident),+) => {
        /// Functions of a generated module at one configuration.
        mod functions {
            use super::{Function, Work, black_box};
            $(pub(super) fn $module(function: Function) -> Work {
                use super::$path::$module::{
                    DESCRIPTION, DISTINCT, ERRORS, FRAMES, Parameters, VARIABLES, raw,
                };
                let q: [f64; VARIABLES] = core::array::from_fn(|i| DESCRIPTION.variables[i].home + 0.1);
                let s = Parameters::NOMINAL.to_array();
                let errors = [[1e-3; 6]; FRAMES];
                let (mut pose, mut columns) = ([[0.0; 3]; 4], [[0.0; 6]; ERRORS]);
                let mut joints = [[0.0; 6]; VARIABLES];
                let mut distinct = [[[0.0; 3]; DISTINCT]; FRAMES];
                let (mut shift, mut covariance) = ([0.0; 6], [[0.0; 6]; 6]);
                match function {
                    Function::Pose => Box::new(move || {
                        raw::pose(black_box(&q), &s, &mut pose);
                        black_box(&mut pose);
                    }),
                    Function::ErrorJacobian => Box::new(move || {
                        let _ = black_box(raw::error_jacobian(black_box(&q), &s, &mut pose, &mut columns));
                        black_box((&mut pose, &mut columns));
                    }),
                    Function::JointJacobian => Box::new(move || {
                        let _ = black_box(raw::joint_jacobian(black_box(&q), &s, &mut pose, &mut joints));
                        black_box((&mut pose, &mut joints));
                    }),
                    Function::ErrorJacobianDistinct => Box::new(move || {
                        let _ = black_box(raw::error_jacobian_distinct(black_box(&q), &s, &mut pose, &mut distinct));
                        black_box((&mut pose, &mut distinct));
                    }),
                    Function::Displacement => Box::new(move || {
                        let _ = black_box(raw::displacement(black_box(&q), &s, black_box(&errors), &mut shift));
                        black_box(&mut shift);
                    }),
                    Function::Covariance => Box::new(move || {
                        let _ = black_box(raw::covariance(black_box(&q), &s, black_box(&errors), &mut covariance));
                        black_box(&mut covariance);
                    }),
                    other => panic!("{other:?} is not counted"),
                }
            })+
        }
    };
}
functions!(shipped::iiwa, golden::long, shipped::machine3, shipped::pps, shipped::puma560);

fn spec(name: &str) -> Spec {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).expect("a shipped robot");
    Spec::parse(name, shipped.spec).expect("shipped specs are right")
}

/// Returns a batch by the interpreter, on the baseline instruction set.
fn interpreter(name: &str, function: Function) -> Work {
    let robot = Interpreter::new(spec(name));
    let (description, set) = (robot.description(), InstructionSet::BASELINE);
    let mut arguments = Tiles::new(set, function.signature().arguments_len(description), COUNT);
    let mut results = Tiles::new(set, function.signature().results_len(description), COUNT);
    (0..arguments.rows()).for_each(|row| arguments.fill_row(row, 0.1));
    // The program is created on first use, which is not counted.
    robot.batch(function, &arguments, &mut results).expect("the right counts");
    Box::new(move || robot.batch(function, black_box(&arguments), &mut results).expect("the right counts"))
}

/// Returns the generation of the file of a spec.
fn generation(name: &str) -> Work {
    let spec = spec(name);
    Box::new(move || drop(black_box(print::rust(black_box(&spec)))))
}

/// Returns the generation of the file of an arm with a compliance at every link, whose sources
/// share many subexpressions.
fn generation_of_elastic_links(name: &str) -> Work {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).expect("a shipped robot");
    let text = elastic_links(shipped.spec);
    let spec = Spec::parse(name, &text).expect("a right spec");
    Box::new(move || drop(black_box(print::rust(black_box(&spec)))))
}

macro_rules! counted {
    ($($module:ident),+) => {$(
        #[library_benchmark]
        #[bench::pose(functions::$module(Function::Pose))]
        #[bench::error_jacobian(functions::$module(Function::ErrorJacobian))]
        #[bench::error_jacobian_distinct(functions::$module(Function::ErrorJacobianDistinct))]
        #[bench::joint_jacobian(functions::$module(Function::JointJacobian))]
        #[bench::displacement(functions::$module(Function::Displacement))]
        #[bench::covariance(functions::$module(Function::Covariance))]
        fn $module(mut work: Work) -> Work {
            work();
            work
        }
    )+};
}
counted!(iiwa, long, machine3, pps, puma560);

#[library_benchmark]
#[bench::interpreted_error_jacobian_distinct(interpreter("puma560", Function::ErrorJacobianDistinct))]
#[bench::interpreted_displacement(interpreter("puma560", Function::Displacement))]
#[bench::generation(generation("puma560"))]
#[bench::generation_general6r(generation("general6r"))]
#[bench::generation_of_elastic_links(generation_of_elastic_links("wam"))]
fn whole(mut work: Work) -> Work {
    work();
    work
}

library_benchmark_group!(name = counts, benchmarks = [iiwa, long, machine3, pps, puma560, whole]);
main!(
    config = LibraryBenchmarkConfig::default().tool(Callgrind::with_args(["--cache-sim=no"])),
    library_benchmark_groups = counts
);
