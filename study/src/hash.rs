//! SHA-256 hashes that identify files.

use std::io::{self, Read};
use std::path::Path;

use abbe_spec::Diagnostics;
use abbe_spec::bounded::{Bounded, UnreadableFile};
use sha2::{Digest, Sha256};

/// Returns the SHA-256 of a text, in hexadecimal.
pub fn text(text: &str) -> String {
    hex(&digest(text))
}

/// Returns the SHA-256 of a text.
pub fn digest(text: &str) -> [u8; 32] {
    Sha256::digest(text.as_bytes()).into()
}

/// Returns the SHA-256 of a file, in hexadecimal as printed by `sha256sum`.
pub fn file(file: &Path) -> Result<String, Diagnostics> {
    let fail =
        |error: io::Error| UnreadableFile::diagnostics(file.display(), &error, "give the path of a file");
    reader(Bounded::open(file, u64::MAX).map_err(fail)?).map_err(fail)
}

/// Returns the SHA-256 of all remaining bytes, in hexadecimal.
pub fn reader(mut reader: impl Read) -> io::Result<String> {
    let (mut hasher, mut buffer) = (Sha256::new(), vec![0; 1 << 16]);
    loop {
        match reader.read(&mut buffer)? {
            0 => return Ok(hex(&hasher.finalize())),
            read => hasher.update(&buffer[..read]),
        }
    }
}

/// Formats a hash in hexadecimal.
pub fn hex(hash: &[u8]) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}
