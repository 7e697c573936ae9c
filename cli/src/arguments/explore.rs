use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::shared::{Changes, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe explore pps
  abbe explore arm.toml --study cell.toml --out arm.html
  abbe explore ur5 puma560 --out two.html           two machines side by side
  abbe explore ur5 puma560 scara --out machines     one page for each, and an index
"))]
pub(crate) struct Explore {
    /// Path of a spec file (TOML), or name of a shipped manipulator; two of them are shown side by
    /// side, more of them become pages with an index
    #[arg(value_name = "SPEC", required = true, num_args = 1.., value_hint = ValueHint::FilePath)]
    pub(crate) specs: Vec<OsString>,
    /// Study file (TOML), or name of a shipped study: tolerance and workspace. [default:
    /// arm.study.toml beside arm.toml, or the study shipped with the manipulator, or 1000 joint
    /// samples]
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    /// Tolerance in place of that of the study: a length such as "0.3 mm" for the position error,
    /// an angle such as "0.5 mrad" for the orientation error; may be given for both
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true)]
    pub(crate) tolerance: Vec<String>,
    /// Write the page to this file; `-` is stdout. With more than two specs: write the pages and
    /// index.html into this folder. [default: NAME.html, or the folder live-pages]
    #[arg(long, short, value_name = "PATH", value_hint = ValueHint::AnyPath)]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) changes: Changes,
    #[command(flatten)]
    pub(crate) writing: Writing,
    /// Print the data of the page, a list of one report per spec, as JSON; writes no page
    #[arg(long, display_order = 111, conflicts_with = "out")]
    pub(crate) json: bool,
}
