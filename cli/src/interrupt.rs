//! Interruption (Ctrl-C): no half-written file is left, and the exit status is 130.

use std::fs::{self, File};
use std::io;
use std::path::PathBuf;
use std::process;
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// What a shell calls the end by SIGINT: 128 + 2.
const INTERRUPTED: i32 = 130;

/// The temporary files that were begun. Those that were finished or dropped are not there any more: names are
/// random, so that nothing else can stand in their places.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn temporary_files() -> MutexGuard<'static, Vec<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on an interruption removes the temporary files and ends the process.
pub(crate) fn clean_up_on_interrupt() {
    // Without a handler the files stay behind as temporary ones; nothing else is lost.
    let _ = ctrlc::set_handler(|| {
        // The lock is held to the end: no other file is begun.
        for path in temporary_files().iter() {
            let _ = fs::remove_file(path);
        }
        process::exit(INTERRUPTED);
    });
}

/// A temporary file that an interruption removes.
pub(crate) fn temporary(
    make: impl FnOnce() -> io::Result<NamedTempFile<File>>,
) -> io::Result<NamedTempFile<File>> {
    let mut files = temporary_files();
    let file = make()?;
    files.push(file.path().to_owned());
    Ok(file)
}
