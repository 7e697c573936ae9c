//! Extent of the tests: this file is included in every crate whose tests depend on it.
#![allow(dead_code, unreachable_pub)]

/// Returns whether this is a thorough run, with `ABBE_THOROUGH=1`: every shipped robot, draws by
/// the million, long fuzzing.
///
/// An ordinary run reduces each test, and ignores tests that are long as a whole
/// (`needs::thorough`).
#[must_use]
pub fn thorough() -> bool {
    std::env::var_os("ABBE_THOROUGH").is_some_and(|value| value == "1")
}

/// Returns `full` in a thorough run, and a tenth of it otherwise.
#[must_use]
pub fn sample_size(full: usize) -> usize {
    if thorough() { full } else { full / 10 }
}

/// Returns whether to test the shipped robot of this name. An ordinary run covers a machine tool,
/// the paper's positioner with Euler rows, and an arm; a thorough run covers all.
#[must_use]
pub fn is_tested(name: &str) -> bool {
    thorough() || ["machine3", "pps", "puma560"].contains(&name)
}
