//! Output files of a command: never an input, never a file that abbe did not write, and always
//! complete.

use std::fs;
use std::path::{Path, PathBuf};

use abbe_study::Reads;
use same_file::Handle;

use super::pending::{PREFIX, Pending, persist};
use super::target::{Target, identity, is_stdout, parent};
use super::{Printed, cannot_write, folders, note, record};
use crate::{Result, failure::Failure};

/// Output files of one run.
#[derive(Debug)]
pub(crate) struct Outputs {
    inputs: Vec<(PathBuf, Handle)>,
    force: bool,
    /// Target paths of the output files opened so far.
    taken: Vec<Target>,
}

impl Outputs {
    /// Creates the outputs of a job. The files that it reads are never replaced, not even with
    /// `force`.
    pub(crate) fn new(job: &impl Reads, force: bool) -> Self {
        let inputs = job.files().into_iter().filter_map(|file| Some((file.clone(), identity(&file)?)));
        Self { inputs: inputs.collect(), force, taken: Vec::new() }
    }

    /// Begins a file. [`finish`](Self::finish) moves it to its path.
    ///
    /// # Errors
    ///
    /// The path is an input, belongs to another result of this run, or holds a file that abbe did
    /// not write.
    pub(crate) fn file(&mut self, path: &Path) -> Result<Pending> {
        let target = Target::find(path)?;
        self.check(path, &target)?;
        if self.taken.contains(&target) {
            return Err(Failure::new(path.display(), "two outputs of this command have this path")
                .help("give each its own file"));
        }
        self.taken.push(target.clone());
        Pending::begin(path, target)
    }

    /// Begins a file if a path is given; see [`file`](Self::file).
    pub(crate) fn wanted(&mut self, path: Option<&Path>) -> Result<Option<Pending>> {
        path.map(|path| self.file(path)).transpose()
    }

    /// Makes a folder for files.
    ///
    /// # Errors
    ///
    /// The path is a file, or a folder with files that abbe did not write.
    pub(crate) fn folder(&mut self, path: &Path) -> Result<()> {
        if is_stdout(path) || (path.exists() && !path.is_dir()) {
            let failure = Failure::new(path.display(), "this is a file, not a folder");
            return Err(failure.help("--out takes a folder"));
        }
        if path.is_dir() && !self.force && !record::is_in(path) {
            let mut others = fs::read_dir(path).map_err(|error| cannot_write(path, &error))?.flatten();
            if others.any(|entry| !entry.file_name().as_encoded_bytes().starts_with(PREFIX.as_bytes())) {
                let help = "choose another folder, or use `--force` to replace files of the same \
                    names; others stay";
                let message = "this folder contains files, and abbe wrote none of them";
                return Err(Failure::new(path.display(), message).help(help));
            }
        }
        folders::make(path).map_err(|error| cannot_write(path, &error))
    }

    /// Checks that a path, and the file that it resolves to, may be written.
    fn check(&self, path: &Path, target: &Target) -> Result<()> {
        let here = identity(path);
        if let Some((input, _)) = self.inputs.iter().find(|(_, input)| here.as_ref() == Some(input)) {
            let message = if input == path {
                "this file is an input of the command and cannot be overwritten".to_owned()
            } else {
                format!("this is {}, an input of the command, and cannot be overwritten", input.display())
            };
            return Err(Failure::new(path.display(), message).help("choose another file for the output"));
        }
        let Target::File(file) = target else { return Ok(()) };
        let Some(old) = fs::metadata(file).ok().filter(|_| !self.force) else { return Ok(()) };
        let refused = |message| Failure::new(path.display(), message);
        let failure = match record::is_ours(file) {
            _ if old.permissions().readonly() => refused("this file is read-only"),
            Ok(true) => return Ok(()),
            Ok(false) => refused("abbe did not write this file, or it was changed since"),
            Err(error) if cfg!(windows) => return Err(cannot_write(path, &error)),
            Err(error) => cannot_write(path, &error),
        };
        Err(failure.help("choose another file, or use `--force` to replace this one"))
    }

    /// Writes files with these texts, as [`finish`](Self::finish) does.
    pub(crate) fn write<'t, T: AsRef<[u8]> + 't>(
        mut self,
        files: impl IntoIterator<Item = (PathBuf, &'t T)>,
    ) -> Result<Printed> {
        let files = files.into_iter().map(|(path, text)| self.file(&path)?.fill(text));
        let files = files.collect::<Result<Vec<_>>>()?;
        self.finish(files)
    }

    /// Moves the complete files to their paths, each in one step. Signals wait until all are moved.
    ///
    /// Pipes and devices are written first: they may fail, and cannot be undone.
    pub(crate) fn finish(self, files: impl IntoIterator<Item = Pending>) -> Result<Printed> {
        let (files, streams): (Vec<_>, Vec<_>) = files.into_iter().partition(Pending::is_file);
        let printed = Printed(streams.iter().any(|stream| stream.target == Target::Stdout));
        for file in files.iter().chain(&streams) {
            self.check(&file.path, &file.target)?;
            file.target.is_where_it_was(&file.path)?;
        }
        streams.into_iter().try_for_each(Pending::write_through)?;
        let _held = folders::hold();
        let mut complete = Vec::with_capacity(files.len());
        for mut pending in files {
            let Target::File(file) = pending.target.clone() else { continue };
            let (new, hash) = pending.complete(&file).map_err(|error| cannot_write(&pending.path, &error))?;
            complete.push((pending.path, file, new, hash));
        }
        // Recorded before they are moved: if the process is killed in between, the files are known.
        let unknown =
            complete.iter().filter_map(|(_, file, _, hash)| Some((file, record::add(file, hash).err()?)));
        if let Some((file, error)) = unknown.reduce(|first, _| first) {
            let folder = parent(file).display();
            note(&format!(
                "note: {folder}: cannot record which files were written ({error}); replacing them \
                 will need --force"
            ));
        }
        for (path, file, new, _) in complete {
            persist(new, &file).map_err(|error| cannot_write(&path, &error))?;
        }
        Ok(printed)
    }
}

/// Removes folders that were made but are still empty.
impl Drop for Outputs {
    fn drop(&mut self) {
        folders::remove_empty(&folders::hold());
    }
}

#[cfg(all(test, unix))]
mod tests;
