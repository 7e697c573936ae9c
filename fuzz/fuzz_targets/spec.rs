//! Arbitrary bytes, read as a spec. Valid specs are generated; invalid ones must have complete
//! diagnostics.
#![no_main]

mod told;

use abbe_codegen::print::{Language, Real};
use abbe_spec::Spec;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Spec::parse("fuzzed.toml", text) {
        Ok(spec) => {
            let all = Language::ALL.into_iter().chain([Language::C(Real::Float)]);
            all.for_each(|language| drop((language.lost(&spec), language.files(&spec))));
        }
        Err(refused) => told::told(&refused),
    }
});
