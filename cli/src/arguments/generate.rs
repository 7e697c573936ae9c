use std::ffi::OsString;
use std::path::PathBuf;

use abbe_codegen::print::{Fmi, Language, Real};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueHint};

use super::shared::Writing;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe generate arm.toml --out arm.rs
  abbe generate arm.toml --lang c --out controller
  abbe generate arm.toml --lang c --real float --out controller
  abbe generate arm.toml --lang js --out arm.js
  abbe generate arm.toml --lang python --out arm.py
  abbe generate arm.toml --lang matlab --out arm.m
  abbe generate arm.toml --lang fmu --out arm.fmu       for simulators
"))]
pub(crate) struct Generate {
    /// Spec file, or shipped name
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) spec: OsString,
    /// Language of the code
    #[arg(long, value_parser = language(), default_value = Language::Rust.name())]
    pub(crate) lang: Language,
    /// Numbers that C computes in: `float` is for units of single precision [default: double]
    #[arg(long, value_parser = real())]
    pub(crate) real: Option<Real>,
    /// Version of FMI that --lang fmu follows. 3 if not given
    #[arg(long, value_name = "VERSION", value_parser = fmi())]
    pub(crate) fmi: Option<Fmi>,
    /// Write to this file instead of stdout; C, which is two files, to this folder
    #[arg(long, value_name = "PATH")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
}

/// The languages by their names.
fn language() -> impl TypedValueParser<Value = Language> {
    PossibleValuesParser::new(Language::ALL.map(Language::name)).try_map(|name| {
        Language::ALL.into_iter().find(|language| language.name() == name).ok_or("no such language")
    })
}

/// The types of numbers by their names.
fn real() -> impl TypedValueParser<Value = Real> {
    PossibleValuesParser::new(Real::ALL.map(Real::name))
        .try_map(|name| Real::ALL.into_iter().find(|real| real.name() == name).ok_or("no such type"))
}

/// The versions of FMI by their names.
fn fmi() -> impl TypedValueParser<Value = Fmi> {
    PossibleValuesParser::new(Fmi::ALL.map(Fmi::name))
        .try_map(|name| Fmi::ALL.into_iter().find(|fmi| fmi.name() == name).ok_or("no such version"))
}
