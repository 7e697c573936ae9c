//! Time of the generated compensator of the paper's positioner: the shortest of many runs.
//!
//! `cargo bench -p abbe-tests --bench compensator`

use std::hint::black_box;
use std::time::Instant;

use abbe::compensator::Cycle;
use abbe_manipulators::pps::{Inputs, Parameters, VARIABLES, compensated, compensator_step};

const RUNS: u32 = 2000;
const CALLS: u32 = 100;

fn quickest(name: &str, mut call: impl FnMut(&[f64; VARIABLES]) -> f64) {
    let run = |run| {
        let q = [1128.0 + 0.1 * f64::from(run), 280.0, 300.0, 0.5, 0.01, -0.01];
        let start = Instant::now();
        (0..CALLS).for_each(|_| {
            black_box(call(black_box(&q)));
        });
        start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
    };
    println!("{name}: {:.0} ns", (0..RUNS).map(run).fold(f64::INFINITY, f64::min));
}

fn main() {
    let (s, u) = (Parameters::NOMINAL, Inputs::NOMINAL);
    quickest("one step: real pose and J_q", |q| {
        compensator_step(q, &s, &u).map_or(f64::NAN, |(pose, _)| pose.0[3][0])
    });
    quickest("compensated", |q| {
        compensated(q, &s, &u, &Cycle::UNBOUNDED).map_or(f64::NAN, |found| found.q[0])
    });
}
