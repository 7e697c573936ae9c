//! Any bytes at all: read as a spec, generated if it is one, shown what is wrong if not.
#![no_main]

mod told;

use abbe_codegen::print::Language;
use abbe_codegen::spec::Spec;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Spec::parse("fuzzed.toml", text) {
        Ok(spec) => Language::ALL.into_iter().for_each(|language| drop(language.files(&spec))),
        Err(refused) => told::told(&refused),
    }
});
