//! From routines to source text: formatted, documented, the same bytes every time.
//!
//! `statements` says what a routine does, one small `statement` after the other; `body` does so for a program, with
//! an `expression` of a language's operators where a step needs no name, and `names` for everything. `layout` sets lines,
//! `flat` has arrays as flat ones, `compensated` the numbers of corrected commands, `header` and `text` are what stands in
//! comments, `records` what a manipulator has. A language is a folder: how it writes operators, numbers, statements, a
//! function, corrected commands, and what is around it.

mod body;
mod c;
mod compensated;
mod expression;
mod flat;
mod fmu;
mod header;
mod javascript;
mod layout;
mod matlab;
mod names;
mod python;
mod records;
pub mod rust;
mod source_file;
mod statement;
mod statements;
mod text;

pub use c::Real;
pub use fmu::Fmi;
pub use source_file::SourceFile;

use abbe_spec::Spec;

use crate::chain::Model;
use crate::program::Routines;

/// A language that is generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// A module for the crate `abbe`.
    Rust,
    /// A header and a source in C99, and what they compute in.
    C(Real),
    /// An ES module of pure functions.
    JavaScript,
    /// A module of functions on arrays of NumPy.
    Python,
    /// A class of static functions, for Matlab and Octave.
    Matlab,
    /// The files of a functional mock-up unit, whose archive simulators load.
    Fmu(Fmi),
}

impl Language {
    /// All of them; C and the unit as they are without being asked for something else.
    pub const ALL: [Self; 6] = [
        Self::Rust,
        Self::C(Real::Double),
        Self::JavaScript,
        Self::Python,
        Self::Matlab,
        Self::Fmu(Fmi::Three),
    ];

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rust => "rust",
            Self::C(_) => "c",
            Self::JavaScript => "js",
            Self::Python => "python",
            Self::Matlab => "matlab",
            Self::Fmu(_) => "fmu",
        }
    }

    /// A number of the manipulator that the code could not hold.
    pub fn lost(self, spec: &Spec) -> Option<f64> {
        match self {
            Self::C(real @ Real::Float) => c::lost(spec, &Routines::new(spec, &Model::new(spec)), real),
            _ => None,
        }
    }

    /// The code of a manipulator: one file, or several that belong together.
    pub fn files(self, spec: &Spec) -> Vec<SourceFile> {
        let tunable = matches!(self, Self::Fmu(_)).then(|| spec.with_magnitudes_as_inputs());
        let spec = tunable.as_ref().unwrap_or(spec);
        let model = Model::new(spec);
        let routines = Routines::new(spec, &model);
        let one =
            |extension: &str, text| vec![SourceFile { name: format!("{}.{extension}", spec.name), text }];
        match self {
            Self::Rust => one("rs", rust::module(spec, &model, &routines)),
            Self::C(real) => c::files(spec, &model, &routines, real),
            Self::JavaScript => one("js", javascript::module(spec, &routines)),
            Self::Python => one("py", python::module(spec, &routines)),
            Self::Matlab => vec![matlab::class(spec, &routines)],
            Self::Fmu(fmi) => fmu::files(spec, &model, &routines, fmi),
        }
    }
}

/// The source of a manipulator's module, `pub mod name { … }`.
pub fn rust(spec: &Spec) -> String {
    let model = Model::new(spec);
    rust::module(spec, &model, &Routines::new(spec, &model))
}
