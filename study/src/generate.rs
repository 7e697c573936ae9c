//! Closed form of a manipulator as source code.

use abbe_spec::option::{NAME, ONLY, REAL_FLOAT};
use std::borrow::Cow;

pub use abbe_codegen::print::{Fmi, Language, Real, SourceFile};
use abbe_spec::value::find_name;
use abbe_spec::{Document, Spec, check_name};

pub use crate::archive::archive;
use crate::{Machine, Notes, Result, mistake, options::Choices};

/// Job of `abbe generate`: writes the code of a manipulator.
#[derive(Clone)]
pub struct Generate {
    /// Machine to generate code for.
    pub machine: Machine,
    /// Target language.
    pub language: Language,
    /// Functions to write, separated by commas; `None` for all.
    pub only: Option<String>,
    /// Name in the code instead of the manipulator's own.
    pub name: Option<String>,
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
    pub const LANGUAGES: Choices<Language> = all!(Language: 0 1 2 3 4 5 6 7);

    /// Floating-point types for C.
    pub const REALS: Choices<Real> = all!(Real: 0 1);

    /// Versions of FMI.
    pub const VERSIONS: Choices<Fmi> = all!(Fmi: 0 1);

    /// Returns the generated files, one or several. The bytes depend only on the spec and the
    /// options. Fails if the language has no such function, the name is not valid, or a number of
    /// the spec does not fit the language's floating-point type.
    pub fn run(&self, _: &mut dyn Notes) -> Result<Vec<SourceFile>> {
        let mut spec = Cow::Borrowed(&*self.machine.spec);
        if let Some(name) = &self.name {
            check_name(NAME, name)?;
            spec.to_mut().name.clone_from(name);
        }
        if let Some(number) = self.language.lost(&spec) {
            return Err(mistake::with_help(
                &spec.file,
                format!(
                    "the code contains the number {number:e}, which single precision cannot \
                    represent"
                ),
                format!("remove `{REAL_FLOAT}`, or check the units of the spec"),
            ));
        }
        match &self.only {
            None => Ok(self.language.files(&spec)),
            Some(only) => Ok(self.language.files_of(&spec, &self.selected(only, &spec)?)),
        }
    }

    /// Returns the functions of a list of names.
    fn selected(&self, only: &str, spec: &Spec) -> Result<Vec<&'static str>> {
        let possible = self.language.functions(spec);
        if possible.is_empty() {
            let message = format!("`{ONLY}` has no effect on {}", self.language.name());
            let help = format!("choose another language, or leave `{ONLY}` out");
            return Err(mistake::with_help(ONLY, message, help));
        }
        let document = Document::new(ONLY, only);
        let mut found = Vec::new();
        let mut start = 0;
        for name in only.split(',') {
            let at = start + name.len() - name.trim_start().len();
            start += name.len() + 1;
            let name = name.trim();
            let index = find_name(&document, at..at + name.len(), name, &possible, "function");
            found.extend(index.map(|index| possible[index]));
        }
        document.finish(Some(found))
    }
}
