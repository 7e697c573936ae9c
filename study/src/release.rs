//! Version of abbe in pages and records, with the commit that it was built from.

use std::sync::OnceLock;

static VERSION: OnceLock<&str> = OnceLock::new();

/// Sets the version that a front end was built as, such as `0.3.0 (0123456789ab)`. The first call
/// counts.
///
/// Only front ends know the commit: crates below them would be compiled again with each one.
pub fn set_version(version: &'static str) {
    VERSION.get_or_init(|| version);
}

/// Returns the version, with the commit if a front end has set it.
pub fn version() -> &'static str {
    VERSION.get().copied().unwrap_or(env!("CARGO_PKG_VERSION"))
}
