//! How much tests do: this file is part of every crate whose tests ask.
#![allow(dead_code, unreachable_pub)]

/// Whether tests do all they can, with `ABBE_THOROUGH=1`: every shipped robot, draws by the million, long abuse.
///
/// Without, each of them looks at less, and a test that takes long as a whole is ignored (`needs::thorough`).
#[must_use]
pub fn thorough() -> bool {
    std::env::var_os("ABBE_THOROUGH").is_some_and(|value| value == "1")
}

/// Returns `full` in a thorough run, and a tenth of it otherwise.
#[must_use]
pub fn sample_size(full: usize) -> usize {
    if thorough() { full } else { full / 10 }
}

/// Whether a test looks at the shipped robot of this name: a machine tool, the paper's positioner with Euler rows and an arm
/// stand for all, which a thorough run looks at.
#[must_use]
pub fn is_tested(name: &str) -> bool {
    thorough() || ["machine3", "pps", "puma560"].contains(&name)
}
