//! A file that waits for its place until it, and all others of its command, are complete.

use std::fs::{self, File};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};

use abbe_study::hash;
use tempfile::{Builder, NamedTempFile, SpooledTempFile};

use super::target::{Target, parent};
use super::{cannot_write, folders, print};
use crate::failure::Failure;

/// What begins the names of the files that abbe writes for itself.
pub(super) const PREFIX: &str = ".abbe-";

/// What is kept in memory, in bytes.
const SMALL: usize = 1 << 20;

/// A file that is being written.
#[derive(Debug)]
pub(crate) struct Pending {
    /// As the user calls it.
    pub(super) path: PathBuf,
    pub(super) target: Target,
    /// In memory, and beyond [`SMALL`] in a file without a name, which goes with the process.
    content: SpooledTempFile,
}

impl Pending {
    pub(super) fn begin(path: &Path, target: Target) -> Result<Self, Failure> {
        let content = match &target {
            Target::File(file) => {
                // Whether the folder may be written to is seen now, not after a night of work.
                let _held = folders::hold();
                temporary(file).map_err(|error| cannot_write(path, &error))?;
                SpooledTempFile::new_in(SMALL, parent(file))
            }
            Target::Stdout | Target::Stream(_) => SpooledTempFile::new(SMALL),
        };
        Ok(Self { path: path.to_owned(), target, content })
    }

    /// The same with a text, or bytes, in it.
    pub(crate) fn fill(mut self, content: &(impl AsRef<[u8]> + ?Sized)) -> Result<Self, Failure> {
        self.write_all(content.as_ref()).map_err(|error| cannot_write(&self.path, &error))?;
        Ok(self)
    }

    /// Whether it will be a file of its own, not what is written to a stream.
    pub(crate) fn is_file(&self) -> bool {
        matches!(self.target, Target::File(_))
    }

    /// Copies the content to a temporary file beside `file`, and flushes it to the disk; returns its SHA-256, too.
    pub(super) fn complete(&mut self, file: &Path) -> io::Result<(NamedTempFile, String)> {
        let mut complete = temporary(file)?;
        self.content.rewind()?;
        io::copy(&mut self.content, &mut complete)?;
        complete.as_file().sync_all()?;
        self.content.rewind()?;
        Ok((complete, hash::of_reader(&mut self.content)?))
    }

    /// Appends the content to its stream.
    pub(super) fn write_through(mut self) -> Result<(), Failure> {
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

/// Makes a temporary file beside `file`, with the mode and, where that is allowed, the owner of the one that it will replace.
fn temporary(file: &Path) -> io::Result<NamedTempFile> {
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
    if let Some(old) = old {
        #[cfg(unix)]
        {
            use std::os::unix::fs::{MetadataExt, fchown};
            let _ = fchown(new.as_file(), Some(old.uid()), Some(old.gid()));
        }
        let _ = new.as_file().set_permissions(old.permissions());
    }
    Ok(new)
}
