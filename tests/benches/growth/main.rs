//! Growth of generated code with the length of the chain: operations of pose + `J_e`, time of each
//! stage, size of the file; then compile time, code size and speed of the module.
//!
//! `cargo bench -p abbe-tests --bench growth`; nothing is downloaded.

mod compiled;

use std::hint::black_box;
use std::time::Instant;

use abbe::Function;
use abbe_codegen::chain::Model;
use abbe_codegen::print;
use abbe_codegen::program::{Routines, straight_line};
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::general_chain;

/// Numbers of frames of the chains.
const LENGTHS: [usize; 4] = [6, 20, 50, 100];

/// Number of runs. The fastest counts, since disturbances only add time.
const RUNS: usize = 20;

/// Returns the shortest time in ms, and the result.
fn quickest<T>(work: impl Fn() -> T) -> (f64, T) {
    let runs = (0..RUNS).map(|_| {
        let start = Instant::now();
        let result = black_box(work());
        (start.elapsed().as_secs_f64() * 1e3, result)
    });
    runs.min_by(|a, b| a.0.total_cmp(&b.0)).expect("some runs")
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "{:<12} {:>6} {:>7} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "", "frames", "mul", "add", "nodes ms", "steps ms", "text ms", "all ms", "kB"
    );
    let chains = LENGTHS.map(|frames| ("general", general_chain(frames)));
    let shipped = SHIPPED.iter().map(|shipped| (shipped.name, shipped.spec.to_owned()));
    for (name, text) in chains.into_iter().chain(shipped) {
        let read = || {
            let spec = Spec::parse(name, &text).expect("a spec without mistakes");
            let model = Model::new(&spec);
            (spec, model)
        };
        let (nodes, (spec, model)) = quickest(read);
        let (steps, routines) = quickest(|| Routines::new(&spec, &model));
        let (written, module) = quickest(|| print::rust::module(&spec, &model, &routines));
        let count = straight_line(Function::ErrorJacobian, &model).operations();
        println!(
            "{name:<12} {:>6} {:>7} {:>7} {nodes:>9.2} {steps:>9.2} {written:>9.2} {:>9.2} {:>9.1}",
            spec.frames.len(),
            count.mul,
            count.add,
            nodes + steps + written,
            module.len() as f64 / 1e3
        );
    }
    compiled::report(&LENGTHS)
}
