//! Whether two paths lead to one file, through links of both kinds.

use std::fs;
use std::path::Path;

/// By which a regular file is known, whatever it is called: device and inode.
#[cfg(unix)]
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Identity(u64, u64);

/// By which a regular file is known: its path without links.
#[cfg(not(unix))]
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Identity(std::path::PathBuf);

impl Identity {
    /// That of the file at the end of a path; none if there is no regular file.
    pub(super) fn of(path: &Path) -> Option<Self> {
        let found = fs::metadata(path).ok()?;
        Self::of_found(&found, path)
    }

    #[cfg(unix)]
    fn of_found(found: &fs::Metadata, _: &Path) -> Option<Self> {
        use std::os::unix::fs::MetadataExt;
        found.is_file().then(|| Self(found.dev(), found.ino()))
    }

    #[cfg(not(unix))]
    fn of_found(found: &fs::Metadata, path: &Path) -> Option<Self> {
        found.is_file().then(|| fs::canonicalize(path).ok().map(Self)).flatten()
    }

    /// That of an open file.
    pub(super) fn of_open(file: &fs::File, path: &Path) -> Option<Self> {
        Self::of_found(&file.metadata().ok()?, path)
    }

    /// That of the file to which stdout was sent, if it is one.
    pub(super) fn of_stdout() -> Option<Self> {
        #[cfg(unix)]
        {
            use std::os::fd::AsFd;
            let open = std::io::stdout().as_fd().try_clone_to_owned().ok()?;
            Self::of_open(&fs::File::from(open), Path::new(""))
        }
        #[cfg(not(unix))]
        None
    }
}
