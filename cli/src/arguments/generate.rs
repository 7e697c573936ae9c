use std::ffi::OsString;
use std::path::PathBuf;

use abbe_study::generate::{self, Fmi, Language, Real};
use clap::{Args, ValueHint};

use super::shared::Writing;
use super::values::named;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe generate arm.toml --out arm.rs
  abbe generate arm.toml --lang c --out controller
  abbe generate arm.toml --lang c --real float --out controller
  abbe generate arm.toml --lang c --only compensated,pose --name left_arm --out controller
  abbe generate arm.toml --lang js --out arm.js
  abbe generate arm.toml --lang python --out arm.py
  abbe generate arm.toml --lang matlab --out arm.m
  abbe generate arm.toml --lang st --out arm.st         for CODESYS, TwinCAT and other PLCs
  abbe generate arm.toml --lang fmu --out arm.fmu       for simulators
"))]
pub(crate) struct Generate {
    /// Path of a spec file (TOML), or name of a shipped manipulator
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) spec: OsString,
    /// Language of the generated code
    #[arg(long, value_parser = named(generate::Generate::LANGUAGES), default_value = Language::Rust.name())]
    pub(crate) lang: Language,
    /// Floating-point type of the generated C: `float` for processors with single precision only.
    /// [default: double]
    #[arg(long, value_parser = named(generate::Generate::REALS))]
    pub(crate) real: Option<Real>,
    /// Write only these functions, separated by commas, and what they need; not in Rust and
    /// functional mock-up units. [default: all]
    #[arg(long, value_name = "FUNCTIONS")]
    pub(crate) only: Option<String>,
    /// Name in the code, such that several machines can be linked. [default: the spec's]
    #[arg(long)]
    pub(crate) name: Option<String>,
    /// FMI version of the unit that --lang fmu writes. [default: 3]
    #[arg(long, value_name = "VERSION", value_parser = named(generate::Generate::VERSIONS))]
    pub(crate) fmi: Option<Fmi>,
    /// Write to this file instead of stdout; C, which has a header and a source, writes into this
    /// folder
    #[arg(long, value_name = "PATH")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
}
