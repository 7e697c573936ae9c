//! `abbe schema`: the JSON Schema of an input file.

use abbe_metrology::schema::FileKind;
use clap::Args;

use crate::{Failure, Outcome, Result, arguments::named};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe schema spec
  abbe schema study
"))]
pub(crate) struct Schema {
    /// Kind of input file
    #[arg(value_parser = named(FileKind::CHOICES))]
    file: FileKind,
}

pub(crate) fn run(arguments: &Schema) -> Result<Outcome> {
    let schema = serde_json::to_string_pretty(&arguments.file.schema());
    Ok(Outcome::passed(schema.map_err(|error| Failure::new("JSON", error))? + "\n"))
}
