//! The closed form of a manipulator as source code.

pub use abbe_codegen::print::{Fmi, Language, Real, SourceFile};
use abbe_spec::diagnostic::Diagnostics;

pub use crate::archive::archive;
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
