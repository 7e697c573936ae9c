//! Duration of `error_jacobian` for many configurations in Rust, with results in NumPy's layout;
//! `benches/python` compares it with Python.
//!
//! `batch COUNT ROUNDS` prints, line by line, nanoseconds per configuration: interpreted, then
//! compiled.

use std::hint::black_box;
use std::time::Instant;

use abbe::lanes::{Batches, ErrorJacobian, InstructionSet, Tiles, run};
use abbe::{Description, Error, Function, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_manipulators::ur5;
use abbe_spec::Spec;

/// Number of configurations per tile, as in the Python package.
const TILE: usize = 64;

fn main() -> Result<(), Error> {
    let mut given = std::env::args().skip(1).filter_map(|argument| argument.parse().ok());
    let (count, rounds) = (given.next().unwrap_or(1_000_000), given.next().unwrap_or(5));
    let shipped = abbe_manipulators::SHIPPED.iter().find(|shipped| shipped.name == "ur5");
    let spec = shipped.and_then(|shipped| Spec::parse("ur5", shipped.spec).ok()).expect("ur5 is shipped");
    let interpreter = Interpreter::new(spec);
    for _ in 0..rounds {
        let description = interpreter.description();
        let interpreted =
            measured(description, count, |q, found| interpreter.batch(Function::ErrorJacobian, q, found))?;
        let compiled = measured(description, count, |q, found| run(&ur5::Ur5, ErrorJacobian, q, found))?;
        println!("{interpreted:.2} {compiled:.2}");
    }
    Ok(())
}

/// Measures nanoseconds per configuration.
fn measured(
    description: &Description,
    count: usize,
    evaluate: impl Fn(&Tiles, &mut Tiles) -> Result<(), Error>,
) -> Result<f64, Error> {
    let nq = description.variables.len();
    let columns = 6 * description.frames.len();
    let set = InstructionSet::best();
    let signature = Function::ErrorJacobian.signature();
    let mut q = Tiles::new(set, signature.arguments_len(description), TILE);
    let mut found = Tiles::new(set, signature.results_len(description), TILE);
    // Pseudorandom angles between -3 and 3, the same in every run.
    let mut state = 1_u64;
    let mut angle = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 6.0 - 3.0
    };
    let joints: Vec<f64> = (0..count * nq).map(|_| angle()).collect();
    let rows: Vec<usize> = (0..nq).collect();
    // Row-major, after the pose.
    let order: Vec<usize> = (0..6).flat_map(|i| (0..columns).map(move |j| 12 + 6 * j + i)).collect();
    let begin = Instant::now();
    let mut jacobians = Vec::with_capacity(count * 6 * columns);
    for chunk in joints.chunks(TILE * nq) {
        let size = chunk.len() / nq;
        q.resize(size);
        found.resize(size);
        let mut values = chunk.iter().copied();
        q.set_each(&rows, 0, size, |_| values.next().unwrap_or_default());
        evaluate(&q, &mut found)?;
        let first = jacobians.len();
        jacobians.resize(first + size * 6 * columns, 0.0);
        found.copy_each(&order, 0, &mut jacobians[first..]);
    }
    let taken = begin.elapsed().as_nanos() as f64 / count as f64;
    black_box(&jacobians);
    Ok(taken)
}
