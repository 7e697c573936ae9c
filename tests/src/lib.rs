//! What crosses crates is tested in `tests/`. Here stands generated code as it is checked in, so that it is
//! compiled as users compile it, with warnings denied.
#![deny(warnings, missing_docs, clippy::all)]

/// Generated code.
pub mod golden {
    include!("../golden/pps.rs");
    include!("../golden/puma560.rs");
    include!("../golden/slide.rs");
}
