//! Any bytes at all: read as a spec, generated if it is one, shown what is wrong if not.
#![no_main]

use abbe_codegen::{print, spec::Spec};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Spec::parse("fuzzed.toml", text) {
        Ok(spec) => drop(print::rust(&spec)),
        Err(diagnostics) => assert!(!diagnostics.to_string().is_empty()),
    }
});
