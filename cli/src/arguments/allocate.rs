use std::path::PathBuf;

use clap::Args;

use super::shared::{Running, Showing, Subject, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe allocate pps
  abbe allocate pps --out improved.toml
  abbe allocate arm.toml --study cell.toml --tolerance 0.3mm --loosen
"))]
pub(crate) struct Allocate {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Study file (TOML) with workspace, tolerance and costs of the factors. [default: the study
    /// that `abbe analyze` uses]
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    /// Tolerance in place of that of the study: a length such as "0.3 mm" for the position error,
    /// an angle such as "0.5 mrad" for the orientation error; may be given for both
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true)]
    pub(crate) tolerance: Vec<String>,
    /// Allow factors above 1: errors that may be larger than they are
    #[arg(long)]
    pub(crate) loosen: bool,
    /// Write the spec with the factors, as `scale` of its sources, to this file
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) running: Running,
}
