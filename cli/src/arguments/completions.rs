use clap::Args;
use clap_complete::Shell;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe completions bash
  abbe completions zsh
"))]
pub(crate) struct Completions {
    /// Shell to generate completions for
    #[arg(value_enum)]
    pub(crate) shell: Shell,
}
