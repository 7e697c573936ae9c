//! Where a path leads that is to be written.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::cannot_write;
use super::identity::Identity;
use crate::failure::Failure;

/// Where a path leads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// `-`, or another name of stdout.
    Stdout,
    /// What is no regular file, and stays what it is: a device, a pipe, an open descriptor.
    Through(PathBuf),
    /// A regular file, or one that is not there yet: its path without links.
    File(PathBuf),
}

const STDOUT: [&str; 4] = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];

/// Their names are links to whatever was opened: what is there is not ours to replace.
const DESCRIPTORS: [&str; 3] = ["/dev/fd", "/dev/stderr", "/proc/self/fd"];

/// More links than any system follows.
const LINKS: usize = 40;

impl Place {
    /// Follows a path; a folder is no place for a file.
    pub(super) fn find(path: &Path) -> Result<Self, Failure> {
        if is_stdout(path) {
            return Ok(Self::Stdout);
        }
        let last = path.as_os_str().as_encoded_bytes().last();
        let folder =
            || Err(Failure::of(path.display(), "this is a folder, not a file").help("name a file in it"));
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => folder(),
            Ok(found) if !found.is_file() || DESCRIPTORS.iter().any(|name| path.starts_with(name)) => {
                Ok(Self::Through(path.to_owned()))
            }
            Ok(_) if Identity::of(path) == Identity::of_stdout() => Ok(Self::Stdout),
            Ok(_) => fs::canonicalize(path).map(Self::File).map_err(|error| cannot_write(path, &error)),
            Err(error) if error.kind() == ErrorKind::NotFound => match last {
                Some(byte) if std::path::is_separator((*byte).into()) => folder(),
                _ => new_file(path),
            },
            Err(error) => Err(cannot_write(path, &error)),
        }
    }
}

pub(super) fn is_stdout(path: &Path) -> bool {
    STDOUT.iter().any(|name| path == Path::new(name))
}

/// The place of a file that is not there, at the end of links that lead nowhere.
fn new_file(path: &Path) -> Result<Place, Failure> {
    let mut end = path.to_owned();
    for _ in 0..LINKS {
        let Ok(to) = fs::read_link(&end) else { break };
        end = parent(&end).join(to);
    }
    let folder = fs::canonicalize(parent(&end)).map_err(|error| {
        let failure = cannot_write(path, &error);
        if error.kind() == ErrorKind::NotFound { failure.help("make its folder first") } else { failure }
    })?;
    match end.file_name() {
        Some(name) => Ok(Place::File(folder.join(name))),
        None => Err(Failure::of(path.display(), "this names no file")),
    }
}

/// The folder of a file: the one we are in if it names none.
pub(super) fn parent(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
