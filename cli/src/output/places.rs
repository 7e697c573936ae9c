//! Complete files go to their places: all of them, or none.

use std::fs::{self, File};
use std::io;
use std::path::PathBuf;

use tempfile::NamedTempFile;

use super::journal::Journal;
use super::place::parent;
use super::temporary::{self, Begun};

/// A complete file, and where it belongs.
pub(super) struct Complete {
    pub(super) file: NamedTempFile<File>,
    pub(super) place: PathBuf,
    /// The SHA-256 of what is in it.
    pub(super) hash: String,
}

/// Puts files in their places. If one cannot go there, those before it are taken back; which one it was, and why.
///
/// Each goes there in one step, and a signal is heard after the last; of a process that is killed in between the next one
/// does the rest.
pub(super) fn put(files: Vec<Complete>) -> Result<(), (PathBuf, io::Error)> {
    put_one_by_one(files, |_| ())
}

/// As [`put`]; `between` is told how many are in their places, before the first and after each.
pub(super) fn put_one_by_one(
    files: Vec<Complete>,
    between: impl Fn(usize),
) -> Result<(), (PathBuf, io::Error)> {
    let mut old = Vec::with_capacity(files.len());
    // A single file goes or does not go.
    for Complete { place, .. } in files.iter().filter(|_| files.len() > 1) {
        old.push(match fs::exists(place) {
            Ok(false) => None,
            _ => Some(temporary::kept(place, parent(place)).map_err(|error| (place.clone(), error))?),
        });
    }
    let journal = match files.as_slice() {
        [first, _, ..] => Some(Journal::begin(&files).map_err(|error| (first.place.clone(), error))?),
        _ => None,
    };
    let _held = Begun::hold();
    let mut done = Vec::with_capacity(files.len());
    between(0);
    for Complete { file, place, .. } in files {
        if let Err(error) = file.persist(&place) {
            drop(journal);
            take_back(done.into_iter().zip(old));
            return Err((place, error.error));
        }
        done.push(place);
        between(done.len());
    }
    Ok(())
}

fn take_back(places: impl Iterator<Item = (PathBuf, Option<NamedTempFile<()>>)>) {
    for (place, old) in places {
        // What cannot be taken back stays: there is nothing better to be done.
        let _ = match old {
            Some(old) => old.persist(&place).map_err(|error| error.error),
            None => fs::remove_file(&place),
        };
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    #[test]
    fn if_one_cannot_go_all_stay() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("old"), "as it was").unwrap();
        let complete = |name: &str| {
            let mut file = temporary::file(folder.path(), None).unwrap();
            file.write_all(b"new").unwrap();
            Complete { file, place: path(name), hash: abbe_study::hash::of_text("new") }
        };
        let files = vec![complete("old"), complete("new"), complete("folder")];
        fs::create_dir_all(path("folder/with something in it")).unwrap();
        assert_eq!(put(files).unwrap_err().0, path("folder"));
        assert_eq!(fs::read_to_string(path("old")).unwrap(), "as it was");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
        put(vec![complete("old"), complete("new")]).unwrap();
        assert_eq!(["old", "new"].map(|name| fs::read_to_string(path(name)).unwrap()), ["new", "new"]);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
    }
}
