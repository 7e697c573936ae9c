use std::path::PathBuf;

use abbe_study::template::Template;
use clap::{Args, ValueHint};

use super::shared::Writing;
use super::values::named;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe new my_arm
  abbe new mill --template five-axis-mill
  abbe new hall --template gantry --out hall-1.toml
"))]
pub(crate) struct New {
    /// Name of the manipulator, in lower case
    pub(crate) name: String,
    /// Kind of machine
    #[arg(long, value_name = "TEMPLATE", value_parser = named(Template::CHOICES), default_value = "six-axis")]
    pub(crate) template: Template,
    /// Write the spec to this file. [default: NAME.toml]
    #[arg(long, short, value_name = "SPEC", value_hint = ValueHint::FilePath)]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
}
