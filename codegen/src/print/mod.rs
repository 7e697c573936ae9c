//! From routines to source text: formatted, documented, the same bytes every time.
//!
//! `statements` says what a routine does, one small `statement` after the other; `body` does so for a program, with
//! an `expression` of a language's operators where a step needs no name, and `names` for everything. `layout` sets lines, `header` and `text` are what stands in comments. A language
//! is a folder: how it writes operators, numbers, statements, a function and what is around it.

mod body;
mod expression;
mod header;
mod javascript;
mod layout;
mod names;
pub mod rust;
mod statement;
mod statements;
mod text;

use crate::chain::Model;
use crate::program::Routines;
use crate::spec::Spec;

/// A language that is generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// A module for the crate `abbe`.
    Rust,
    /// An ES module of pure functions.
    JavaScript,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Rust, Self::JavaScript];

    /// Its name on the command line, and the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rust => "rust",
            Self::JavaScript => "js",
        }
    }

    /// The source of a manipulator's module.
    pub fn print(self, spec: &Spec) -> String {
        let model = Model::new(spec);
        let routines = Routines::new(spec, &model);
        match self {
            Self::Rust => rust::module(spec, &model, &routines),
            Self::JavaScript => javascript::module(spec, &routines),
        }
    }
}

/// The source of a manipulator's module, `pub mod name { … }`.
pub fn rust(spec: &Spec) -> String {
    Language::Rust.print(spec)
}
