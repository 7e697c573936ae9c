//! Record of the files that abbe wrote: `.abbe-written` in each output folder lists their SHA-256
//! and names in the format of `sha256sum`. A file that matches its entry belongs to abbe and may be
//! replaced; all others belong to the user.
//!
//! The record works for every kind of file. A mark inside the files would not: CSV has no place for
//! one, and it would survive edits by hand.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read, Write};
use std::path::Path;

use abbe_study::hash;

use super::target::parent;

/// File name of the record.
const NAME: &str = ".abbe-written";

const HEAD: &str = "# SHA-256 of the files that abbe wrote in this folder. abbe replaces them \
    while they are unchanged, and other files only with --force.\n";

/// Returns true if the folder has a record.
pub(super) fn is_in(folder: &Path) -> bool {
    fs::symlink_metadata(folder.join(NAME)).is_ok_and(|found| found.is_file())
}

/// Returns true if the file is empty or matches its entry in the record.
pub(super) fn is_ours(file: &Path) -> io::Result<bool> {
    if fs::metadata(file)?.len() == 0 {
        return Ok(true);
    }
    if !is_in(parent(file)) {
        return Ok(false);
    }
    let line = line(file, &hash::reader(File::open(file)?)?);
    let record = read(&File::open(parent(file).join(NAME))?, File::lock_shared)?;
    Ok(record.lines().any(|known| known == line))
}

/// Adds an entry for a file with this SHA-256 to the record of its folder.
pub(super) fn add(file: &Path, hash: &str) -> io::Result<()> {
    let path = parent(file).join(NAME);
    if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
        return Err(io::Error::other(format!("{NAME} is not a regular file")));
    }
    let mut record = File::options().read(true).append(true).create(true).open(path)?;
    let (known, line) = (read(&record, File::lock)?, line(file, hash));
    if known.lines().any(|known| known == line) {
        return Ok(());
    }
    let before = match &*known {
        "" => HEAD,
        known if known.ends_with('\n') => "",
        _ => "\n",
    };
    record.write_all(format!("{before}{line}\n").as_bytes())
}

/// Waits until no other run appends, and reads; dropping the file unlocks it. Without the lock a
/// run may read half of the line that another one appends, and on Windows it could not read
/// meanwhile. A file system without locks has none.
fn read(mut record: &File, lock: fn(&File) -> io::Result<()>) -> io::Result<String> {
    lock(record).or_else(|error| if error.kind() == ErrorKind::Unsupported { Ok(()) } else { Err(error) })?;
    let mut known = Vec::new();
    record.read_to_end(&mut known)?;
    Ok(String::from_utf8_lossy(&known).into_owned())
}

fn line(file: &Path, hash: &str) -> String {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    format!("{hash}  {}", name.replace(['\n', '\r'], "?"))
}

#[cfg(test)]
mod tests;
