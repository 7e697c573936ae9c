use abbe_metrology::schema::FileKind;
use clap::Args;

use super::values::named;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe schema spec
  abbe schema study
"))]
pub(crate) struct Schema {
    /// Kind of input file
    #[arg(value_parser = named(FileKind::CHOICES))]
    pub(crate) file: FileKind,
}
