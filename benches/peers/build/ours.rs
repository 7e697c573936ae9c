//! Our own C: what `abbe generate --lang c` writes.

use std::fs;
use std::path::{Path, PathBuf};

use abbe_codegen::print::{Language, Real};
use abbe_spec::Spec;

/// What the names of the functions end with that a compiler may contract.
pub const CONTRACTED: &str = "_contracted";

/// Whether `a * b + c` may be rounded once; then the bits are not those of the Rust code.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    Contracted,
    AsWritten,
}

/// Writes header and source of a spec, and says where the source is.
pub fn write(spec: &Spec, rounding: Rounding, out: &Path) -> PathBuf {
    let mut spec = spec.clone();
    if rounding == Rounding::Contracted {
        spec.name += CONTRACTED;
    }
    for file in Language::C(Real::Double).files(&spec) {
        fs::write(out.join(&file.name), &file.text).expect("our code");
    }
    out.join(format!("{}.c", spec.name))
}
