//! Our own C code, as `abbe generate --lang c` writes it.

use std::fs;
use std::path::{Path, PathBuf};

use abbe_codegen::print::{Language, Real};
use abbe_spec::Spec;

/// Suffix of the functions that a compiler may contract.
pub const CONTRACTED: &str = "_contracted";

/// Rounding of `a * b + c`. Contracted code differs from the Rust code in its bits.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    Contracted,
    AsWritten,
}

/// Functions that are compared.
const FUNCTIONS: [&str; 4] = ["error_jacobian", "error_jacobian_distinct", "displacement", "covariance"];

/// Writes header and source of a spec. Returns the path of the source.
pub fn write(spec: &Spec, rounding: Rounding, out: &Path) -> PathBuf {
    let mut spec = spec.clone();
    if rounding == Rounding::Contracted {
        spec.name += CONTRACTED;
    }
    for file in Language::C(Real::Double).files_of(&spec, &FUNCTIONS) {
        fs::write(out.join(&file.name), &file.text).expect("our code");
    }
    out.join(format!("{}.c", spec.name))
}
