use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::shared::{Dated, Running, Showing, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe merge 1.part 2.part
  abbe merge 1.part 2.part --json
  abbe merge 1.part 2.part --out merged
", "with --check: a tolerance of the study is not met"))]
pub(crate) struct Merge {
    /// Parts of one analysis, complete and in any order: the files written by `abbe analyze SPEC
    /// --shard I/N --out FILE`
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    pub(crate) parts: Vec<PathBuf>,
    /// Exit with status 1 if a tolerance of the study is not met
    #[arg(long)]
    pub(crate) check: bool,
    /// Write the files of `abbe analyze --out` into this folder, except configurations.csv: parts
    /// do not store single configurations
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) dated: Dated,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) running: Running,
}
