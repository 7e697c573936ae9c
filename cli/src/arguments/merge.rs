use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::shared::{Running, Writing};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe merge 1.part 2.part
  abbe merge 1.part 2.part --json
  abbe merge 1.part 2.part --out merged
", "with --check: a tolerance of the study is not met"))]
pub(crate) struct Merge {
    /// All parts of one analysis, in any order: what `abbe analyze SPEC --shard I/N --out FILE` wrote
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    pub(crate) parts: Vec<PathBuf>,
    /// End with status 1 if a tolerance of the study is not met
    #[arg(long)]
    pub(crate) check: bool,
    /// Write into this folder what `abbe analyze --out` writes, but for configurations.csv: parts hold no single
    /// configurations
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}
