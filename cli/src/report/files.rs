//! The files of a report: complete, or not there.

use std::io::Write;
use std::path::Path;

use crate::failure::Failure;
use crate::output::{Pending, cannot_write};

/// The files of a report, in memory.
#[derive(Debug)]
pub(crate) struct Rendered(pub(super) Vec<(String, String)>);

/// Files that are complete and wait to be put in their places.
#[derive(Debug)]
pub(crate) struct Complete(Vec<Pending>);

impl Rendered {
    /// Writes the files beside their places in a folder.
    pub(crate) fn write(self, folder: &Path) -> Result<Complete, Failure> {
        let files = self.0.into_iter().map(|(name, text)| {
            let path = folder.join(name);
            let mut file = Pending::create(&path)?;
            file.write_all(text.as_bytes()).map_err(|error| cannot_write(&path, &error))?;
            Ok(file)
        });
        Ok(Complete(files.collect::<Result<_, Failure>>()?))
    }
}

impl Complete {
    /// Puts them in their places.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        self.0.into_iter().try_for_each(Pending::finish)
    }
}
