//! The closed form of a manipulator as source code.

use abbe_codegen::diagnostic::Diagnostics;
pub use abbe_codegen::print::{Language, SourceFile};

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
