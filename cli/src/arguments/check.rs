use clap::Args;

use super::shared::{Showing, Subject};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe check arm.toml
  abbe check arm.toml --set payload=5kg
", "a self-check fails: J_e differs from the exact chain"))]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) subject: Subject,
    #[command(flatten)]
    pub(crate) showing: Showing,
    /// Print the report as JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}
