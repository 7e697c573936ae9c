//! How parts are written: `docs/scale.md` has the format.

use abbe_spec::bounded::{Bounded, Unfit};
use abbe_spec::diagnostic::Diagnostics;
use sha2::{Digest, Sha256};
use std::path::Path;

use super::part::Part;
use crate::mistake;

/// What every part begins with, and the version of the format.
const BEGINNING: &str = "abbe part ";
const VERSION: &str = "1";
/// The length of the checksum at the end.
const CHECKSUM: usize = 32;
/// The longest file that is read, in bytes.
const LONGEST: u64 = 1 << 30;

impl Part {
    /// The bytes of its file: one line with the version of the format, the part in CBOR (RFC 8949), and the SHA-256 of both.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = format!("{BEGINNING}{VERSION}\n").into_bytes();
        // Only a writer can fail, and this one is memory.
        let _ = ciborium::into_writer(self, &mut bytes);
        let checksum = Sha256::digest(&bytes);
        bytes.extend_from_slice(&checksum);
        bytes
    }

    /// Reads what [`to_bytes`](Self::to_bytes) wrote; `name` is what mistakes are shown under.
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, Diagnostics> {
        let wrong = |message: &str, help: &str| Err(mistake::with_help(name, message, help));
        let Some(rest) = bytes.strip_prefix(BEGINNING.as_bytes()) else {
            return wrong(
                "this is no part of an analysis",
                "`abbe analyze SPEC --shard I/N --out FILE` writes one",
            );
        };
        let damaged = || {
            wrong(
                "this part is damaged: it is not what its checksum says",
                "make it again, or copy it again from where it was made",
            )
        };
        let Some(end) = rest.iter().take(20).position(|byte| *byte == b'\n') else { return damaged() };
        if &rest[..end] != VERSION.as_bytes() {
            let version = String::from_utf8_lossy(&rest[..end]).into_owned();
            let message =
                format!("this part is of format {version}, and this version of abbe reads {VERSION}");
            return wrong(&message, "make and merge all parts with one version of abbe");
        }
        let Some(before) = bytes.len().checked_sub(CHECKSUM) else { return damaged() };
        let (content, checksum) = bytes.split_at(before);
        if Sha256::digest(content)[..] != *checksum {
            return damaged();
        }
        let start = BEGINNING.len() + end + 1;
        match content.get(start..).map(ciborium::from_reader) {
            Some(Ok(part)) => Ok(part),
            _ => wrong(
                "this part was written by another version of abbe",
                "make and merge all parts with one version of abbe",
            ),
        }
    }

    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self, Diagnostics> {
        let bytes = Bounded::read_all(path, LONGEST).map_err(|error| {
            let Unfit { message, help } = Unfit::from_error(&error, "give the path of a part");
            mistake::with_help(path.display(), message, help)
        })?;
        Self::from_bytes(&path.display().to_string(), &bytes)
    }
}
