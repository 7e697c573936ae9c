//! From programs to Rust source: formatted, documented, the same bytes every time.
//!
//! `body` writes the steps of a program as statements, `names` says what they are called; `face` writes what
//! users of a module see, `raw` the array functions behind it, `header` what stands above; `module` puts them
//! together, `long` writes loops for long chains, `writer` lays the lines out.

mod body;
mod face;
mod header;
mod literal;
mod long;
mod module;
mod names;
mod raw;
mod text;
mod writer;

pub use module::{module, rust};
