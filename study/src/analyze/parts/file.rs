//! How parts are written: `docs/scale.md` has the format.

use std::path::Path;

use abbe_spec::bounded::{Bounded, Unfit};
use abbe_spec::diagnostic::Diagnostics;

use super::part::Part;
use crate::{hash, mistake};

/// What every part begins with, and the version of the format.
const BEGINNING: &str = "abbe part ";
const VERSION: &str = "2";
/// The length of the checksum at the end, with its line end.
const CHECKSUM: usize = 65;
/// The longest file that is read, in bytes.
const LONGEST: u64 = 1 << 30;

impl Part {
    /// Returns the bytes of its file, three lines: the version of the format, the part in JSON, and the SHA-256 of both.
    pub fn to_bytes(&self) -> Vec<u8> {
        // A part has finite numbers, and maps whose keys are integers.
        let json = serde_json::to_string(self).expect("a part is JSON");
        let content = format!("{BEGINNING}{VERSION}\n{json}\n");
        let checksum = hash::of_text(&content);
        format!("{content}{checksum}\n").into_bytes()
    }

    /// Reads what [`to_bytes`](Self::to_bytes) wrote; `name` is what mistakes are shown under.
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, Diagnostics> {
        let wrong = |message: &str, help: &str| mistake::with_help(name, message, help);
        let Some(rest) = bytes.strip_prefix(BEGINNING.as_bytes()) else {
            return Err(wrong(
                "this is no part of an analysis",
                "`abbe analyze SPEC --shard I/N --out FILE` writes one",
            ));
        };
        let damaged = || {
            wrong(
                "this part is damaged: it is not what its checksum says",
                "make it again, or copy it again from where it was made",
            )
        };
        let end = rest.iter().take(20).position(|byte| *byte == b'\n').ok_or_else(damaged)?;
        if &rest[..end] != VERSION.as_bytes() {
            let version = String::from_utf8_lossy(&rest[..end]);
            let message =
                format!("this part is of format {version}, and this version of abbe reads {VERSION}");
            return Err(wrong(&message, "make and merge all parts with one version of abbe"));
        }
        let text = std::str::from_utf8(bytes).map_err(|_| damaged())?;
        let (content, checksum) = text
            .len()
            .checked_sub(CHECKSUM)
            .and_then(|end| text.split_at_checked(end))
            .ok_or_else(damaged)?;
        if hash::of_text(content) + "\n" != checksum {
            return Err(damaged());
        }
        let json = &content[BEGINNING.len() + end + 1..];
        let part: Result<Self, String> = serde_json::from_str(json).map_err(|error| error.to_string());
        let checked = part.and_then(|part| part.question.check_draws().map(|()| part));
        checked.map_err(|message| {
            wrong(
                &format!("this part holds what no part of this version of abbe does: {message}"),
                "make it again; make and merge all parts with one version of abbe",
            )
        })
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
