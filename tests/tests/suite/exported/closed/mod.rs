//! Machines with closed loops: `genhexkins` covers six legs for LinuxCNC, `frames` their frames as
//! a URDF with a file of the loops.

mod frames;
mod genhexkins;

use abbe_spec::Spec;
use abbe_study::Machine;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Returns the text of a shipped mechanism.
fn shipped(name: &str) -> String {
    let path = format!("{}/../manipulators/mechanisms/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

fn machine(text: &str) -> Machine {
    let spec = Spec::parse("machine.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    Machine::of_spec(spec, "machine.toml")
}

/// Returns numbers from −1 to 1.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    move || random.random_range(-1.0..1.0)
}
