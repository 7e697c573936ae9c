//! The files that a command writes: none of what it reads, none that somebody else wrote, and all of them or none.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

use abbe_study::Reads;
use abbe_study::data::Heading;

use super::identity::Identity;
use super::pending::{Content, Pending, Rows};
use super::place::{Place, is_stdout, parent};
use super::places::{Complete, put};
use super::temporary::{self, Folders};
use super::{Printed, cannot_write, note, print, record};
use crate::failure::Failure;

/// What a command is about to write.
#[derive(Debug)]
pub(crate) struct Outputs {
    inputs: Vec<(PathBuf, Identity)>,
    force: bool,
    /// Where something will be.
    taken: Vec<Place>,
    /// Folders in which something will be, by their paths without links.
    cleared: Vec<PathBuf>,
    made: Vec<Folders>,
}

impl Outputs {
    /// Those of a job. What it was read from is never written over, not even by `force`.
    pub(crate) fn new(job: &impl Reads, force: bool) -> Self {
        let inputs = job.files().into_iter().filter_map(|file| Some((file.clone(), Identity::of(&file)?)));
        Self { inputs: inputs.collect(), force, taken: Vec::new(), cleared: Vec::new(), made: Vec::new() }
    }

    /// Begins a file, or says why it must not be written. It is in its place after [`finish`](Self::finish).
    pub(crate) fn file(&mut self, path: &Path) -> Result<Pending, Failure> {
        let place = Place::find(path)?;
        self.check(path, &place)?;
        if self.taken.contains(&place) {
            return Err(Failure::of(path.display(), "two results of this run would be written there")
                .help("give each a file of its own"));
        }
        if let Place::File(file) = &place {
            let folder = parent(file).to_owned();
            if !self.cleared.contains(&folder) {
                temporary::clear_stale(&folder);
                self.cleared.push(folder);
            }
        }
        self.taken.push(place.clone());
        Pending::begin(path, place)
    }

    /// As [`file`](Self::file), if one is wanted.
    pub(crate) fn wanted(&mut self, path: Option<&Path>) -> Result<Option<Pending>, Failure> {
        path.map(|path| self.file(path)).transpose()
    }

    /// As [`file`](Self::file), for a table that is written row by row.
    pub(crate) fn rows(&mut self, path: &Path, heading: &Heading) -> Result<Rows, Failure> {
        Rows::new(self.file(path)?, heading)
    }

    /// Makes a folder for files, or says why none must be written there.
    pub(crate) fn folder(&mut self, path: &Path) -> Result<(), Failure> {
        if is_stdout(path) || (path.exists() && !path.is_dir()) {
            return Err(
                Failure::of(path.display(), "this is a file, not a folder").help("--out takes a folder")
            );
        }
        if path.is_dir() {
            temporary::clear_stale(path);
            let mut others = fs::read_dir(path).map_err(|error| cannot_write(path, &error))?.flatten();
            let any = others.any(|entry| !temporary::is_one(&entry.file_name()));
            if any && !self.force && !record::is_in(path) {
                let help = "name another folder, or give `--force`: files of the same names are replaced, others stay";
                let message = "there are files in this folder, and none was written by abbe";
                return Err(Failure::of(path.display(), message).help(help));
            }
        }
        self.made.push(temporary::folder(path).map_err(|error| cannot_write(path, &error))?);
        Ok(())
    }

    /// Whether a place may be written.
    fn check(&self, path: &Path, place: &Place) -> Result<(), Failure> {
        let here = Identity::of(path);
        if let Some((input, _)) = self.inputs.iter().find(|(_, input)| here.as_ref() == Some(input)) {
            let message = match input == path {
                true => "this run reads this file, and would write over it".to_owned(),
                false => format!("this is {}, which this run reads, and would write over", input.display()),
            };
            return Err(Failure::of(path.display(), message).help("name another file for the result"));
        }
        let Place::File(file) = place else { return Ok(()) };
        let Ok(old) = fs::metadata(file) else { return Ok(()) };
        if self.force {
            return Ok(());
        }
        let help = "name another file, or replace it with `--force`";
        if old.permissions().readonly() {
            return Err(Failure::of(path.display(), "this file may only be read").help(help));
        }
        match record::is_ours(file) {
            Ok(true) => Ok(()),
            Ok(false) => {
                let message = "this file was not written by abbe, or was changed since";
                Err(Failure::of(path.display(), message).help(help))
            }
            Err(error) => Err(cannot_write(path, &error).help(help)),
        }
    }

    /// Puts the files in their places, now that all are complete: all of them, or none.
    ///
    /// What is written through to a pipe or a device goes first: it may fail, and cannot be taken back.
    pub(crate) fn finish(self, files: impl IntoIterator<Item = Pending>) -> Result<Printed, Failure> {
        let (mut complete, mut names, mut written) = (Vec::new(), Vec::new(), Vec::new());
        let mut printed = Printed(false);
        let mut through = Vec::new();
        for file in files {
            let hash = file.hash();
            self.check(&file.path, &file.place)?;
            match (file.place, file.content) {
                (Place::File(place), Content::Beside(content)) => {
                    // A disk that is full may say so only now.
                    content.as_file().sync_data().map_err(|error| cannot_write(&file.path, &error))?;
                    written.push((place.clone(), hash.clone()));
                    names.push(file.path);
                    complete.push(Complete { file: content, place, hash });
                }
                (place, Content::Apart(content)) => through.push((file.path, place, content)),
                (_, Content::Beside(_)) => {}
            }
        }
        for (path, place, mut content) in through {
            content.rewind().map_err(|error| cannot_write(&path, &error))?;
            match place {
                Place::Stdout => {
                    print(&mut content)?;
                    printed = Printed(true);
                }
                _ => write_through(&path, &mut content).map_err(|error| cannot_write(&path, &error))?,
            }
        }
        remember(&written);
        let named = |place: &Path| {
            let index = written.iter().position(|(written, _)| written == place);
            index.map_or(place, |index| &names[index]).to_owned()
        };
        put(complete).map_err(|(place, error)| cannot_write(&named(&place), &error))?;
        Ok(printed)
    }
}

/// Writes to what is no regular file, or is opened already: at its end.
fn write_through(path: &Path, content: &mut impl Read) -> io::Result<()> {
    let mut file = File::options().append(true).open(path)?;
    io::copy(content, &mut file)?;
    file.flush()
}

/// Notes what will be written, before it is: whoever is killed in between leaves files that are known.
fn remember(files: &[(PathBuf, String)]) {
    let mut folders: BTreeMap<&Path, Vec<(&OsStr, String)>> = BTreeMap::new();
    for (file, hash) in files {
        let name = file.file_name().unwrap_or_default();
        folders.entry(parent(file)).or_default().push((name, hash.clone()));
    }
    for (folder, files) in folders {
        if let Err(error) = record::add(folder, &files) {
            let folder = folder.display();
            note(&format!(
                "note: {folder}: what was written cannot be noted ({error}); to write it anew will need --force"
            ));
        }
    }
}
