//! Common parts of the tests that cross crates, in `tests/`, and checked-in generated code, which
//! is compiled as users compile it, with warnings denied.
#![deny(warnings, missing_docs, clippy::all)]

pub mod abuse;
pub mod chains;
pub mod closed_machines;
pub mod erroneous;
pub mod frame_loop;
pub mod hostile;
pub mod languages;
pub mod mechanisms;
pub mod mutants;
pub mod needs;
pub mod platforms;
pub mod processes;
pub mod structured_text;
mod thorough;

pub use thorough::{is_tested, sample_size, thorough};

/// Specs in `specs/`.
pub mod specs {
    use std::path::PathBuf;

    /// Returns the path of a spec.
    pub fn path(name: &str) -> PathBuf {
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("specs").join(format!("{name}.toml"))
    }
}

/// Generated code.
pub mod golden {
    include!("../golden/long.rs");
    include!("../golden/measured.rs");
    include!("../golden/pps.rs");
    include!("../golden/puma560.rs");
    include!("../golden/self_.rs");
    include!("../golden/slide.rs");
}
