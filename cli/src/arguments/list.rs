use clap::Args;

#[derive(Args, Debug)]
#[command(after_help = after_help!("  abbe list
"))]
pub(crate) struct List {
    /// Print the list as JSON
    #[arg(long)]
    pub(crate) json: bool,
}
