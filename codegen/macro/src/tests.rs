//! Tests of `src`.

use abbe_codegen::print;
use abbe_spec::Spec;
use proc_macro2::Span;

use super::*;

fn expanded(file: &str) -> syn::Result<proc_macro2::TokenStream> {
    expand(&LitStr::new(file, Span::call_site()))
}

#[test]
fn the_macro_gives_the_code_that_the_other_doors_write() {
    let file = "../../manipulators/specs/pps.toml";
    let spec = Spec::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap();
    let written: proc_macro2::TokenStream = print::rust(&spec).parse().unwrap();
    let expanded = expanded(file).unwrap().to_string();
    let watched = expanded.strip_prefix(&written.to_string()).unwrap();
    assert!(watched.contains("include_bytes"));
}

#[test]
fn the_macro_shows_the_mistakes_that_the_other_doors_show() {
    let file = "../../tests/bad-specs/several_expressions.toml";
    let mut shown = Spec::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap_err();
    shown.path = file.to_owned();
    let error = expanded(file).unwrap_err().to_string();
    assert_eq!(error, format!("mistakes in the spec\n{shown}"));
    assert!(expanded("missing.toml").unwrap_err().to_string().contains("cannot read this file"));
}
