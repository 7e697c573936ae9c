//! Arbitrary bytes, read as a map of a shipped machine.
#![no_main]

mod told;

use std::sync::LazyLock;

use abbe_metrology::data::Map;
use abbe_study::Machine;
use libfuzzer_sys::fuzz_target;

static MACHINE: LazyLock<Machine> = LazyLock::new(|| Machine::find("machine3").expect("it is shipped"));

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Err(refused) = Map::parse("fuzzed.toml", text, &MACHINE.spec) {
        told::told(&refused);
    }
});
