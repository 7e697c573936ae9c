//! Folders that were made for results. Those that are still empty in the end go again, also after an interruption.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

static MADE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Returns the folders that were made, from the outermost on. As long as they are held, no signal ends the process.
pub(crate) fn hold() -> MutexGuard<'static, Vec<PathBuf>> {
    MADE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a folder and those above it.
pub(crate) fn make(path: &Path) -> io::Result<()> {
    let mut made = hold();
    let missing = path.ancestors().take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
    let before = made.len();
    made.extend(missing.map(Path::to_owned));
    made[before..].reverse();
    fs::create_dir_all(path)
}

/// Removes those that are empty, the inner ones first.
pub(crate) fn remove_empty(made: &[PathBuf]) {
    made.iter().rev().for_each(|folder| _ = fs::remove_dir(folder));
}
