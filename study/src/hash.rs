//! By which a file is known again.

use std::path::Path;

use abbe_codegen::diagnostic::Diagnostics;
use sha2::{Digest, Sha256};

use crate::mistake;

/// The SHA-256 of a text, in hexadecimal digits.
pub fn of_text(text: &str) -> String {
    digits(&Sha256::digest(text.as_bytes()))
}

/// The SHA-256 of a file, as `sha256sum` says it.
pub fn of_file(file: &Path) -> Result<String, Diagnostics> {
    let bytes = std::fs::read(file)
        .map_err(|error| mistake::whole(file.display(), format!("cannot read this: {error}")))?;
    Ok(digits(&Sha256::digest(&bytes)))
}

fn digits(hash: &[u8]) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}
