use clap::Args;

use super::shared::Subject;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe check arm.toml
  abbe check arm.toml --set payload=5kg
", "a law fails: J_e is not what the exact chain gives"))]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Print JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}
