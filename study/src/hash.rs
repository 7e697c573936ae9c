//! By which a file is known again.

use std::io::{self, Read};
use std::path::Path;

use abbe_spec::bounded::{Bounded, Unfit};
use abbe_spec::diagnostic::Diagnostics;
use sha2::{Digest, Sha256};

use crate::mistake;

/// The SHA-256 of a text, in hexadecimal digits.
pub fn of_text(text: &str) -> String {
    digits(&Sha256::digest(text.as_bytes()))
}

/// The SHA-256 of a file, as `sha256sum` says it.
pub fn of_file(file: &Path) -> Result<String, Diagnostics> {
    let fail = |error: io::Error| {
        let Unfit { message, help } = Unfit::from_error(&error, "give the path of a file");
        mistake::with_help(file.display(), message, help)
    };
    let file = Bounded::open(file, u64::MAX).map_err(fail)?;
    of_reader(file).map_err(fail)
}

/// The SHA-256 of all that is read.
pub fn of_reader(mut reader: impl Read) -> io::Result<String> {
    let (mut hasher, mut buffer) = (Sha256::new(), vec![0; 1 << 16]);
    loop {
        match reader.read(&mut buffer)? {
            0 => return Ok(digits(&hasher.finalize())),
            read => hasher.update(&buffer[..read]),
        }
    }
}

/// The hexadecimal digits of a hash.
pub fn digits(hash: &[u8]) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}
