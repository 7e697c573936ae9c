use std::path::PathBuf;

use clap::Args;

use super::shared::Writing;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe man --out man1
"))]
pub(crate) struct Man {
    /// Write the manual pages into this folder: abbe.1 and one page per command
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) writing: Writing,
}
