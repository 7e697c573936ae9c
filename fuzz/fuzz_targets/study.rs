//! Arbitrary bytes, read as a study of a shipped machine.
#![no_main]

mod told;

use std::sync::LazyLock;

use abbe_spec::document::Document;
use abbe_study::{Machine, Study};
use libfuzzer_sys::fuzz_target;

static MACHINE: LazyLock<Machine> = LazyLock::new(|| Machine::find("machine3").expect("it is shipped"));

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Err(refused) = Study::read(Document::new("fuzzed.toml", text), &MACHINE.spec) {
        told::told(&refused);
    }
});
