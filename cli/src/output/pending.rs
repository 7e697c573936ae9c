//! File under construction: it moves to its path when all files of the command are complete.

use std::fs::{self, File};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};
use std::{thread, time::Duration};

use abbe_study::hash;
use tempfile::{Builder, NamedTempFile, SpooledTempFile};

use super::target::{Target, parent};
use super::{IN_USE, cannot_write, folders, print};
use crate::Result;

/// Prefix of the names of abbe's own files.
pub(super) const PREFIX: &str = ".abbe-";

/// Largest content kept in memory, in bytes.
const SMALL: usize = 1 << 20;

/// File under construction.
#[derive(Debug)]
pub(crate) struct Pending {
    /// Path as the user gave it.
    pub(super) path: PathBuf,
    pub(super) target: Target,
    /// Content: in memory up to [`SMALL`], then in an unnamed file, which the system deletes with
    /// the process.
    content: SpooledTempFile,
}

impl Pending {
    pub(super) fn begin(path: &Path, target: Target) -> Result<Self> {
        let content = match &target {
            Target::File(file) => {
                // Checks write permission now rather than after hours of work.
                let _held = folders::hold();
                temporary(file).map_err(|error| cannot_write(path, &error))?;
                SpooledTempFile::new_in(SMALL, parent(file))
            }
            Target::Stdout | Target::Stream(_) => SpooledTempFile::new(SMALL),
        };
        Ok(Self { path: path.to_owned(), target, content })
    }

    /// Appends text or bytes, and returns the file.
    pub(crate) fn fill(mut self, content: &(impl AsRef<[u8]> + ?Sized)) -> Result<Self> {
        self.write_all(content.as_ref()).map_err(|error| cannot_write(&self.path, &error))?;
        Ok(self)
    }

    /// Returns true for a regular file, false for stdout and streams.
    pub(crate) fn is_file(&self) -> bool {
        matches!(self.target, Target::File(_))
    }

    /// Copies the content to a temporary file beside `file` and flushes it to the disk. Returns the
    /// temporary file and its SHA-256.
    pub(super) fn complete(&mut self, file: &Path) -> io::Result<(NamedTempFile, String)> {
        let mut complete = temporary(file)?;
        self.content.rewind()?;
        io::copy(&mut self.content, &mut complete)?;
        complete.as_file().sync_all()?;
        self.content.rewind()?;
        Ok((complete, hash::reader(&mut self.content)?))
    }

    /// Appends the content to its stream.
    pub(super) fn write_through(mut self) -> Result<()> {
        let failed = |error| cannot_write(&self.path, &error);
        self.content.rewind().map_err(failed)?;
        if self.target == Target::Stdout {
            return print(&mut self.content);
        }
        let mut stream = File::options().append(true).open(&self.path).map_err(failed)?;
        io::copy(&mut self.content, &mut stream).map(|_| ()).map_err(failed)
    }
}

impl Write for Pending {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.content.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Creates a temporary file beside `file`, with the mode and, if allowed, the owner of the file
/// that it will replace. Windows has neither, and does not delete a read-only file.
fn temporary(file: &Path) -> io::Result<NamedTempFile> {
    #[cfg(unix)]
    let old = fs::metadata(file).ok();
    let mut builder = Builder::new();
    builder.prefix(PREFIX).suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = old.as_ref().map_or(0o666, |old| old.permissions().mode() & 0o777);
        builder.permissions(fs::Permissions::from_mode(mode));
    }
    let new = builder.tempfile_in(parent(file))?;
    #[cfg(unix)]
    if let Some(old) = old {
        use std::os::unix::fs::{MetadataExt, fchown};
        let _ = fchown(new.as_file(), Some(old.uid()), Some(old.gid()));
        let _ = new.as_file().set_permissions(old.permissions());
    }
    Ok(new)
}

/// Moves a complete file to its path. On Windows this fails while a program, perhaps another run,
/// has the old file open: tries for a second.
pub(super) fn persist(mut complete: NamedTempFile, file: &Path) -> io::Result<()> {
    for _ in 0..40 {
        let Err(failed) = complete.persist(file) else { return Ok(()) };
        // 5: access denied, to a read-only file, too.
        let may_be_open = cfg!(windows) && matches!(failed.error.raw_os_error(), Some(5 | IN_USE));
        if !may_be_open || fs::metadata(file).is_ok_and(|old| old.permissions().readonly()) {
            return Err(failed.error);
        }
        complete = failed.file;
        thread::sleep(Duration::from_millis(25));
    }
    Err(io::Error::from_raw_os_error(IN_USE))
}
