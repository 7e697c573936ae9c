//! Prints routines as source text: formatted, documented and deterministic.
//!
//! `statements` converts a routine to language-independent statements; `body` does so
//! for a program, with an `expression` for each step that needs no name and `names` for the rest.
//! `layout` lays out lines, `flat` indexes flat arrays, `lists` has the tables of loops and the
//! description of a manipulator. A language with flat arrays implements the trait of `procedure`,
//! by which `procedure` prints the procedures and `routine` the statements. `header` prints
//! documentation. Each language is a folder with its
//! operators, numbers, statements, functions, corrected commands and the surrounding module.

mod body;
mod c;
mod expression;
mod flat;
mod fmu;
mod header;
mod javascript;
mod layout;
mod lists;
mod matlab;
mod names;
mod procedure;
mod python;
mod routine;
pub mod rust;
mod statements;
mod structured_text;

pub use c::Real;
pub use fmu::Fmi;
pub use layout::SourceFile;

use abbe_spec::Spec;

use crate::{chain::Model, procedure::Precision, program::Routines};

use expression::{Binding, Expression, Statement, Syntax, Value, arithmetic, infix, literal};
use flat::{Flat, Results, filled};
use layout::{
    LINE, NARROW, NOT_CLOSED, OPEN, Writer, array, call, described, escaped, fits, harmless, pattern, sizes,
    width, wrapped,
};
use names::{Identifiers, Names, distinct, file_name, function_of, renamed};
use procedure::{Called, Invocation, Printer, arrays, commands};
use statements::Statements;

/// A target language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// A module for the crate `abbe`.
    Rust,
    /// A header and a source in C99, with the floating-point type that they compute in.
    C(Real),
    /// An ES module of pure functions.
    JavaScript,
    /// A module of functions on arrays of NumPy.
    Python,
    /// A class of static functions, for Matlab and Octave.
    Matlab,
    /// Function blocks in Structured Text of IEC 61131-3, for programmable logic controllers.
    StructuredText,
    /// Function blocks as a PLCopen document, which development environments import.
    Plcopen,
    /// The files of a functional mock-up unit, an archive that simulators load.
    Fmu(Fmi),
}

impl Language {
    /// Every language; C and the functional mock-up unit in their default variant.
    pub const ALL: [Self; 8] = [
        Self::Rust,
        Self::C(Real::Double),
        Self::JavaScript,
        Self::Python,
        Self::Matlab,
        Self::StructuredText,
        Self::Plcopen,
        Self::Fmu(Fmi::Three),
    ];

    /// Returns the name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rust => "rust",
            Self::C(_) => "c",
            Self::JavaScript => "js",
            Self::Python => "python",
            Self::Matlab => "matlab",
            Self::StructuredText => "st",
            Self::Plcopen => "plcopen",
            Self::Fmu(_) => "fmu",
        }
    }

    /// Returns the names of the functions that the code of a manipulator can consist of. Empty if
    /// the code is one whole.
    pub fn functions(self, spec: &Spec) -> Vec<&'static str> {
        match self {
            Self::Rust | Self::Fmu(_) => Vec::new(),
            _ => Routines::new(spec, &Model::new(spec)).selectable(),
        }
    }

    /// Returns a number of the manipulator that the code cannot represent, if any.
    pub fn lost(self, spec: &Spec) -> Option<f64> {
        match self {
            Self::C(real @ Real::Float) => c::lost(spec, &Routines::new(spec, &Model::new(spec)), real),
            _ => None,
        }
    }

    /// Returns the code of a manipulator: one file, or several that belong together.
    pub fn files(self, spec: &Spec) -> Vec<SourceFile> {
        self.files_with(spec, |routines| match self {
            // Functions on arrays without elements.
            Self::C(_) => routines.meaningful(),
            Self::Fmu(_) => fmu::FUNCTIONS.to_vec(),
            _ => routines.exported.clone(),
        })
    }

    /// Returns the code of some of the [`functions`](Self::functions) of a manipulator.
    pub fn files_of(self, spec: &Spec, functions: &[&'static str]) -> Vec<SourceFile> {
        self.files_with(spec, |_| functions.to_vec())
    }

    fn files_with(
        self,
        spec: &Spec,
        functions: impl FnOnce(&Routines) -> Vec<&'static str>,
    ) -> Vec<SourceFile> {
        let tunable = matches!(self, Self::Fmu(_)).then(|| spec.with_magnitudes_as_inputs());
        let spec = tunable.as_ref().unwrap_or(spec);
        let precision = if let Self::C(real) = self { real.precision() } else { Precision::Double };
        let model = Model::with_precision(spec, precision);
        let routines = Routines::new(spec, &model);
        let functions = functions(&routines);
        let routines = routines.only(&functions);
        let one =
            |extension: &str, text| vec![SourceFile { name: format!("{}.{extension}", spec.name), text }];
        match self {
            Self::Rust => one("rs", rust::module(spec, &model, &routines)),
            Self::C(real) => c::files(spec, &model, &routines, real),
            Self::JavaScript => one("js", javascript::module(spec, &routines)),
            Self::Python => vec![python::file(spec, &routines)],
            Self::Matlab => vec![matlab::class(spec, &routines)],
            Self::StructuredText => one("st", structured_text::text(spec, &routines)),
            Self::Plcopen => {
                let text = structured_text::text(spec, &routines);
                one("xml", structured_text::plcopen::document(&spec.name, &text))
            }
            Self::Fmu(fmi) => fmu::files(spec, &model, &routines, fmi),
        }
    }
}

/// Returns the source of a manipulator's Rust module, `pub mod name { … }`.
pub fn rust(spec: &Spec) -> String {
    let model = Model::new(spec);
    rust::module(spec, &model, &Routines::new(spec, &model))
}
