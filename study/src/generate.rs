//! The closed form of a manipulator as source code.

use std::io::{Cursor, Write};

pub use abbe_codegen::print::{Fmi, Language, Real, SourceFile};
use abbe_spec::diagnostic::Diagnostics;
use zip::write::SimpleFileOptions;
use zip::{DateTime, ZipWriter};

use crate::machine::Machine;
use crate::mistake;
use crate::notes::Notes;
use crate::options::Choices;

/// What is the code of this manipulator?
#[derive(Clone)]
pub struct Generate {
    /// Whose.
    pub machine: Machine,
    /// In which language.
    pub language: Language,
}

/// One entry for each value of a constant `ALL`.
macro_rules! all {
    ($type:ident: $($i:literal)*) => {
        Choices(&[$(($type::ALL[$i], $type::ALL[$i].name(), "")),*])
    };
}

impl Generate {
    /// Languages; C and the functional mock-up unit as they are if nothing else is said.
    pub const LANGUAGES: Choices<Language> = all!(Language: 0 1 2 3 4 5);

    /// Types of numbers of C.
    pub const REALS: Choices<Real> = all!(Real: 0 1);

    /// Versions of FMI.
    pub const VERSIONS: Choices<Fmi> = all!(Fmi: 0 1);

    /// The files: one, or several that belong together. The same spec gives the same bytes. An error if the language's numbers
    /// cannot hold one of the manipulator's.
    pub fn run(&self, _: &mut dyn Notes) -> Result<Vec<SourceFile>, Diagnostics> {
        let spec = &self.machine.spec;
        match self.language.lost(spec) {
            None => Ok(self.language.files(spec)),
            Some(number) => Err(mistake::with_help(
                &spec.file,
                format!("it has the number {number:e}, which single precision cannot hold"),
                "leave `--real float` out; or is the unit of a quantity not the one that was meant?",
            )),
        }
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
