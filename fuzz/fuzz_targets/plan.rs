//! Arbitrary bytes, read as a plan for a shipped machine.
#![no_main]

mod told;

use std::sync::LazyLock;

use abbe_metrology::plan::Sets;
use abbe_study::Machine;
use libfuzzer_sys::fuzz_target;

static MACHINE: LazyLock<Machine> = LazyLock::new(|| Machine::find("machine3").expect("it is shipped"));

fuzz_target!(|bytes: &[u8]| {
    let file = std::env::temp_dir().join(format!("abbe-fuzzed-plan-{}.toml", std::process::id()));
    std::fs::write(&file, bytes).expect("temporary files can be written");
    if let Err(refused) = Sets::find(&file, &MACHINE.spec) {
        told::told(&refused);
    }
});
