//! Resolution of output paths, and identity of the files there.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf, is_separator};

use same_file::Handle;

use super::cannot_write;
use crate::{Result, failure::Failure};

/// Resolved output path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// `-`, or another name of stdout.
    Stdout,
    /// Device, pipe or open descriptor: it is written through and not replaced.
    Stream(PathBuf),
    /// Regular file, existing or new: its path without links.
    File(PathBuf),
}

const STDOUT: [&str; 4] = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];

/// Names of open descriptors. They link to whatever is open, which must not be replaced.
const DESCRIPTORS: [&str; 3] = ["/dev/fd", "/dev/stderr", "/proc/self/fd"];

/// Limit of links to follow, above that of any system.
const LINKS: usize = 40;

impl Target {
    /// Resolves a path.
    ///
    /// # Errors
    ///
    /// The path is a folder, or cannot be read.
    pub(super) fn find(path: &Path) -> Result<Self> {
        if is_stdout(path) {
            return Ok(Self::Stdout);
        }
        let name = path.as_os_str();
        let names_folder = name.as_encoded_bytes().last().is_some_and(|byte| is_separator((*byte).into()));
        match fs::metadata(path) {
            Ok(found) if found.is_file() && !DESCRIPTORS.iter().any(|name| path.starts_with(name)) => {
                if Handle::stdout().is_ok_and(|open| identity(path) == Some(open)) {
                    Ok(Self::Stdout)
                } else {
                    fs::canonicalize(path).map(Self::File).map_err(|error| cannot_write(path, &error))
                }
            }
            Ok(found) if !found.is_dir() => Ok(Self::Stream(path.to_owned())),
            // Nothing about the null device of Windows can be read.
            _ if cfg!(windows) && name.eq_ignore_ascii_case("nul") => Ok(Self::Stream(path.to_owned())),
            Err(error) if error.kind() == ErrorKind::NotFound && !names_folder => new_file(path),
            Err(error) if error.kind() != ErrorKind::NotFound => Err(cannot_write(path, &error)),
            _ => {
                Err(Failure::new(path.display(), "this is a folder, not a file").help("choose a file in it"))
            }
        }
    }

    /// Checks that the folder of a file is not replaced by a link: its path has none.
    pub(super) fn is_where_it_was(&self, path: &Path) -> Result<()> {
        let Self::File(file) = self else { return Ok(()) };
        match fs::canonicalize(parent(file)) {
            Ok(folder) if folder == parent(file) => Ok(()),
            Ok(folder) => {
                let message = format!("its folder was replaced by a link to {} meanwhile", folder.display());
                Err(Failure::new(path.display(), message).help("run the command again"))
            }
            Err(error) => Err(cannot_write(path, &error)),
        }
    }
}

pub(crate) fn is_stdout(path: &Path) -> bool {
    STDOUT.iter().any(|name| path == Path::new(name))
}

/// Returns the target of a path without a file, following dangling links to their end.
fn new_file(path: &Path) -> Result<Target> {
    let mut end = path.to_owned();
    for _ in 0..LINKS {
        let Ok(to) = fs::read_link(&end) else { break };
        end = parent(&end).join(to);
    }
    let folder = fs::canonicalize(parent(&end)).map_err(|error| {
        let failure = cannot_write(path, &error);
        if error.kind() == ErrorKind::NotFound { failure.help("create the folder first") } else { failure }
    })?;
    let name =
        end.file_name().ok_or_else(|| Failure::new(path.display(), "this is not the path of a file"))?;
    Ok(Target::File(folder.join(name)))
}

/// Returns the folder of a path: the current folder if the path names none.
pub(super) fn parent(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Returns the identity of the regular file at a path under all its names, if there is one.
pub(super) fn identity(path: &Path) -> Option<Handle> {
    fs::metadata(path).ok().filter(fs::Metadata::is_file)?;
    Handle::from_path(path).ok()
}
