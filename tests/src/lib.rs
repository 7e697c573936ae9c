//! What crosses crates is tested in `tests/`. Here stands what several of these tests need, and generated code as
//! it is checked in, so that it is compiled as users compile it, with warnings denied.
#![deny(warnings, missing_docs, clippy::all)]

pub mod chains;
pub mod frame_loop;
pub mod needs;

/// Generated code.
pub mod golden {
    include!("../golden/long.rs");
    include!("../golden/pps.rs");
    include!("../golden/puma560.rs");
    include!("../golden/self_.rs");
    include!("../golden/slide.rs");
}
