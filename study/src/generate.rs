//! The closed form of a manipulator as source code.

use std::io::{Cursor, Write};

use abbe_codegen::diagnostic::Diagnostics;
pub use abbe_codegen::print::{Fmi, Language, SourceFile};
use zip::write::SimpleFileOptions;
use zip::{DateTime, ZipWriter};

use crate::machine::Machine;
use crate::notes::Notes;

/// What is the code of this manipulator?
#[derive(Clone)]
pub struct Generate {
    /// Whose.
    pub machine: Machine,
    /// In which language.
    pub language: Language,
}

impl Generate {
    /// The files: one, or several that belong together. The same spec gives the same bytes.
    pub fn run(&self, _: &mut dyn Notes) -> Result<Vec<SourceFile>, Diagnostics> {
        Ok(self.language.files(&self.machine.spec))
    }
}

/// A zip archive of files, as simulators load a functional mock-up unit. The same files give the same bytes: all are of 1980.
pub fn archive(files: &[SourceFile]) -> Vec<u8> {
    let options = SimpleFileOptions::DEFAULT.last_modified_time(DateTime::DEFAULT).unix_permissions(0o644);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for file in files {
        archive.start_file(&*file.name, options).expect("there is room in memory, and names differ");
        archive.write_all(file.text.as_bytes()).expect("there is room in memory");
    }
    archive.finish().expect("there is room in memory").into_inner()
}
