//! The closed form of a manipulator as source code.

pub use abbe_codegen::print::{Fmi, Language, Real, SourceFile};
use abbe_spec::diagnostic::Diagnostics;

pub use crate::archive::archive;
use crate::machine::Machine;
use crate::mistake;
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
