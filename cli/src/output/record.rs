//! Which files abbe wrote: `.abbe-written`, in every folder in which it wrote any, has the SHA-256 and the name of each, as
//! `sha256sum` prints them. A file that is still one of them is abbe's, and may be written anew; what is not there, or was
//! changed, is somebody's.
//!
//! One rule for all kinds of files: CSV has no room for a mark, and a mark would not say that a file was changed by hand.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;

use abbe_study::hash;

use super::identity::Identity;
use super::place::parent;
use super::temporary;

/// The record of a folder.
const NAME: &str = ".abbe-written";

const HEAD: &str = "# SHA-256 of the files that abbe wrote here. It replaces them as long as they are unchanged; others it \
                    replaces only with --force.\n";

/// How many states of one file are known: of runs at the same time, any may be the last.
const STATES: usize = 8;

/// Whether there is a record in a folder.
pub(super) fn is_in(folder: &Path) -> bool {
    fs::symlink_metadata(folder.join(NAME)).is_ok_and(|found| found.is_file())
}

/// Whether a file is abbe's, or has nothing in it.
pub(super) fn is_ours(file: &Path) -> io::Result<bool> {
    if fs::metadata(file)?.len() == 0 {
        return Ok(true);
    }
    let Some(name) = file.file_name() else { return Ok(false) };
    let folder = parent(file);
    if !is_in(folder) {
        return Ok(false);
    }
    let hash = hash::of_reader(File::open(file)?)?;
    let record = fs::read(folder.join(NAME))?;
    Ok(String::from_utf8_lossy(&record).lines().any(|known| known == line(&hash, name)))
}

/// Notes files of a folder, by name and SHA-256. Runs at the same time wait for each other.
pub(super) fn add(folder: &Path, files: &[(&OsStr, String)]) -> io::Result<()> {
    let path = folder.join(NAME);
    if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
        return Err(io::Error::other(format!("{NAME} is no file")));
    }
    let mut old = locked(&path)?;
    let mut text = String::new();
    // A record that is no text is begun anew.
    let _ = old.read_to_string(&mut text);
    let known = text.lines().filter(|line| !line.starts_with('#')).map(str::to_owned);
    let new = files.iter().map(|(name, hash)| line(hash, name));
    let mut new_file = temporary::file(folder, old.metadata().ok().as_ref())?;
    new_file.write_all((HEAD.to_owned() + &latest(known.chain(new).collect())).as_bytes())?;
    new_file.persist(&path)?;
    Ok(())
}

/// Opens the record, and makes it if there is none; nobody else writes it until it is closed.
fn locked(path: &Path) -> io::Result<File> {
    loop {
        let file = File::options().read(true).append(true).create(true).open(path)?;
        // Some file systems have no locks: then the last of two that write at once is right.
        let _ = file.lock();
        // Who had it before has put a new one in its place.
        if Identity::of_open(&file, path) == Identity::of(path) {
            return Ok(file);
        }
    }
}

fn line(hash: &str, name: &OsStr) -> String {
    format!("{hash}  {}", name.to_string_lossy().replace(['\n', '\r'], "?"))
}

/// The last states of every file, without repetition.
fn latest(mut lines: Vec<String>) -> String {
    let name = |line: &str| line.split_once("  ").map(|(_, name)| name.to_owned()).unwrap_or_default();
    let mut kept: Vec<String> = Vec::new();
    while let Some(line) = lines.pop() {
        let states = kept.iter().filter(|known| name(known) == name(&line)).count();
        if states < STATES && !kept.contains(&line) {
            kept.push(line);
        }
    }
    kept.iter().rev().map(|line| format!("{line}\n")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_ours_until_it_is_changed() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a  b, c.csv");
        fs::write(&file, "1,2\n").unwrap();
        assert!(!is_ours(&file).unwrap());
        let name = file.file_name().unwrap();
        let hash = hash::of_text("1,2\n");
        add(folder.path(), &[(name, hash)]).unwrap();
        assert!(is_ours(&file).unwrap());
        fs::write(&file, "1,3\n").unwrap();
        assert!(!is_ours(&file).unwrap());
        fs::write(&file, "").unwrap();
        assert!(is_ours(&file).unwrap());
    }

    #[test]
    fn records_do_not_grow_and_none_is_lost() {
        let folder = tempfile::tempdir().unwrap();
        let writers = (0..8).map(|writer| {
            let folder = folder.path().to_owned();
            std::thread::spawn(move || {
                for i in 0..20 {
                    let name = format!("{writer}.csv");
                    add(&folder, &[(OsStr::new(&name), hash::of_text(&i.to_string()))]).unwrap();
                }
            })
        });
        writers.collect::<Vec<_>>().into_iter().for_each(|writer| writer.join().unwrap());
        let record = fs::read_to_string(folder.path().join(NAME)).unwrap();
        assert_eq!(record.lines().count(), 1 + 8 * STATES);
        for writer in 0..8 {
            let last = line(&hash::of_text("19"), OsStr::new(&format!("{writer}.csv")));
            assert!(record.lines().any(|line| line == last));
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
