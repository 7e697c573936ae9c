//! How generation grows with the length of the chain: operations of pose + `J_e`, time, size of the file.
//!
//! `cargo run --release -p abbe-tests --example growth`

use std::time::Instant;

use abbe_codegen::chain::Model;
use abbe_codegen::program::FunctionKind;
use abbe_codegen::{emit, spec::Spec};
use abbe_manipulators::SHIPPED;
use abbe_tests::chains::general_chain;

fn main() {
    println!(
        "{:<12} {:>6} {:>7} {:>7} {:>9} {:>9} {:>8}",
        "", "frames", "mul", "add", "J_e ms", "file ms", "kB"
    );
    let chains = [6, 20, 50, 100].map(|frames| ("general", general_chain(frames)));
    let shipped = SHIPPED.iter().map(|shipped| (shipped.name, shipped.spec.to_owned()));
    for (name, text) in chains.into_iter().chain(shipped) {
        let start = Instant::now();
        let spec = Spec::parse(name, &text).expect("a spec without mistakes");
        let count = FunctionKind::ErrorJacobian.program(&Model::new(&spec)).operations();
        let jacobian = start.elapsed().as_secs_f64() * 1e3;
        let start = Instant::now();
        let bytes = emit::rust(&spec).len() as f64;
        let file = start.elapsed().as_secs_f64() * 1e3;
        let frames = spec.frames.len();
        println!(
            "{name:<12} {frames:>6} {:>7} {:>7} {jacobian:>9.2} {file:>9.2} {:>8.1}",
            count.mul,
            count.add,
            bytes / 1e3
        );
    }
}
