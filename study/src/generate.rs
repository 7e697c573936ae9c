//! Closed form of a manipulator as source code.

pub use abbe_codegen::print::{Fmi, Language, Real, SourceFile};
use abbe_spec::diagnostic::Diagnostics;

pub use crate::archive::archive;
use crate::machine::Machine;
use crate::mistake;
use crate::notes::Notes;
use crate::options::Choices;

/// Job of `abbe generate`: writes the code of a manipulator.
#[derive(Clone)]
pub struct Generate {
    /// Machine to generate code for.
    pub machine: Machine,
    /// Target language.
    pub language: Language,
}

/// Creates one entry for each value of a constant `ALL`.
macro_rules! all {
    ($type:ident: $($i:literal)*) => {
        Choices(&[$(($type::ALL[$i], $type::ALL[$i].name(), "")),*])
    };
}

// Every language is offered.
const _: () = assert!(Generate::LANGUAGES.0.len() == Language::ALL.len());

impl Generate {
    /// Target languages, with C and the functional mock-up unit in their default variants.
    pub const LANGUAGES: Choices<Language> = all!(Language: 0 1 2 3 4 5 6);

    /// Floating-point types for C.
    pub const REALS: Choices<Real> = all!(Real: 0 1);

    /// Versions of FMI.
    pub const VERSIONS: Choices<Fmi> = all!(Fmi: 0 1);

    /// Returns the generated files, one or several. The bytes depend only on the spec. Fails if a
    /// number of the spec does not fit the language's floating-point type.
    pub fn run(&self, _: &mut dyn Notes) -> Result<Vec<SourceFile>, Diagnostics> {
        let spec = &self.machine.spec;
        match self.language.lost(spec) {
            None => Ok(self.language.files(spec)),
            Some(number) => Err(mistake::with_help(
                &spec.file,
                format!(
                    "the code contains the number {number:e}, which single precision cannot \
                    represent"
                ),
                "remove `--real float`, or check the units of the spec",
            )),
        }
    }
}
