//! Files under names of their own, `.abbe-PROCESS-….tmp`, until they are complete. What a process leaves that was killed is
//! cleared by the next one that writes in the folder; `….set` are journals of sets of files, which it ends first.

use std::ffi::OsStr;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

use super::journal;

const PREFIX: &str = ".abbe-";
const SUFFIX: &str = ".tmp";
const JOURNAL: &str = ".set";

/// What an interruption takes away: temporary files, and folders that were made and are still empty. Names of files are random,
/// so that nothing else can stand in the places of those that are gone.
#[derive(Default)]
pub(crate) struct Begun {
    files: Vec<PathBuf>,
    folders: Vec<PathBuf>,
}

static BEGUN: Mutex<Begun> = Mutex::new(Begun { files: Vec::new(), folders: Vec::new() });

impl Begun {
    /// As long as this is held nothing is begun, and no signal ends the process.
    pub(crate) fn hold() -> MutexGuard<'static, Self> {
        BEGUN.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes away all that was begun.
    pub(crate) fn clear(&self) {
        for file in &self.files {
            let _ = fs::remove_file(file);
        }
        self.clear_folders(&self.folders);
    }

    fn clear_folders(&self, folders: &[PathBuf]) {
        // The inner ones were made last. Those with something in them stay.
        for folder in folders.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Makes something under a name of this process, which is removed when it is dropped.
fn named<T>(
    folder: &Path,
    suffix: &str,
    make: impl FnMut(&Path) -> io::Result<T>,
) -> io::Result<NamedTempFile<T>> {
    let mut begun = Begun::hold();
    let prefix = format!("{PREFIX}{}-", process::id());
    let file = Builder::new().prefix(&prefix).suffix(suffix).make_in(folder, make)?;
    begun.files.push(file.path().to_owned());
    Ok(file)
}

/// A new file: with the permissions of the one that it will replace, or else of any other file, not those of a secret.
pub(crate) fn file(folder: &Path, old: Option<&Metadata>) -> io::Result<NamedTempFile<File>> {
    let mut options = File::options();
    options.write(true).create_new(true);
    #[cfg(unix)]
    if let Some(old) = old {
        use std::os::unix::fs::{MetadataExt, OpenOptionsExt};
        options.mode(old.mode() & 0o777);
    }
    let file = locked(folder, SUFFIX, &options)?;
    if let Some(old) = old {
        alike(file.as_file(), old);
    }
    Ok(file)
}

/// A new file for the journal of a set of files.
pub(super) fn journal(folder: &Path) -> io::Result<NamedTempFile<File>> {
    locked(folder, JOURNAL, File::options().write(true).create_new(true))
}

fn locked(folder: &Path, suffix: &str, options: &OpenOptions) -> io::Result<NamedTempFile<File>> {
    let file = named(folder, suffix, |path| options.open(path))?;
    // Others see by this that it is still being written, even from another computer. Where there are no locks the number
    // of the process says it.
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// A file under a second name.
pub(super) fn kept(path: &Path, folder: &Path) -> io::Result<NamedTempFile<()>> {
    let link = named(folder, SUFFIX, |name| fs::hard_link(path, name));
    // Some file systems have no links.
    link.or_else(|_| named(folder, SUFFIX, |name| fs::copy(path, name).map(|_| ())))
}

/// Gives a file owner and mode of another one, as far as that is allowed.
fn alike(file: &File, old: &Metadata) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let new = file.metadata();
        if new.is_ok_and(|new| (new.uid(), new.gid()) != (old.uid(), old.gid())) {
            let _ = fchown(file, Some(old.uid()), Some(old.gid()));
        }
    }
    let _ = file.set_permissions(old.permissions());
}

/// Makes a folder and those above it.
pub(crate) fn folder(path: &Path) -> io::Result<Folders> {
    let missing = path.ancestors().take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
    let mut made: Vec<PathBuf> = missing.map(Path::to_owned).collect();
    made.reverse();
    let folders = Folders(made);
    let mut begun = Begun::hold();
    begun.folders.extend(folders.0.iter().cloned());
    let made = fs::create_dir_all(path);
    // Those that were made for nothing ask for it.
    drop(begun);
    made.map(|()| folders)
}

/// Folders that were made, from the outermost on. Those that are still empty in the end are taken away.
#[derive(Debug)]
pub(crate) struct Folders(Vec<PathBuf>);

impl Drop for Folders {
    fn drop(&mut self) {
        Begun::hold().clear_folders(&self.0);
    }
}

/// Ends and removes what processes left in a folder that are gone.
pub(super) fn clear_stale(folder: &Path) {
    let entries: Vec<_> = fs::read_dir(folder).into_iter().flatten().flatten().collect();
    // A journal needs the files that it names.
    for suffix in [JOURNAL, SUFFIX] {
        for entry in &entries {
            let stale = process_of(&entry.file_name(), suffix).is_some_and(|process| !lives(process))
                && entry.file_type().is_ok_and(|kind| kind.is_file())
                && !is_locked(&entry.path());
            if stale {
                if suffix == JOURNAL {
                    journal::complete(&entry.path());
                }
                let _ = fs::remove_file(entry.path());
            }
        }
    }
}

/// The number of the process that made a temporary file of that name.
fn process_of(name: &OsStr, suffix: &str) -> Option<u32> {
    let (process, _) = name.to_str()?.strip_prefix(PREFIX)?.strip_suffix(suffix)?.split_once('-')?;
    process.parse().ok()
}

/// Whether a file of that name is a temporary one, of whomever.
pub(super) fn is_one(name: &OsStr) -> bool {
    [SUFFIX, JOURNAL].iter().any(|suffix| process_of(name, suffix).is_some())
}

fn is_locked(path: &Path) -> bool {
    let locked = |file: File| matches!(file.try_lock(), Err(fs::TryLockError::WouldBlock));
    // What cannot be opened is not ours.
    File::open(path).map_or(true, locked)
}

/// Whether another process has that number.
#[cfg(unix)]
fn lives(process: u32) -> bool {
    use nix::errno::Errno;
    use nix::sys::signal::kill;
    use nix::unistd::Pid;
    let other = process != process::id();
    other && i32::try_from(process).is_ok_and(|id| kill(Pid::from_raw(id), None) != Err(Errno::ESRCH))
}

/// Nobody can say; their locks do.
#[cfg(not(unix))]
fn lives(_: u32) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_the_dead_left_is_cleared() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        // No system gives a process this number.
        let dead = ".abbe-2147483646-a1b2c3.tmp";
        for name in [dead, ".abbe-1-a1b2c3.tmp", ".abbe-x-y.tmp", ".abbe-written", "data.csv", "a.tmp"] {
            fs::write(path(name), "").unwrap();
        }
        let own = file(folder.path(), None).unwrap();
        let abandoned = path(&format!(".abbe-{}-a1b2c3.tmp", process::id()));
        fs::write(&abandoned, "of one before us with our number").unwrap();
        clear_stale(folder.path());
        assert!(!path(dead).exists() && !abandoned.exists());
        assert!(own.path().exists());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 6 - usize::from(cfg!(not(unix))));
    }

    #[test]
    fn folders_that_were_made_for_nothing_go() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("a/b");
        drop(super::folder(&inner).unwrap());
        assert!(!folder.path().join("a").exists());
        fs::write(folder.path().join("file"), "").unwrap();
        assert!(super::folder(&folder.path().join("file/under")).is_err());
        let made = super::folder(&inner).unwrap();
        fs::write(inner.join("file"), "").unwrap();
        drop(made);
        assert!(inner.join("file").exists());
    }
}
