//! Folders made for results. Those that are still empty at the end, or after an interruption, are
//! removed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

static MADE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Locks and returns the folders that were made, the outermost first. No signal ends the process
/// while the guard is held.
pub(crate) fn hold() -> MutexGuard<'static, Vec<PathBuf>> {
    MADE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a folder and its missing parents.
pub(crate) fn make(path: &Path) -> io::Result<()> {
    let mut made = hold();
    let missing = path.ancestors().take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
    let before = made.len();
    made.extend(missing.map(Path::to_owned));
    made[before..].reverse();
    fs::create_dir_all(path)
}

/// Removes the empty folders of the list, the innermost first.
pub(crate) fn remove_empty(made: &[PathBuf]) {
    made.iter().rev().for_each(|folder| _ = fs::remove_dir(folder));
}
