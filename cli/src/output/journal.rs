//! What a set of files is about to become, written down before the first goes to its place. Who is killed between two of them
//! leaves this behind, and the next run that writes in one of their folders puts the others in their places.
//!
//! Only if all are as they were left: what somebody changed since is somebody's.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

use abbe_study::hash;
use serde::{Deserialize, Serialize};
use tempfile::NamedTempFile;

use super::place::parent;
use super::places::Complete;
use super::temporary;

/// A file that goes to its place, by paths without links and by what is in it.
#[derive(Debug, Serialize, Deserialize)]
struct Move {
    from: OsString,
    to: OsString,
    /// The SHA-256 of what is in the place before; none if nothing is.
    old: Option<String>,
    new: String,
}

/// The journal of a set, in each of its folders; it goes when it is dropped.
#[derive(Debug)]
pub(super) struct Journal {
    _copies: Vec<NamedTempFile<File>>,
}

impl Journal {
    /// Writes it to the disk.
    pub(super) fn begin(files: &[Complete]) -> io::Result<Self> {
        let mut moves = Vec::with_capacity(files.len());
        let mut folders: Vec<&Path> = Vec::new();
        for Complete { file, place, hash } in files {
            let old = fs::exists(place)?.then(|| hash_of(place)).transpose()?;
            let from = std::path::absolute(file.path())?.into_os_string();
            moves.push(Move { from, to: place.clone().into_os_string(), old, new: hash.clone() });
            folders.push(parent(place));
        }
        folders.sort_unstable();
        folders.dedup();
        let text = serde_json::to_string(&moves)?;
        let copy = |folder: &Path| {
            let mut copy = temporary::journal(folder)?;
            copy.write_all(text.as_bytes())?;
            copy.as_file().sync_all()?;
            Ok(copy)
        };
        Ok(Self { _copies: folders.into_iter().map(copy).collect::<io::Result<_>>()? })
    }
}

/// Ends what is written in a journal, if all files are as whoever wrote it left them.
pub(super) fn complete(journal: &Path) {
    // A journal that is not whole was killed before the first file went.
    let Some(moves) = fs::read(journal).ok().and_then(|text| serde_json::from_slice::<Vec<Move>>(&text).ok())
    else {
        return;
    };
    if moves.iter().all(|one| one.is_pending() || one.is_done()) {
        for one in moves.iter().filter(|one| one.is_pending()) {
            let _ = fs::rename(&one.from, &one.to);
        }
    }
}

impl Move {
    fn is_pending(&self) -> bool {
        is(&self.from, Some(&self.new)) && is(&self.to, self.old.as_ref())
    }

    fn is_done(&self) -> bool {
        is(&self.from, None) && is(&self.to, Some(&self.new))
    }
}

/// Whether this is in a file, or the file is not there.
fn is(file: &OsString, hash: Option<&String>) -> bool {
    match fs::symlink_metadata(file) {
        Ok(found) => found.is_file() && hash.is_some() && hash_of(Path::new(file)).ok().as_ref() == hash,
        Err(error) => error.kind() == io::ErrorKind::NotFound && hash.is_none(),
    }
}

fn hash_of(file: &Path) -> io::Result<String> {
    hash::of_reader(File::open(file)?)
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::process::ExitStatusExt;
    use std::path::PathBuf;
    use std::process::{Command, Stdio};

    use super::super::places::put_one_by_one;
    use super::*;

    /// In whose folder the process of this name is to be killed, and after how many files.
    const KILLED: &str = "ABBE_TEST_KILLED";

    const NAMES: [&str; 4] = ["a", "b/new", "c", "b/d"];

    /// What each is, before and after; one is new.
    fn states(folder: &Path) -> Vec<Option<String>> {
        NAMES.iter().map(|name| fs::read_to_string(folder.join(name)).ok()).collect()
    }

    fn old() -> Vec<Option<String>> {
        NAMES.map(|name| (!name.contains("new")).then(|| format!("old {name}"))).to_vec()
    }

    fn new() -> Vec<Option<String>> {
        NAMES.map(|name| Some(format!("new {name}"))).to_vec()
    }

    fn prepared() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("b")).unwrap();
        for (name, text) in NAMES.iter().zip(old()) {
            text.iter().for_each(|text| fs::write(folder.path().join(name), text).unwrap());
        }
        folder
    }

    fn files(folder: &Path) -> Vec<Complete> {
        let folder = fs::canonicalize(folder).unwrap();
        let file = |(name, text): (&str, Option<String>)| {
            let place = folder.join(name);
            let mut file = temporary::file(parent(&place), None).unwrap();
            file.write_all(text.as_ref().unwrap().as_bytes()).unwrap();
            Complete { file, place, hash: hash::of_text(&text.unwrap()) }
        };
        NAMES.into_iter().zip(new()).map(file).collect()
    }

    /// Only what `killed` starts does anything here.
    #[test]
    fn process_that_is_killed() {
        let Some(told) = std::env::var_os(KILLED) else { return };
        let told = told.into_string().unwrap();
        let (after, folder) = told.split_once(' ').unwrap();
        let after: usize = after.parse().unwrap();
        let own = nix::unistd::Pid::this();
        let kill = |done: usize| {
            if done == after {
                nix::sys::signal::kill(own, nix::sys::signal::SIGKILL).unwrap();
            }
        };
        put_one_by_one(files(Path::new(folder)), kill).unwrap();
    }

    /// A process that is killed when so many files are in their places.
    fn killed(folder: &Path, after: usize) {
        let status = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "output::journal::tests::process_that_is_killed", "--nocapture"])
            .env(KILLED, format!("{after} {}", folder.display()))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .unwrap();
        assert_eq!(status.signal(), Some(9));
        let (old, new) = (old(), new());
        let expected: Vec<_> =
            (0..NAMES.len()).map(|i| if i < after { &new } else { &old }[i].clone()).collect();
        assert_eq!(states(folder), expected);
    }

    fn left(folder: &Path) -> Vec<PathBuf> {
        let entries =
            [folder.to_owned(), folder.join("b")].into_iter().flat_map(|f| fs::read_dir(f).unwrap());
        entries
            .map(|entry| entry.unwrap().path())
            .filter(|path| path.to_string_lossy().contains(".abbe-"))
            .collect()
    }

    /// Wherever between two files it is killed, and in whichever of its folders the next run writes first.
    #[test]
    fn a_set_in_halves_is_completed_by_the_next_run() {
        for after in 0..=NAMES.len() {
            for folders in [["", "b"], ["b", ""]] {
                let folder = prepared();
                killed(folder.path(), after);
                assert!(left(folder.path()).len() >= 2);
                temporary::clear_stale(&folder.path().join(folders[0]));
                assert_eq!(states(folder.path()), new(), "killed after {after}");
                temporary::clear_stale(&folder.path().join(folders[1]));
                assert_eq!(states(folder.path()), new());
                assert_eq!(left(folder.path()), [""; 0].map(PathBuf::from));
            }
        }
    }

    #[test]
    fn what_somebody_changed_since_stays() {
        for after in 0..=NAMES.len() {
            for (changed, name) in NAMES.iter().enumerate() {
                let folder = prepared();
                killed(folder.path(), after);
                fs::write(folder.path().join(name), "by hand").unwrap();
                let before = states(folder.path());
                assert_eq!(before[changed].as_deref(), Some("by hand"));
                temporary::clear_stale(&folder.path().join("b"));
                temporary::clear_stale(folder.path());
                assert_eq!(states(folder.path()), before);
                assert!(left(folder.path()).is_empty());
            }
        }
    }
}
