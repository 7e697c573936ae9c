//! The closed form of a manipulator as source code.

use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::emit;

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

/// A language that code is generated in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// A module of Rust.
    Rust,
}

impl Language {
    /// Every language, with the name that it is asked for by.
    pub const ALL: [(&'static str, Self); 1] = [("rust", Self::Rust)];
}

impl Generate {
    /// The text of the file. The same spec gives the same bytes.
    pub fn run(&self, _: &mut dyn Notes) -> Result<String, Diagnostics> {
        Ok(match self.language {
            Language::Rust => emit::rust(&self.machine.spec),
        })
    }
}
