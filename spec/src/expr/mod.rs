//! Expressions: text is parsed to checked terms. Every mistake has a location, and every term a
//! dimension.
//!
//! Expressions consist of `+ - * / ^`, functions, `pi`, numbers with an optional unit, and names.
//! `tokens` splits the text, `parse` finds its structure, `build` checks names and dimensions and
//! folds constants, and `construct` creates expressions without text.

mod build;
mod construct;
mod dimension;
mod expression;
mod function;
mod parse;
mod reach;
mod scope;
mod table;
mod tokens;
mod unit;

pub use dimension::Dimension;
pub use expression::{Binary, Expression, Kind, Lookup, Term};
pub use function::{FUNCTION_NAMES, Function};
pub use parse::{Elementary, Motion, motion};
pub use scope::{Allowed, Entry, Name, Scope, Symbol};
pub use table::{Extrapolation, Interpolation, Table};
pub use unit::{LARGEST, UNIT_NAMES, Unit};

pub(crate) use parse::{parse_expression, parse_transform, parse_unit};
pub(crate) use tokens::{LocatedText, TextLocation, Token, tokens};
pub(crate) use unit::{unit_help, unit_meant, unit_spelling};
