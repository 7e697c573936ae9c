//! Structured Text of IEC 61131-3: a parser and an interpreter of the part that generated files
//! use, which accept nothing that one of the dialects refuses, and stop where a controller would.
//!
//! `lexer` splits a text into tokens, `types` describes variables, `parser` checks declarations and
//! names, `expressions` and `statements` the rest, and `machine` runs blocks.

mod expressions;
mod lexer;
mod machine;
mod parser;
mod statements;
mod types;

pub use self::machine::Instance;
pub use self::parser::Program;
