//! Bounded reading of files: limits of size.

use std::collections::BTreeMap;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Cursor, ErrorKind, Read};
use std::path::Path;

use crate::diagnostic::{Diagnostics, nearest_file};
use crate::{mistake, option::OUT_FILE};

/// Contents of files, by path.
pub type Contents = BTreeMap<String, String>;

/// Reason why a file cannot be read, and a remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnreadableFile {
    /// Description of the problem, in one sentence.
    pub message: String,
    /// Suggested remedy.
    pub help: String,
}

impl UnreadableFile {
    /// Creates the reason for a refusal, with a suggested fix.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into() }
    }

    /// Converts a read error. `help` is the remedy if the error has none of its own.
    pub fn from_error(error: &io::Error, help: &str) -> Self {
        match error.get_ref().and_then(|inner| inner.downcast_ref::<Self>()) {
            Some(unfit) => unfit.clone(),
            None => Self::new(format!("cannot read this file: {error}"), help),
        }
    }

    /// Returns the diagnostics of a file that cannot be read. `help` is as in [`Self::from_error`].
    pub fn diagnostics(file: impl fmt::Display, error: &io::Error, help: &str) -> Diagnostics {
        let Self { message, help } = Self::from_error(error, help);
        mistake::with_help(file, message, help)
    }
}

impl fmt::Display for UnreadableFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for UnreadableFile {}

impl From<UnreadableFile> for io::Error {
    fn from(unfit: UnreadableFile) -> Self {
        Self::other(unfit)
    }
}

/// A file open for reading, or content that is at hand. What cannot be accepted gives an error that
/// contains an [`UnreadableFile`].
pub struct Bounded {
    source: Box<dyn Read + Send>,
    most: u64,
    left: u64,
}

impl Bounded {
    /// Opens a file; reading more than `most` bytes is an error.
    pub fn open(path: &Path, most: u64) -> io::Result<Self> {
        let metadata = fs::metadata(path).map_err(|error| or_nearest(error, path))?;
        if metadata.is_dir() {
            return Err(UnreadableFile::new("this is a directory, not a file", "name a file in it").into());
        }
        if metadata.len() > most {
            return Err(too_large(most).into());
        }
        Ok(Self { source: Box::new(File::open(path)?), most, left: most })
    }

    /// Finds a file among contents, and opens none; reading more than `most` bytes is an error.
    pub fn find(contents: &Contents, path: &Path, most: u64) -> io::Result<Self> {
        let text = contents.get(&*path.to_string_lossy()).ok_or_else(|| {
            let message = "this file is not among those that come with the text that names it";
            UnreadableFile::new(message, "supply its contents with the text")
        })?;
        Ok(Self { source: Box::new(Cursor::new(text.clone())), most, left: most })
    }

    /// Reads a whole file of at most `most` bytes.
    pub fn read_all(path: &Path, most: u64) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        Self::open(path, most)?.read_to_end(&mut bytes)?;
        Ok(bytes)
    }
}

impl Read for Bounded {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.source.read(buffer)?;
        self.left = self.left.checked_sub(length as u64).ok_or_else(|| too_large(self.most))?;
        Ok(length)
    }
}

/// Adds a suggestion to the error if the file does not exist.
fn or_nearest(error: io::Error, path: &Path) -> io::Error {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir());
    let help = match (error.kind(), folder) {
        (ErrorKind::NotFound, Some(folder)) => Some(format!("there is no folder `{}`", folder.display())),
        (ErrorKind::NotFound, None) => {
            nearest_file(path).map(|near| format!("did you mean `{}`?", near.display()))
        }
        _ => None,
    };
    let unfit = |help| UnreadableFile::new(format!("cannot read this file: {error}"), help);
    help.map(|help| io::Error::new(error.kind(), unfit(help))).unwrap_or(error)
}

fn too_large(most: u64) -> UnreadableFile {
    let message = format!("this file is larger than {} MiB", most >> 20);
    UnreadableFile::new(message, "check that this is the right file")
}

/// Recognizes common file types that are not UTF-8 text by their first bytes.
pub fn not_text(head: &[u8]) -> Option<UnreadableFile> {
    const KINDS: [(&[u8], &str, &str); 8] = [
        (b"\x1f\x8b", "is compressed by gzip", "unpack it: `gunzip FILE`"),
        (b"PK\x03\x04", "is a zip archive or a spreadsheet", "unpack it, or save the sheet as CSV"),
        (b"BZh", "is compressed by bzip2", "unpack it: `bunzip2 FILE`"),
        (b"\xfd7zXZ", "is compressed by xz", "unpack it: `unxz FILE`"),
        (b"\x28\xb5\x2f\xfd", "is compressed by zstd", "unpack it: `unzstd FILE`"),
        (b"\xd0\xcf\x11\xe0", "is a spreadsheet or a document", "save it as text: a sheet as CSV"),
        (b"%PDF", "is a PDF", "give a text file"),
        (b"\x7fELF", "is a program", "give a text file"),
    ];
    if let Some((_, what, help)) = KINDS.iter().find(|(begins, ..)| head.starts_with(begins)) {
        return Some(UnreadableFile::new(format!("this file {what}"), *help));
    }
    // A byte order mark, or every other byte is 0, as of Latin letters.
    let start = &head[..head.len().min(256)];
    let zeros = |first: usize| start.iter().skip(first).step_by(2).filter(|byte| **byte == 0).count();
    let is_utf_16 = head.starts_with(b"\xff\xfe")
        || head.starts_with(b"\xfe\xff")
        || zeros(0).min(zeros(1)) == 0 && 3 * zeros(0).max(zeros(1)) > start.len();
    let help = format!("save it as UTF-8, or write it with `{OUT_FILE}` instead of `>`");
    is_utf_16.then(|| UnreadableFile::new("this file seems to be text in UTF-16", help))
}

#[cfg(test)]
mod tests;
